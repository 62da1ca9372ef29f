/* Client of a running YARS session on Linux, in C99 with the __atomic functions of GCC or clang.
 * Inputs: ownship, nav, surface traffic, input events. Outputs: records of the radar; sweeps; frames.
 * Use: include this header before any system header, because it defines _GNU_SOURCE. yars_segment.h and yars_records.h
 * (the records) lie beside it. docs/attach.md shows its use. docs/shared_memory.md describes the segment.
 * Errors: on failure, a function that attaches, claims, publishes or pushes returns -1 and fills yars_session.error.
 * Success of a publish or push means that the record was sent. `yars status` shows whether the record was accepted.
 * Threads: one at a time for each session. No function waits.
 *
 *   yars_session s;
 *   if (yars_attach(&s, "default", "my-cockpit") != 0 || yars_claim_ownship_lane(&s, 50) < 0) puts(s.error);
 *   yars_ownship o = {0};  ...;  o.epoch = yars_epoch(&s);  yars_publish_ownship(&s, &o);   at 20 to 100 Hz
 *   yars_detach(&s);
 */
#ifndef YARS_H
#define YARS_H

#include "yars_segment.h"

/* Position of a reader in the ring of sweeps. A cursor of zeros begins with the oldest sweep in the segment. */
typedef struct {
  uint64_t next; /* number of the next sweep to read */
  uint64_t lost; /* number of sweeps that were damaged, or overwritten before this reader read them */
  int begun;     /* 0: not begun; the first read sets `next` */
} yars_sweep_cursor;

/* ---- Joining and leaving ---- */
/* 1 if the path of the session still names the open file. */
static inline int yars_is_at_path(const yars_session* s) {
  struct stat here, there;
  return fstat(s->descriptor, &here) == 0 && stat(s->path, &there) == 0 && here.st_ino == there.st_ino &&
         here.st_dev == there.st_dev;
}

/* Releases the read lock on byte 0. The last program to leave then gets the write lock, and removes the segment. */
static inline void yars_leave(yars_session* s) {
  yars_lock(s, 0, F_UNLCK);
  if (yars_lock(s, 0, F_WRLCK) == 0 && yars_is_at_path(s)) unlink(s->path);
  if (s->memory != NULL) munmap(s->memory, YARS_LAYOUT_SIZE);
  close(s->descriptor);
  s->memory = NULL;
  s->descriptor = -1;
}

/* Maps the segment and compares its header with yars_records.h. */
static inline int yars_map(yars_session* s) {
  struct stat status;
  if (fstat(s->descriptor, &status) != 0 || status.st_uid != geteuid())
    return yars_fail(s, s->path, "expected a file of this user");
  if ((uint64_t)status.st_size < YARS_LAYOUT_SIZE)
    return yars_fail(s, s->path, "expected a larger segment: another build made it");
  void* memory = mmap(NULL, YARS_LAYOUT_SIZE, PROT_READ | PROT_WRITE, MAP_SHARED, s->descriptor, 0);
  if (memory == MAP_FAILED) return yars_fail(s, s->path, strerror(errno));
  s->memory = (unsigned char*)memory;
  const uint64_t hash = yars_load(yars_word(s, 16));
  const uint32_t version = (uint32_t)yars_load(yars_word(s, 24));
  if (yars_load(yars_word(s, 0)) == YARS_MAGIC && yars_load(yars_word(s, 8)) == YARS_LAYOUT_SIZE &&
      hash == YARS_LAYOUT_HASH && version == YARS_LAYOUT_VERSION)
    return 0;
  snprintf(s->error, sizeof s->error,
           "%s: expected layout version %u, hash %016llx, found version %u, hash %016llx; build against its yars.h",
           s->path, (unsigned)YARS_LAYOUT_VERSION, (unsigned long long)YARS_LAYOUT_HASH, (unsigned)version,
           (unsigned long long)hash);
  return -1;
}

static inline int64_t yars_monotonic_ns(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (int64_t)now.tv_sec * 1000000000 + now.tv_nsec;
}

/* Writes the CLOCK_MONOTONIC time as this program's heartbeat, for `yars status`. Call it about once a second. */
static inline void yars_heartbeat(const yars_session* s) {
  if (s->process >= 0)
    yars_store(yars_word(s, YARS_AT_PROCESSES + 40 * (size_t)s->process), (uint64_t)yars_monotonic_ns());
}

/* Adds this program to the process table, which `yars status` prints. An entry has 40 bytes: heartbeat [ns] at offset
 * 0, pid at 8, name at 16. */
static inline void yars_enter_table(yars_session* s, const char* program) {
  s->process = yars_claim(s, YARS_FIRST_PROCESS_BYTE, YARS_PROCESSES);
  if (s->process < 0) return; /* a full table is no error: the table only informs the user */
  const size_t entry = YARS_AT_PROCESSES + 40 * (size_t)s->process;
  char name[24] = {0};
  strncpy(name, program, sizeof name - 1);
  yars_store_words(yars_word(s, entry + 16), name, sizeof name);
  yars_heartbeat(s);
  __atomic_store_n((int32_t*)(void*)(s->memory + entry + 8), (int32_t)getpid(), __ATOMIC_RELEASE);
}

/* 1 for a valid session name. The name is part of a path, and so must not contain slashes or dots. */
static inline int yars_is_session_name(const char* name) {
  const char* const allowed = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz-_";
  const size_t length = strlen(name);
  return length >= 1 && length <= 40 && name[0] != '-' && strspn(name, allowed) == length;
}

/* Fills s->error with why the session `name` cannot be joined, and what to do. Returns -1. */
static inline int yars_fail_without_set(yars_session* s, const char* name, const char* why) {
  snprintf(s->error, sizeof s->error,
           "%s: %s; start the set with --session %s, or give the name of a session that runs "
           "(`yars --session NAME status`)",
           s->path, why, name);
  return -1;
}

/* Joins the running session `name`. `program`: name of this process in `yars status`, at most 23 characters. */
static inline int yars_attach(yars_session* s, const char* name, const char* program) {
  memset(s, 0, sizeof *s);
  s->ownship_lane = s->input_lane = s->process = -1;
  s->descriptor = -1;
  if (!yars_is_session_name(name))
    return yars_fail(s, "session", "expected 1 to 40 letters, digits, - or _ as its name, and no - at the front");
  snprintf(s->path, sizeof s->path, "/dev/shm/yars.%u.%s", (unsigned)geteuid(), name);
  s->descriptor = open(s->path, O_RDWR | O_CLOEXEC | O_NOFOLLOW);
  if (s->descriptor < 0 && errno == ENOENT) return yars_fail_without_set(s, name, "no such session runs");
  if (s->descriptor < 0) return yars_fail(s, s->path, strerror(errno));
  /* The write lock is granted only if no program takes part. */
  const int leftover = yars_lock(s, 0, F_WRLCK) == 0;
  if (leftover || yars_lock(s, 0, F_RDLCK) != 0 || !yars_is_at_path(s)) {
    close(s->descriptor);
    s->descriptor = -1;
    if (leftover) return yars_fail_without_set(s, name, "a leftover: its programs have died");
    return yars_fail(s, s->path, "it is just ending; try again");
  }
  if (yars_map(s) != 0) {
    yars_leave(s);
    return -1;
  }
  yars_enter_table(s, program);
  return 0;
}

static inline size_t yars_ownship_at(int lane) {
  return YARS_AT_OWNSHIP + (size_t)lane * YARS_VALUE_SIZE(sizeof(yars_ownship));
}

static inline size_t yars_nav_at(int lane) {
  return YARS_AT_NAV + (size_t)lane * YARS_VALUE_SIZE(sizeof(yars_nav));
}

/* Withdraws the published ownship, nav and traffic, releases all claims and leaves the session. */
static inline void yars_detach(yars_session* s) {
  if (s->memory == NULL) return;
  if (s->ownship_lane >= 0) {
    yars_withdraw(s, yars_ownship_at(s->ownship_lane));
    yars_withdraw(s, yars_nav_at(s->ownship_lane));
    yars_release(s, YARS_FIRST_OWNSHIP_BYTE + s->ownship_lane);
  }
  if (s->input_lane >= 0) yars_release(s, YARS_FIRST_INPUT_BYTE + s->input_lane);
  if (s->traffic) {
    yars_withdraw(s, YARS_AT_TRAFFIC);
    yars_release(s, YARS_TRAFFIC_BYTE);
  }
  if (s->process >= 0) {
    __atomic_store_n((int32_t*)(void*)(s->memory + YARS_AT_PROCESSES + 40 * (size_t)s->process + 8), 0,
                     __ATOMIC_RELEASE);
    yars_release(s, YARS_FIRST_PROCESS_BYTE + s->process);
  }
  yars_leave(s);
}

/* 1 while radar-model or state-machine takes part, even if stopped or not responding; else 0. A program that was killed
 * takes part again when the set has restarted it. At 0, detach and attach again: this attachment keeps
 * the old segment in existence, and a new set may create another segment. Cost: two system calls. */
static inline int yars_set_runs(const yars_session* s) {
  return s->memory != NULL && (yars_is_held(s, YARS_RADAR_MODEL_BYTE) || yars_is_held(s, YARS_STATE_MACHINE_BYTE));
}

/* ---- Time ---- */
/* Present sim time [ns]; 0 if the clock cannot be read, because it is being changed. */
static inline int64_t yars_sim_time_ns(const yars_session* s) {
  yars_clock clock;
  if (yars_read(s, YARS_AT_CLOCK, &clock, sizeof clock) == 0) return 0;
  /* A damaged clock stands still, because a rate out of range would overflow the time. Any program can damage it. */
  if (clock.running == 0 || !(clock.rate >= 0.0 && clock.rate <= 10.0)) return clock.base_sim_ns;
  if (clock.base_sim_ns < 0 || clock.base_sim_ns > YARS_LATEST_CLOCK_BASE_NS || clock.base_monotonic_ns < 0 ||
      clock.base_monotonic_ns > YARS_LATEST_CLOCK_BASE_NS)
    return clock.base_sim_ns;
  const int64_t elapsed = yars_monotonic_ns() - clock.base_monotonic_ns;
  return elapsed <= 0 ? clock.base_sim_ns : clock.base_sim_ns + (int64_t)(clock.rate * (double)elapsed);
}

/* Present epoch, for yars_ownship.epoch; 0 if the clock cannot be read, because it is being changed. */
static inline uint32_t yars_epoch(const yars_session* s) {
  yars_clock clock;
  return yars_read(s, YARS_AT_CLOCK, &clock, sizeof clock) != 0 ? clock.epoch : 0;
}

/* ---- Feeding ---- */
/* Claims a free lane for ownship and nav. Returns the lane's index, or -1. The radar uses the lane with the greatest
 * `priority` among those that were updated in the last 0.5 s. */
static inline int yars_claim_ownship_lane(yars_session* s, uint32_t priority) {
  s->ownship_lane = yars_claim(s, YARS_FIRST_OWNSHIP_BYTE, YARS_OWNSHIP_LANES);
  if (s->ownship_lane < 0) return yars_fail(s, "ownship lane", "all are taken; `yars status` names the holders");
  yars_withdraw(s, yars_ownship_at(s->ownship_lane));
  yars_withdraw(s, yars_nav_at(s->ownship_lane));
  __atomic_store_n((uint32_t*)(void*)(s->memory + YARS_AT_OWNSHIP_PRIORITY) + s->ownship_lane, priority,
                   __ATOMIC_RELEASE);
  return s->ownship_lane;
}

static inline int yars_publish_ownship(yars_session* s, const yars_ownship* ownship) {
  if (s->ownship_lane < 0) return yars_fail(s, "yars_publish_ownship", "claim an ownship lane first");
  yars_publish(s, yars_ownship_at(s->ownship_lane), ownship, sizeof *ownship);
  return 0;
}

static inline int yars_publish_nav(yars_session* s, const yars_nav* nav) {
  if (s->ownship_lane < 0) return yars_fail(s, "yars_publish_nav", "claim an ownship lane first");
  yars_publish(s, yars_nav_at(s->ownship_lane), nav, sizeof *nav);
  return 0;
}

/* Claims the traffic role, which only one program can hold. Each yars_publish_traffic() sends all ships and vehicles.
 * Between two calls the radar extrapolates each of them by its velocity. 12 s after the last call it removes them. */
static inline int yars_claim_traffic(yars_session* s) {
  if (yars_claim(s, YARS_TRAFFIC_BYTE, 1) < 0)
    return yars_fail(s, "traffic", "another program sends it; `yars status` names the holder");
  yars_withdraw(s, YARS_AT_TRAFFIC);
  s->traffic = 1;
  return 0;
}

static inline int yars_publish_traffic(yars_session* s, const yars_traffic* traffic) {
  if (!s->traffic) return yars_fail(s, "yars_publish_traffic", "claim the traffic role first");
  yars_publish(s, YARS_AT_TRAFFIC, traffic, sizeof *traffic);
  return 0;
}

/* Input lane: the cache line of the source (count of pushed events, count of dropped events, a word that only the C++
 * programs use, name), the cache line of the consumer (count of popped events), then the records. Offsets in bytes. */
#define YARS_INPUT_STRIDE \
  (2 * YARS_LINE + (YARS_INPUT_DEPTH * sizeof(yars_input_event) + YARS_LINE - 1) / YARS_LINE * YARS_LINE)
#define YARS_INPUT_DROPPED 8
#define YARS_INPUT_SOURCE 24
#define YARS_INPUT_POPPED YARS_LINE
#define YARS_INPUT_RECORDS (2 * YARS_LINE)

static inline size_t yars_input_at(int lane) {
  return YARS_AT_INPUT + (size_t)lane * YARS_INPUT_STRIDE;
}

/* Claims an input lane that has no sender and no unread events. Returns the lane's index, or -1. `source`: name of the
 * sender, at most 23 characters. */
static inline int yars_claim_input_lane(yars_session* s, const char* source) {
  for (int lane = 0; lane < YARS_INPUT_LANES; ++lane) {
    if (yars_claim(s, YARS_FIRST_INPUT_BYTE + lane, 1) < 0) continue;
    const size_t at = yars_input_at(lane);
    if (yars_load(yars_word(s, at)) != yars_load(yars_word(s, at + YARS_INPUT_POPPED))) {
      yars_release(s, YARS_FIRST_INPUT_BYTE + lane);
      continue;
    }
    char name[24] = {0};
    strncpy(name, source, sizeof name - 1);
    yars_store_words(yars_word(s, at + YARS_INPUT_SOURCE), name, sizeof name);
    return s->input_lane = lane;
  }
  return yars_fail(s, "input lane", "all are taken; `yars status` names the sources");
}

/* Sends an event. The caller sets kind (YARS_EVENT_...), argument, x, y and text; yars_records.h has their meaning.
 * This function sets the times and the number. */
static inline int yars_push_event(yars_session* s, const yars_input_event* event) {
  if (s->input_lane < 0) return yars_fail(s, "yars_push_event", "claim an input lane first");
  const size_t at = yars_input_at(s->input_lane);
  uint64_t* pushed = yars_word(s, at);
  uint64_t* dropped = yars_word(s, at + YARS_INPUT_DROPPED);
  const uint64_t number = yars_load(pushed);
  if (number - yars_load(yars_word(s, at + YARS_INPUT_POPPED)) >= YARS_INPUT_DEPTH) {
    yars_store(dropped, yars_load(dropped) + 1);
    return yars_fail(s, "input lane", "full: the event is dropped and counted; does state-machine run?");
  }
  yars_input_event stamped = *event;
  stamped.session_time_ns = yars_sim_time_ns(s);
  stamped.monotonic_ns = yars_monotonic_ns();
  stamped.number = ++s->events;
  const size_t slot = YARS_INPUT_RECORDS + (size_t)(number % YARS_INPUT_DEPTH) * sizeof stamped;
  yars_store_words(yars_word(s, at + slot), &stamped, sizeof stamped);
  yars_store(pushed, number + 1);
  return 0;
}

/* ---- Reading. The first three functions return 1 for a whole record; 0 if there is none, or if its writer changed it
 * during each of 9 attempts. ---- */
static inline int yars_read_radar_state(const yars_session* s, yars_radar_state* state) {
  return yars_read(s, YARS_AT_RADAR_STATE, state, sizeof *state);
}

static inline int yars_read_outputs(const yars_session* s, yars_outputs* outputs) {
  return yars_read(s, YARS_AT_OUTPUTS, outputs, sizeof *outputs);
}

static inline int yars_read_model_status(const yars_session* s, yars_model_status* status) {
  return yars_read(s, YARS_AT_MODEL_STATUS, status, sizeof *status);
}

/* Reads the caption of the tour that runs. Returns 0 if no tour runs, or if it shows no caption now. */
static inline int yars_read_caption(const yars_session* s, yars_caption* caption) {
  return yars_is_held(s, YARS_TOUR_BYTE) && yars_read(s, YARS_AT_CAPTION, caption, sizeof *caption);
}

/* Reads the newest frame of a radar-display with --publish. Returns 1 if its id differs from `after`; with 0 as `after`
 * any id differs. Returns 0 if there is no such frame, or if it was overwritten during each of 8 attempts; `frame` and
 * `pixels` are then unspecified. `pixels`: buffer of YARS_MOST_FRAME_BYTES, which gets the rows from the top, without
 * padding. A pixel has 4 bytes: red, green, blue, 255. */
static inline int yars_read_frame(const yars_session* s, uint64_t after, yars_glass_frame* frame, void* pixels) {
  for (int attempt = 0; attempt < 8; ++attempt) {
    uint64_t newest = 0;
    size_t at = 0;
    for (int i = 0; i < YARS_FRAMES; ++i) {
      const size_t slot = YARS_AT_FRAMES + (size_t)i * YARS_FRAME_STRIDE;
      const uint64_t id = yars_load(yars_word(s, slot));
      if (id > newest && id <= YARS_LATEST_PICTURE_ID) newest = id, at = slot; /* a greater id is damage */
    }
    if (newest == 0 || newest == after) return 0;
    yars_load_words(yars_word(s, at + YARS_FRAME_WORDS), frame, sizeof *frame);
    /* Larger than a slot: the frame is being written, or is damaged. */
    if (frame->width > 1024 || frame->height > 1024) continue;
    yars_load_words(yars_word(s, at + YARS_FRAME_PIXELS), pixels,
                    ((size_t)frame->width * frame->height * 4 + 7) / 8 * 8);
    if (yars_load(yars_word(s, at)) == newest && frame->id == newest) return 1;
  }
  return 0;
}

/* Reads the next sweep and advances the cursor. Returns 0 if there is no new sweep, or if 9 attempts failed; `sweep` is
 * then unspecified. The ring has the last 1023 sweeps: those of a few seconds of scanning. cursor->lost counts
 * overwritten and damaged sweeps. */
static inline int yars_read_sweep(const yars_session* s, yars_sweep_cursor* cursor, yars_sweep* sweep) {
  for (int attempt = 0; attempt < 9; ++attempt) {
    const uint64_t end = yars_load(yars_word(s, YARS_AT_SWEEPS));
    const uint64_t oldest = end < YARS_SWEEPS ? 0 : end - YARS_SWEEPS + 1;
    if (!cursor->begun) cursor->next = oldest, cursor->begun = 1;
    if (cursor->next > end) cursor->next = end;
    if (cursor->next < oldest) cursor->lost += oldest - cursor->next, cursor->next = oldest;
    if (cursor->next == end) return 0;
    const uint64_t* slot =
        yars_word(s, YARS_AT_SWEEPS + YARS_LINE + (size_t)(cursor->next % YARS_SWEEPS) * YARS_SWEEP_STRIDE);
    const uint64_t complete = 2 * cursor->next + 2; /* sequence of a slot that is not being written */
    if (yars_load(slot) != complete) continue;
    const uint64_t used = yars_load(slot + 1);
    if (used > sizeof *sweep / 8) continue;
    yars_load_words(slot + 2, sweep, (size_t)used * 8);
    if (yars_load(slot) != complete) continue;
    if (sweep->samples > YARS_MOST_SAMPLES) { /* damage: radar-model writes no such sweep */
      ++cursor->next, ++cursor->lost;
      continue;
    }
    ++cursor->next;
    return 1;
  }
  return 0;
}

#endif
