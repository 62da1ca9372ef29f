/* For a program of one's own, in C99 with GCC's or clang's __atomic: take part in a running YARS session on Linux, feed
 * ownship, navigator and input events, read what radar and pilot do. Include it before any system header (it asks for
 * _GNU_SOURCE). A function that attaches, claims, publishes or pushes returns -1 and fills yars_session.error when it
 * fails; 0 of one that feeds means sent, not obeyed. One thread at a time for each session; nothing here waits. How to
 * use it: docs/attach.md; how the segment works: docs/shared_memory.md. The records stand in yars_records.h; it and
 * yars_segment.h lie beside this header.
 *
 *   yars_session s;
 *   if (yars_attach(&s, "default", "my-cockpit") != 0 || yars_claim_ownship_lane(&s, 50) < 0) puts(s.error);
 *   yars_ownship o = {0};  ...;  o.epoch = yars_epoch(&s);  yars_publish_ownship(&s, &o);   20 to 100 times a second
 *   yars_detach(&s);
 */
#ifndef YARS_H
#define YARS_H

#include "yars_segment.h"

/* Where a reader of sweeps has got to; begin with {0}: with the oldest that the segment holds. */
typedef struct {
  uint64_t next;
  uint64_t lost; /* sweeps overwritten before this reader came to them, counts up */
  int begun;
} yars_sweep_cursor;

/* ---- Joining and leaving ---- */
static inline int yars_is_at_path(const yars_session* s) {
  struct stat here, there;
  return fstat(s->descriptor, &here) == 0 && stat(s->path, &there) == 0 && here.st_ino == there.st_ino &&
         here.st_dev == there.st_dev;
}

/* Who gives up the last read lock gets the write lock, and takes the segment away. */
static inline void yars_leave(yars_session* s) {
  yars_lock(s, 0, F_UNLCK);
  if (yars_lock(s, 0, F_WRLCK) == 0 && yars_is_at_path(s)) unlink(s->path);
  if (s->memory != NULL) munmap(s->memory, YARS_LAYOUT_SIZE);
  close(s->descriptor);
  s->memory = NULL;
  s->descriptor = -1;
}

static inline int yars_map(yars_session* s) {
  struct stat status;
  if (fstat(s->descriptor, &status) != 0 || status.st_uid != geteuid())
    return yars_fail(s, s->path, "expected a file of this user");
  if ((uint64_t)status.st_size < YARS_LAYOUT_SIZE)
    return yars_fail(s, s->path, "expected a larger segment: it is of another build");
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

/* Shows in `yars status` that this program is alive; call it about once a second. */
static inline void yars_heartbeat(const yars_session* s) {
  if (s->process >= 0)
    yars_store(yars_word(s, YARS_AT_PROCESSES + 40 * (size_t)s->process), (uint64_t)yars_monotonic_ns());
}

static inline void yars_enter_table(yars_session* s, const char* program) {
  s->process = yars_claim(s, YARS_FIRST_PROCESS_BYTE, YARS_PROCESSES);
  if (s->process < 0) return; /* the table is for people: a full one is no failure */
  const size_t entry = YARS_AT_PROCESSES + 40 * (size_t)s->process;
  char name[24] = {0};
  strncpy(name, program, sizeof name - 1);
  yars_store_words(yars_word(s, entry + 16), name, sizeof name);
  yars_heartbeat(s);
  __atomic_store_n((int32_t*)(void*)(s->memory + entry + 8), (int32_t)getpid(), __ATOMIC_RELEASE);
}

/* The name is a part of a path: it may lead nowhere else. */
static inline int yars_is_session_name(const char* name) {
  const char* const allowed = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz-_";
  const size_t length = strlen(name);
  return length >= 1 && length <= 40 && strspn(name, allowed) == length;
}

/* Joins the running session `name`; `program` is what `yars status` calls this process. */
static inline int yars_attach(yars_session* s, const char* name, const char* program) {
  memset(s, 0, sizeof *s);
  s->ownship_lane = s->input_lane = s->process = -1;
  s->descriptor = -1;
  if (!yars_is_session_name(name))
    return yars_fail(s, "session", "expected 1 to 40 letters, digits, - or _ as its name");
  snprintf(s->path, sizeof s->path, "/dev/shm/yars.%u.%s", (unsigned)geteuid(), name);
  s->descriptor = open(s->path, O_RDWR | O_CLOEXEC | O_NOFOLLOW);
  if (s->descriptor < 0) return yars_fail(s, s->path, errno == ENOENT ? "no such session runs" : strerror(errno));
  /* The write lock can be had only where nobody takes part. */
  const int leftover = yars_lock(s, 0, F_WRLCK) == 0;
  if (leftover || yars_lock(s, 0, F_RDLCK) != 0 || !yars_is_at_path(s)) {
    close(s->descriptor);
    s->descriptor = -1;
    return yars_fail(s, s->path, leftover ? "a leftover: its programs have died" : "it is just ending; try again");
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

/* Gives back all that was claimed. */
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

/* 1 while radar-model or state-machine takes part, also stopped or hanging; 0 when neither does. One that is killed is
 * missing until scripts/start has started it again. After 0, detach: a segment lives as long as somebody is attached,
 * and a set that is started anew may make another one, so attach anew. Two system calls. */
static inline int yars_set_runs(const yars_session* s) {
  return s->memory != NULL && (yars_is_held(s, YARS_RADAR_MODEL_BYTE) || yars_is_held(s, YARS_STATE_MACHINE_BYTE));
}

/* ---- Time ---- */
/* Sim time [ns] of this moment, and the epoch that ownship must carry; 0 when the clock is being set just now. */
static inline int64_t yars_sim_time_ns(const yars_session* s) {
  yars_clock clock;
  if (yars_read(s, YARS_AT_CLOCK, &clock, sizeof clock) == 0) return 0;
  /* A rate that is none, as whoever else may write here may leave it, moves nothing. */
  if (clock.running == 0 || !(clock.rate >= 0.0 && clock.rate <= 10.0)) return clock.base_sim_ns;
  if (clock.base_sim_ns < 0 || clock.base_sim_ns > YARS_LATEST_CLOCK_BASE_NS || clock.base_monotonic_ns < 0 ||
      clock.base_monotonic_ns > YARS_LATEST_CLOCK_BASE_NS)
    return clock.base_sim_ns;
  const int64_t elapsed = yars_monotonic_ns() - clock.base_monotonic_ns;
  return elapsed <= 0 ? clock.base_sim_ns : clock.base_sim_ns + (int64_t)(clock.rate * (double)elapsed);
}

static inline uint32_t yars_epoch(const yars_session* s) {
  yars_clock clock;
  return yars_read(s, YARS_AT_CLOCK, &clock, sizeof clock) != 0 ? clock.epoch : 0;
}

/* ---- Feeding ---- */
/* A free lane for ownship and navigator, or -1; the radar takes the fresh lane of the highest priority. */
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

/* Ships and vehicles, all of them each time; the radar lets them go on straight between two calls, for 12 s. */
static inline int yars_claim_traffic(yars_session* s) {
  if (yars_claim(s, YARS_TRAFFIC_BYTE, 1) < 0)
    return yars_fail(s, "traffic", "another program tells of it; `yars status` names the holder");
  yars_withdraw(s, YARS_AT_TRAFFIC);
  s->traffic = 1;
  return 0;
}

static inline int yars_publish_traffic(yars_session* s, const yars_traffic* traffic) {
  if (!s->traffic) return yars_fail(s, "yars_publish_traffic", "claim the traffic first");
  yars_publish(s, YARS_AT_TRAFFIC, traffic, sizeof *traffic);
  return 0;
}

/* An input lane: the source's line (pushed, dropped, a cursor of the C++ side, name), the consumer's, the records. */
#define YARS_INPUT_STRIDE \
  (2 * YARS_LINE + (YARS_INPUT_DEPTH * sizeof(yars_input_event) + YARS_LINE - 1) / YARS_LINE * YARS_LINE)
#define YARS_INPUT_DROPPED 8
#define YARS_INPUT_SOURCE 24
#define YARS_INPUT_POPPED YARS_LINE
#define YARS_INPUT_RECORDS (2 * YARS_LINE)

static inline size_t yars_input_at(int lane) {
  return YARS_AT_INPUT + (size_t)lane * YARS_INPUT_STRIDE;
}

/* A lane that nobody feeds and that has been read empty, or -1. `source`: who sends, 23 characters. */
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

/* Sends kind, argument, x, y, text (databuffer/messages/input_event_record.idl); times and number are filled in. */
static inline int yars_push_event(yars_session* s, const yars_input_event* event) {
  if (s->input_lane < 0) return yars_fail(s, "yars_push_event", "claim an input lane first");
  const size_t at = yars_input_at(s->input_lane);
  uint64_t* pushed = yars_word(s, at);
  uint64_t* dropped = yars_word(s, at + YARS_INPUT_DROPPED);
  const uint64_t number = yars_load(pushed);
  if (number - yars_load(yars_word(s, at + YARS_INPUT_POPPED)) >= YARS_INPUT_DEPTH) {
    yars_store(dropped, yars_load(dropped) + 1);
    return yars_fail(s, "input lane", "full: the event is dropped and counted; does the state-machine run?");
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

/* ---- Reading: 1 when there is a value, 0 when not (yet). ---- */
static inline int yars_read_radar_state(const yars_session* s, yars_radar_state* state) {
  return yars_read(s, YARS_AT_RADAR_STATE, state, sizeof *state);
}

static inline int yars_read_outputs(const yars_session* s, yars_outputs* outputs) {
  return yars_read(s, YARS_AT_OUTPUTS, outputs, sizeof *outputs);
}

static inline int yars_read_model_status(const yars_session* s, yars_model_status* status) {
  return yars_read(s, YARS_AT_MODEL_STATUS, status, sizeof *status);
}

/* The newest picture of a glass started with --publish, if it is another one than `after` (0: any). `pixels` has room
 * for YARS_MOST_FRAME_BYTES: rows from the top without padding, red, green, blue, 255. */
static inline int yars_read_frame(const yars_session* s, uint64_t after, yars_glass_frame* frame, void* pixels) {
  for (int attempt = 0; attempt < 8; ++attempt) {
    uint64_t newest = 0;
    size_t at = 0;
    for (int i = 0; i < YARS_FRAMES; ++i) {
      const size_t slot = YARS_AT_FRAMES + (size_t)i * YARS_FRAME_STRIDE;
      const uint64_t id = yars_load(yars_word(s, slot));
      if (id > newest && id <= YARS_LATEST_PICTURE_ID) newest = id, at = slot; /* a greater one is damage */
    }
    if (newest == 0 || newest == after) return 0;
    yars_load_words(yars_word(s, at + YARS_FRAME_WORDS), frame, sizeof *frame);
    /* Larger than a slot: being written, or nobody's picture. */
    if (frame->width > 1024 || frame->height > 1024) continue;
    yars_load_words(yars_word(s, at + YARS_FRAME_PIXELS), pixels,
                    ((size_t)frame->width * frame->height * 4 + 7) / 8 * 8);
    if (yars_load(yars_word(s, at)) == newest && frame->id == newest) return 1;
  }
  return 0;
}

/* 1: `sweep` is the next one, and the cursor has moved past it. 0: nothing new; then `sweep` may hold anything. The
 * ring holds the last 1023, some seconds: who comes later finds the gap in cursor->lost. */
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
    const uint64_t whole = 2 * cursor->next + 2;
    if (yars_load(slot) != whole) continue;
    const uint64_t used = yars_load(slot + 1);
    if (used > sizeof *sweep / 8) continue;
    yars_load_words(slot + 2, sweep, (size_t)used * 8);
    if (yars_load(slot) != whole) continue;
    if (sweep->samples > YARS_MOST_SAMPLES) { /* nothing that a radar-model writes */
      ++cursor->next, ++cursor->lost;
      continue;
    }
    ++cursor->next;
    return 1;
  }
  return 0;
}

#endif
