/* For a program of one's own, in C99 with GCC's or clang's __atomic: take part in a running YARS session on Linux, feed
 * ownship, navigator and input events, read what radar and pilot do. Include it before any system header (it asks for
 * _GNU_SOURCE). Every function returns -1 and fills yars_session.error when it fails. One thread at a time for each
 * session; nothing here waits. How the segment works: docs/shared_memory.md. The records are those of
 * databuffer/records/, and a test of YARS compares every offset.
 *
 *   yars_session s;
 *   if (yars_attach(&s, "default", "my-cockpit") != 0 || yars_claim_ownship_lane(&s, 50) < 0) puts(s.error);
 *   yars_ownship o = {0};  ...;  o.epoch = yars_epoch(&s);  yars_publish_ownship(&s, &o);   20 to 100 times a second
 *   yars_detach(&s);
 */
#ifndef YARS_H
#define YARS_H

#ifndef _GNU_SOURCE
#define _GNU_SOURCE
#endif
#include <errno.h>
#include <fcntl.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#ifndef F_OFD_SETLK
#define F_OFD_GETLK 36
#define F_OFD_SETLK 37
#endif

/* ---- What this header was made for; `yars status --layout` prints the same of a build. ---- */
#define YARS_MAGIC UINT64_C(0x314d485353524159)
#define YARS_LAYOUT_VERSION UINT32_C(3)
#define YARS_LAYOUT_SIZE UINT64_C(27471872)
#define YARS_LAYOUT_HASH UINT64_C(0xeb33f49407411935)

/* Offsets [bytes] from the segment's begin. */
#define YARS_AT_CLOCK 448
#define YARS_AT_OWNSHIP_PRIORITY 1024
#define YARS_AT_OWNSHIP 1088
#define YARS_AT_NAV 4416
#define YARS_AT_RADAR_STATE 7744
#define YARS_AT_MODEL_STATUS 13440
#define YARS_AT_OUTPUTS 16320
#define YARS_AT_INPUT 4934656
#define YARS_AT_PROCESSES 5051392
#define YARS_AT_TRAFFIC 13587584
#define YARS_AT_FRAMES 13840128

/* A picture of the glass: its slot's id, words and pixels. */
#define YARS_FRAMES 3
#define YARS_FRAME_STRIDE 4194376
#define YARS_FRAME_WORDS 8
#define YARS_FRAME_PIXELS 72
#define YARS_MOST_FRAME_BYTES 4194304

/* Lock bytes of the file, and how many there are of a kind. */
#define YARS_TRAFFIC_BYTE 5
#define YARS_FIRST_OWNSHIP_BYTE 8
#define YARS_FIRST_INPUT_BYTE 16
#define YARS_FIRST_PROCESS_BYTE 32
#define YARS_OWNSHIP_LANES 4
#define YARS_INPUT_LANES 16
#define YARS_INPUT_DEPTH 128
#define YARS_PROCESSES 32

/* ---- Records: units and ranges in databuffer/records/. ---- */
typedef struct {
  int64_t base_sim_ns, base_monotonic_ns;
  double rate;
  uint32_t running, epoch;
  double reposition_latitude_deg, reposition_longitude_deg, reposition_altitude_m, reposition_heading_deg;
  uint32_t followed, reserved0;
  uint64_t reserved[3];
} yars_clock;

typedef struct {
  int64_t source_time_ns;
  double latitude_deg, longitude_deg, altitude_msl_m, heading_deg, pitch_deg, roll_deg;
  double velocity_north_mps, velocity_east_mps, velocity_down_mps, radar_altitude_m;
  uint32_t epoch, flags;
  char source[16];
  double flight_time_s;
  uint64_t reserved[3];
} yars_ownship;

typedef struct {
  int64_t source_time_ns;
  double mission_latitude_deg, mission_longitude_deg, ins_latitude_deg, ins_longitude_deg;
  double velocity_north_mps, velocity_east_mps, velocity_down_mps, magnetic_variation_deg;
  uint32_t epoch, flags;
  uint64_t reserved[6];
} yars_nav;

typedef struct {
  int64_t session_time_ns, monotonic_ns;
  double x, y;
  uint16_t kind;
  int16_t argument;
  uint32_t number;
  char text[16];
} yars_input_event;

typedef struct {
  double latitude_deg, longitude_deg, elevation_m;
  char name[8];
  uint8_t kind, selected, reserved[6];
} yars_drawn_point;

typedef struct {
  double north_m, east_m, velocity_north_mps, velocity_east_mps, velocity_down_mps;
} yars_navigator_error;

typedef struct {
  double latitude_deg, longitude_deg, elevation_m;
  int64_t sim_time_ns;
} yars_mark;

typedef struct {
  int64_t tick;
  double range_nm, scan_width_deg, antenna_elevation_deg;
  double cursor_latitude_deg, cursor_longitude_deg, cursor_elevation_m, cursor_bearing_deg, cursor_range_nm;
  double tdc_x, tdc_y, window_nm;
  uint64_t events_applied;
  uint32_t epoch, flags, scan_restart, boxed;
  uint8_t power, mode, master, resume_mode, range_index, scan, gain, brightness;
  uint8_t contrast, cursor_function, navigator, channel, band, points_drawn, window_index, recall;
  char sequence_point[8], message[32];
  int64_t message_until_tick;
  yars_drawn_point points[8];
  char legends[21][8];
  double frame_latitude_deg, frame_longitude_deg, frame_track_deg;
  uint8_t ground_mode, reserved_bytes[3];
  uint32_t map_request;
  double map_latitude_deg, map_longitude_deg, map_window_nm;
  uint64_t map_newest, map_old, map_stored, map_shown;
  double cursor_believed_latitude_deg, cursor_believed_longitude_deg;
  yars_navigator_error mission, ins;
  double update_north_m, update_east_m;
  int64_t cursor_moved_tick;
  int32_t update_seconds;
  uint32_t vtr_request;
  double target_latitude_deg, target_longitude_deg, target_elevation_m;
  char target_name[8];
  double steering_line_deg, cue_latitude_deg, cue_longitude_deg, cue_elevation_m;
  uint32_t cue_count, target_count;
  uint8_t steering_line, mark_count, reserved_bytes2[2];
  uint32_t velocity_taken;
  int64_t velocity_updated_tick, velocity_shown_until_tick;
  double velocity_along_mps, velocity_across_mps, velocity_vertical_mps;
  yars_mark marks[10];
  double magnetic_variation_deg;
  uint64_t reserved[7];
} yars_radar_state;

typedef struct {
  int64_t tick, sim_time_ns;
  double antenna_azimuth_deg, antenna_elevation_deg, height_above_ground_m, ground_elevation_m;
  double cursor_ground_elevation_m, map_timer_s, map_progress, load;
  uint64_t terrain_generation, terrain_bytes, sweeps, late_ticks, refused, posts_pending;
  uint32_t epoch, scan, sweep, flags, scan_restart, ownship_lane;
  int8_t scan_direction;
  uint8_t mode, scan_bar, mappable;
  char why_not[20], fidelity[16];
  yars_ownship ownship;
  yars_nav nav;
  double scan_centre_deg, scan_width_deg, scan_range_m;
  uint32_t scan_tick;
  uint8_t antenna_phase, scan_noise_only, reserved0[2];
  int64_t ownship_received_ns;
  double map_latitude_deg, map_longitude_deg, map_up_deg, map_window_nm;
  uint64_t map_newest;
  uint32_t map_request, map_done_request;
  double scan_offset_deg, scan_rate_dps;
  double velocity_north_mps, velocity_east_mps, velocity_down_mps;
  int64_t velocity_due_tick;
  uint32_t velocity_count, velocity_dwell;
  uint8_t velocity_beam, reserved_bytes[7];
  uint64_t reserved[8];
} yars_model_status;

typedef struct {
  int64_t tick, sim_time_ns;
  double cue_latitude_deg, cue_longitude_deg, cue_elevation_m;
  double target_latitude_deg, target_longitude_deg, target_elevation_m;
  char target_name[8];
  double slant_range_m, bearing_deg, depression_deg, steering_deg, approach_deg;
  uint32_t epoch, cue_count, target_count;
  uint8_t steering, mark_count, reserved_bytes[2];
  yars_mark marks[10];
  uint64_t reserved[8];
} yars_outputs;

typedef struct {
  double latitude_deg, longitude_deg, velocity_north_mps, velocity_east_mps, height_m, cross_section_m2;
  uint32_t id, reserved0;
} yars_traffic_entity;

typedef struct {
  int64_t tick, source_time_ns;
  uint32_t count, epoch;
  uint64_t reserved[5];
  yars_traffic_entity entities[64];
} yars_traffic;

typedef struct {
  uint64_t id;
  int64_t tick, sim_time_ns;
  uint32_t width, height;
  uint64_t reserved[4];
} yars_glass_frame;

/* ---- The session ---- */
typedef struct {
  int descriptor;
  unsigned char* memory;
  int ownship_lane, input_lane, process; /* -1: none */
  int traffic;                           /* 1: this program is the one that tells of traffic */
  uint32_t events;
  char path[96];
  char error[256];
} yars_session;

static inline int yars_fail(yars_session* s, const char* what, const char* why) {
  snprintf(s->error, sizeof s->error, "%s: %s", what, why);
  return -1;
}

static inline uint64_t* yars_word(const yars_session* s, size_t at) {
  return (uint64_t*)(void*)(s->memory + at);
}

static inline uint64_t yars_load(const uint64_t* word) {
  return __atomic_load_n(word, __ATOMIC_ACQUIRE);
}

static inline void yars_store(uint64_t* word, uint64_t value) {
  __atomic_store_n(word, value, __ATOMIC_RELEASE);
}

static inline void yars_store_words(uint64_t* words, const void* record, size_t bytes) {
  for (size_t i = 0; i < bytes / 8; ++i) {
    uint64_t word;
    memcpy(&word, (const char*)record + 8 * i, 8);
    yars_store(&words[i], word);
  }
}

static inline void yars_load_words(const uint64_t* words, void* record, size_t bytes) {
  for (size_t i = 0; i < bytes / 8; ++i) {
    const uint64_t word = yars_load(&words[i]);
    memcpy((char*)record + 8 * i, &word, 8);
  }
}

/* ---- LatestValue: a state word on a line of its own, then four slots of sequence, version, words. ---- */
#define YARS_LINE ((size_t)64)
#define YARS_SLOTS 4
#define YARS_SLOT_STRIDE(bytes) (((bytes) + 16 + YARS_LINE - 1) / YARS_LINE * YARS_LINE)
#define YARS_VALUE_SIZE(bytes) (YARS_LINE + YARS_SLOTS * YARS_SLOT_STRIDE(bytes))

static inline uint64_t* yars_slot(const yars_session* s, size_t value_at, uint64_t version, size_t bytes) {
  return yars_word(s, value_at + YARS_LINE + (size_t)(version % YARS_SLOTS) * YARS_SLOT_STRIDE(bytes));
}

static inline void yars_publish(const yars_session* s, size_t value_at, const void* record, size_t bytes) {
  uint64_t* state = yars_word(s, value_at);
  const uint64_t version = (yars_load(state) >> 1) + 1;
  uint64_t* slot = yars_slot(s, value_at, version, bytes);
  const uint64_t odd = (yars_load(slot) + 1) | 1;
  yars_store(slot, odd);
  yars_store(slot + 1, version);
  yars_store_words(slot + 2, record, bytes);
  yars_store(slot, odd + 1);
  yars_store(state, version << 1 | 1);
}

static inline void yars_withdraw(const yars_session* s, size_t value_at) {
  uint64_t* state = yars_word(s, value_at);
  yars_store(state, ((yars_load(state) >> 1) + 1) << 1);
}

/* 1: `record` is the last value. 0: there is none, or its writer overtook this reader 9 times; then `record` may hold
 * anything. */
static inline int yars_read(const yars_session* s, size_t value_at, void* record, size_t bytes) {
  for (int attempt = 0; attempt < 9; ++attempt) {
    const uint64_t state = yars_load(yars_word(s, value_at));
    if ((state & 1) == 0) return 0;
    const uint64_t* slot = yars_slot(s, value_at, state >> 1, bytes);
    const uint64_t before = yars_load(slot);
    if (before % 2 != 0 || yars_load(slot + 1) != state >> 1) continue;
    yars_load_words(slot + 2, record, bytes);
    if (yars_load(slot) == before) return 1;
  }
  return 0;
}

/* ---- Locks ---- */
static inline int yars_lock(const yars_session* s, int byte, short kind) {
  struct flock lock;
  memset(&lock, 0, sizeof lock);
  lock.l_type = kind;
  lock.l_whence = SEEK_SET;
  lock.l_start = byte;
  lock.l_len = 1;
  return fcntl(s->descriptor, F_OFD_SETLK, &lock) == 0 ? 0 : -1;
}

static inline void yars_set_holder(const yars_session* s, int byte, int32_t pid) {
  __atomic_store_n((int32_t*)(void*)(s->memory + 32) + byte, pid, __ATOMIC_RELEASE);
}

/* Claims the first free byte of a block; its index, or -1. */
static inline int yars_claim(const yars_session* s, int first_byte, int count) {
  for (int i = 0; i < count; ++i)
    if (yars_lock(s, first_byte + i, F_WRLCK) == 0) {
      yars_set_holder(s, first_byte + i, (int32_t)getpid());
      return i;
    }
  return -1;
}

static inline void yars_release(const yars_session* s, int byte) {
  yars_set_holder(s, byte, 0);
  yars_lock(s, byte, F_UNLCK);
}

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

/* Joins the running session `name`; `program` is what `yars status` calls this process. */
static inline int yars_attach(yars_session* s, const char* name, const char* program) {
  memset(s, 0, sizeof *s);
  s->ownship_lane = s->input_lane = s->process = -1;
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

/* ---- Time ---- */
/* Sim time [ns] of this moment, and the epoch that ownship must carry; 0 when the clock is being set just now. */
static inline int64_t yars_sim_time_ns(const yars_session* s) {
  yars_clock clock;
  if (yars_read(s, YARS_AT_CLOCK, &clock, sizeof clock) == 0) return 0;
  if (clock.running == 0) return clock.base_sim_ns;
  return clock.base_sim_ns + (int64_t)(clock.rate * (double)(yars_monotonic_ns() - clock.base_monotonic_ns));
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

/* Sends kind, argument, x, y, text (databuffer/records/input_event.hpp); times and number are filled in. */
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

/* The newest picture of a glass started with --publish, if it is newer than `after` (0: any). `pixels` has room for
 * YARS_MOST_FRAME_BYTES: rows from the top without padding, red, green, blue, 255. */
static inline int yars_read_frame(const yars_session* s, uint64_t after, yars_glass_frame* frame, void* pixels) {
  for (int attempt = 0; attempt < 8; ++attempt) {
    uint64_t newest = 0;
    size_t at = 0;
    for (int i = 0; i < YARS_FRAMES; ++i) {
      const size_t slot = YARS_AT_FRAMES + (size_t)i * YARS_FRAME_STRIDE;
      const uint64_t id = yars_load(yars_word(s, slot));
      if (id > newest) newest = id, at = slot;
    }
    if (newest <= after) return 0;
    yars_load_words(yars_word(s, at + YARS_FRAME_WORDS), frame, sizeof *frame);
    if (frame->width <= 1024 && frame->height <= 1024)
      yars_load_words(yars_word(s, at + YARS_FRAME_PIXELS), pixels,
                      ((size_t)frame->width * frame->height * 4 + 7) / 8 * 8);
    if (yars_load(yars_word(s, at)) == newest && frame->id == newest) return 1;
  }
  return 0;
}

#endif
