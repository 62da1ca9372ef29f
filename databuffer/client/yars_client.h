/* libyars-client: client of a running YARS session on Linux, in C. It does what yars.h does, by functions of a shared
 * library, for programs that call C from any language. A program may include both headers.
 * Inputs: ownship, nav, surface traffic, input events. Outputs: records of the radar, sweeps, frames of the display.
 * Errors: a function returns a code below 0 on failure; yars_client_error() then says what was expected, what was found
 *   and what to do. No function throws or ends the program. NULL, and a client that was detached, are failures.
 * Success of a publish or push means that the record was sent. `yars status` shows whether the record was accepted.
 * Threads: one at a time for each client; a program may have several clients. The text of an error belongs to the
 *   thread that made it. After fork() only one of the two processes may use a client.
 * Waiting: none, but yars_client_claim_traffic() may take 0.2 s, and yars_client_attach() some milliseconds.
 *
 *   yars_client* c = NULL;
 *   if (yars_client_attach("default", "my-cockpit", &c) != 0 || yars_client_claim_ownship(c, 50) < 0)
 *     puts(yars_client_error());
 *   yars_ownship o = {0};  ...;  o.epoch = yars_client_epoch(c);  yars_client_publish_ownship(c, &o);
 *   yars_client_detach(c);
 */
#ifndef YARS_CLIENT_H
#define YARS_CLIENT_H

#include <stddef.h>
#include <stdint.h>

#include "yars_records.h"

#ifdef __cplusplus
extern "C" {
#endif

#define YARS_CLIENT_API __attribute__((visibility("default")))

/* Codes of failures. A later version may have more of them, all below 0. */
enum {
  YARS_CLIENT_FAILED = -1,  /* session or system do not allow it: no set runs, lanes are taken or full, no memory */
  YARS_CLIENT_ARGUMENT = -2 /* fault of the caller: NULL, a detached client, a wrong name, a lane not claimed */
};

typedef struct yars_client yars_client;

/* Position of a reader in the ring of sweeps. A cursor of zeros begins with the oldest sweep in the segment. */
typedef struct {
  uint64_t next;  /* number of the next sweep to read */
  uint64_t lost;  /* number of sweeps that were damaged, or overwritten before this reader read them */
  uint64_t begun; /* 0: not begun; the first read sets `next` */
} yars_client_cursor;

/* What was wrong with the last call of this thread that failed; an empty text before the first. Valid until the next
 * failure. */
YARS_CLIENT_API const char* yars_client_error(void);

/* ---- Joining and leaving ---- */
/* Joins the running session `session` and stores the client. `program`: name of this process in `yars status`, at most
 * 23 characters. On failure *client is NULL. */
YARS_CLIENT_API int yars_client_attach(const char* session, const char* program, yars_client** client);
/* Withdraws what was published, releases all claims and leaves the session; the last program to leave removes the
 * segment. No effect on NULL and on a client that was detached. A few bytes stay, so that a later use is an error. */
YARS_CLIENT_API void yars_client_detach(yars_client* client);
/* 1 while radar-model or state-machine takes part, even if stopped; else 0, also after a failure. At 0, detach and
 * attach again: a new set may make another segment. */
YARS_CLIENT_API int yars_client_set_runs(const yars_client* client);
/* Shows in `yars status` that this program is alive. Call it about once a second. */
YARS_CLIENT_API int yars_client_heartbeat(yars_client* client);

/* ---- Time. A damaged clock is refused; the last valid one stays in use. ---- */
/* Present sim time [ns]; 0 if no clock was readable yet, and after a failure. */
YARS_CLIENT_API int64_t yars_client_sim_time_ns(yars_client* client);
/* Present epoch, for yars_ownship.epoch; 0 as above. */
YARS_CLIENT_API uint32_t yars_client_epoch(yars_client* client);

/* ---- Feeding. Functions that claim return 0 or more, the others 0. A second claim by one client keeps the first. ----
 */
/* Claims a lane for ownship and nav and returns its index. The radar uses the lane with the greatest `priority` among
 * those that were updated in the last 0.5 s. */
YARS_CLIENT_API int yars_client_claim_ownship(yars_client* client, uint32_t priority);
YARS_CLIENT_API int yars_client_publish_ownship(yars_client* client, const yars_ownship* ownship);
YARS_CLIENT_API int yars_client_publish_nav(yars_client* client, const yars_nav* nav);
/* Claims the traffic role, which only one program can hold. Each yars_client_publish_traffic() sends all ships and
 * vehicles. 12 s after the last one the radar removes them. */
YARS_CLIENT_API int yars_client_claim_traffic(yars_client* client);
YARS_CLIENT_API int yars_client_publish_traffic(yars_client* client, const yars_traffic* traffic);
/* Claims an input lane that has no sender and no unread events, and returns its index. `source`: name of the sender, at
 * most 23 characters. */
YARS_CLIENT_API int yars_client_claim_input(yars_client* client, const char* source);
/* Sends an event with the kind (YARS_EVENT_...), argument, x, y and text of `event`. Times and number are set here. A
 * full lane is a failure: the event is dropped and counted. */
YARS_CLIENT_API int yars_client_push_event(yars_client* client, const yars_input_event* event);

/* ---- Reading. These functions return 1 for a whole record; 0 if there is none, with the record as it was. ---- */
YARS_CLIENT_API int yars_client_read_clock(yars_client* client, yars_clock* clock);
YARS_CLIENT_API int yars_client_read_radar_state(yars_client* client, yars_radar_state* state);
YARS_CLIENT_API int yars_client_read_outputs(yars_client* client, yars_outputs* outputs);
YARS_CLIENT_API int yars_client_read_model_status(yars_client* client, yars_model_status* status);
/* The caption of the tour that runs; 0 also if no tour runs. */
YARS_CLIENT_API int yars_client_read_caption(yars_client* client, yars_caption* caption);
/* The newest frame of a radar-display with --publish, if its id differs from `after`; with 0 as `after` any id differs.
 * *pixels gets the address of its rows from the top, without padding, four bytes a pixel: red, green, blue, 255. They
 * are valid until the next call with this client. */
YARS_CLIENT_API int yars_client_read_frame(yars_client* client, uint64_t after, yars_glass_frame* frame,
                                           const unsigned char** pixels);
/* The next sweep; advances the cursor. The ring has the last 1023 sweeps: those of a few seconds of scanning. Entries
 * of `video` beyond `samples` are unspecified. */
YARS_CLIENT_API int yars_client_read_sweep(yars_client* client, yars_client_cursor* cursor, yars_sweep* sweep);

#ifdef __cplusplus
}
#endif

#endif
