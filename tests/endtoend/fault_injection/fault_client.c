/* External program in a running set for fault injection. It uses only databuffer/client/yars.h.
 *  fault_client MODE SESSION [NUMBER [SEED]]     exit code 0: done; 1: could not attach or claim; 2: wrong arguments
 *    fly, push                                   write NUMBER records a second until killed; 0: without pause
 *    frames, clock                               write without pause until killed
 *    restore                                     bring the radar back to RBM by events; the last has text markNUMBER
 *    bad-ownship, bad-nav, bad-events, bad-traffic   NUMBER records, most of them invalid
 *    die-with-lane                               claim lanes, write one record each, SIGKILL itself */
#include "databuffer/client/yars.h"
/* The header defines feature macros and must come first. */
#include <math.h>
#include <signal.h>
#include <stdlib.h>

#include "tests/endtoend/fault_injection/witness.h"

#define PRIORITY 90         /* of ownship lanes; above every other source */
#define GLASS_FRAMES_BYTE 6 /* lock byte of the segment: right to publish pictures of the display */
#define CLOCK_BYTE 4        /* lock byte of the segment: right to set the clock */

static volatile sig_atomic_t ended = 0;
static void end(int signal_number) {
  ended = signal_number;
}

static uint64_t random_state;
static uint64_t random_word(void) {
  random_state += UINT64_C(0x9e3779b97f4a7c15);
  uint64_t z = random_state;
  z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
  z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
  return z ^ (z >> 31);
}

static void rest(double rate_hz) {
  if (rate_hz <= 0.0) return;
  const long ns = (long)(1e9 / rate_hz);
  nanosleep(&(struct timespec){ns / 1000000000, ns % 1000000000}, NULL);
}

/* The ownship that radar-model uses. A client continues from its position, so that the aircraft does not jump. */
static yars_ownship latched_ownship(const yars_session* s) {
  yars_model_status status;
  yars_ownship own = {0};
  if (yars_read_model_status(s, &status) == 1) own = status.ownship;
  if (own.altitude_msl_m < 100.0) own.latitude_deg = 37.4, own.longitude_deg = -122.6, own.altitude_msl_m = 4500.0;
  memset(own.source, 0, sizeof own.source);
  strcpy(own.source, FAULT_SOURCE);
  memset(own.reserved, 0, sizeof own.reserved);
  own.radar_altitude_m = NAN;
  own.flight_time_s = 0.0;
  return own;
}

static yars_nav nav_of(const yars_ownship* own) {
  yars_nav nav = {0};
  nav.source_time_ns = own->source_time_ns;
  nav.mission_latitude_deg = nav.ins_latitude_deg = own->latitude_deg;
  nav.mission_longitude_deg = nav.ins_longitude_deg = own->longitude_deg;
  nav.velocity_north_mps = own->velocity_north_mps;
  nav.magnetic_variation_deg = NAN;
  nav.epoch = own->epoch;
  nav.reserved[0] = UINT64_C(0x6d726f7473); /* FAULT_FRAME_MARK */
  return nav;
}

static int fly(yars_session* s, double rate_hz) {
  if (yars_claim_ownship_lane(s, PRIORITY) < 0) return 1;
  yars_ownship own = latched_ownship(s);
  const double begin_deg = own.latitude_deg;
  const int64_t begin_ns = yars_monotonic_ns();
  own.heading_deg = own.pitch_deg = own.roll_deg = 0.0;
  own.velocity_north_mps = 30.0;
  own.velocity_east_mps = own.velocity_down_mps = 0.0;
  while (!ended) {
    const double flown_s = 1e-9 * (double)(yars_monotonic_ns() - begin_ns);
    ++own.source_time_ns;
    own.latitude_deg = begin_deg + own.velocity_north_mps * flown_s / 111000.0;
    own.epoch = yars_epoch(s);
    witness_sign(&own, sizeof own);
    yars_nav nav = nav_of(&own);
    witness_sign(&nav, sizeof nav);
    yars_publish_nav(s, &nav);
    yars_publish_ownship(s, &own);
    yars_heartbeat(s);
    rest(rate_hz);
  }
  return 0;
}

static int push(yars_session* s, double rate_hz) {
  if (yars_claim_input_lane(s, FAULT_SOURCE) < 0) return 1;
  while (!ended) {
    const uint32_t number = s->events + 1;
    yars_input_event event = {0};
    event.kind = 2; /* tdc */
    event.x = witness_tdc_x(number);
    event.y = witness_tdc_y(number);
    snprintf(event.text, sizeof event.text, FAULT_SOURCE "%u", number);
    /* A full lane drops the event and does not use its number. The next event then has the same number. */
    yars_push_event(s, &event);
    yars_heartbeat(s);
    rest(rate_hz);
  }
  return 0;
}

/* Sends only the events that the state needs: a selected mode begins its scan anew, a TDC release commands a map. */
static int restore(yars_session* s, uint32_t mark) {
  if (yars_claim_input_lane(s, "restore") < 0) return 1;
  yars_radar_state state;
  memset(&state, 0, sizeof state);
  yars_read_radar_state(s, &state);
  const uint32_t freeze_flag = 2, sniff_flag = 4, set_flag = 1U << 5, pressed_flag = 1U << 11, mapping_flag = 1U << 14;
  const yars_input_event power = {.kind = 12, .argument = 2}, master = {.kind = 10}, mode = {.kind = 11};
  const yars_input_event menu = {.kind = 1, .argument = 6};
  const yars_input_event sniff_or_set = {.kind = 1, .argument = 18}; /* SET while it is on, else SNIFF */
  const yars_input_event release = {.kind = 4}, freeze = {.kind = 7};
  if (state.power != 2) yars_push_event(s, &power);
  if (state.master != 0) yars_push_event(s, &master);
  if (state.mode == 7) yars_push_event(s, &menu);
  /* SET and SNIFF prevent the mode change: a patch map under SNIFF stays frozen. */
  if ((state.flags & set_flag) != 0) yars_push_event(s, &sniff_or_set);
  if ((state.flags & sniff_flag) != 0) yars_push_event(s, &sniff_or_set);
  if (state.mode != 0 || (state.flags & mapping_flag) != 0) yars_push_event(s, &mode);
  if ((state.flags & freeze_flag) != 0) yars_push_event(s, &freeze);
  if ((state.flags & pressed_flag) != 0) yars_push_event(s, &release);
  yars_input_event last = {.kind = 2}; /* TDC deflection 0 */
  snprintf(last.text, sizeof last.text, "mark%u", mark);
  return yars_push_event(s, &last) == 0 ? 0 : 1;
}

static int frames(yars_session* s) {
  if (yars_claim(s, GLASS_FRAMES_BYTE, 1) < 0) return 1;
  const size_t edge = 128;
  while (!ended) {
    uint64_t newest = 0, oldest = UINT64_MAX;
    size_t at = 0;
    for (int i = 0; i < YARS_FRAMES; ++i) {
      const size_t slot = YARS_AT_FRAMES + (size_t)i * YARS_FRAME_STRIDE;
      const uint64_t id = yars_load(yars_word(s, slot));
      if (id > newest) newest = id;
      if (id < oldest) oldest = id, at = slot;
    }
    yars_glass_frame frame = {0};
    frame.id = newest + 1;
    frame.width = frame.height = (uint32_t)edge;
    frame.reserved[0] = FAULT_FRAME_MARK;
    witness_sign(&frame, sizeof frame);
    yars_store(yars_word(s, at), 0);
    yars_store_words(yars_word(s, at + YARS_FRAME_WORDS), &frame, sizeof frame);
    for (size_t i = 0; i < edge * edge / 2; ++i)
      yars_store(yars_word(s, at + YARS_FRAME_PIXELS + 8 * i), witness_pixels(frame.id, i));
    yars_store(yars_word(s, at), frame.id);
  }
  return 0;
}

/* Publishes the clock again and again with a later base, so that sim time is the same function of time. */
static int set_clock(yars_session* s) {
  while (!ended) {
    if (yars_claim(s, CLOCK_BYTE, 1) < 0) continue;
    yars_clock clock;
    if (yars_read(s, YARS_AT_CLOCK, &clock, sizeof clock) == 1 && clock.rate == 1.0 && clock.running == 1) {
      const int64_t now = yars_monotonic_ns();
      clock.base_sim_ns += now - clock.base_monotonic_ns;
      clock.base_monotonic_ns = now;
      yars_publish(s, YARS_AT_CLOCK, &clock, sizeof clock);
    }
    yars_release(s, CLOCK_BYTE);
  }
  return 0;
}

static double hostile_number(void) {
  const double numbers[] = {NAN,  -NAN,       INFINITY, -INFINITY, 1e300, -1e300, 1e-310,
                            -0.0, 90.0000001, -180.1,   360.0001,  1e18,  -1e9,   2147483648.0};
  return numbers[random_word() % (sizeof numbers / sizeof numbers[0])];
}

/* Replaces one to four doubles of the record, which begin at byte `first`. One time in four it also changes a byte. */
static void spoil(void* record, size_t first, size_t doubles, size_t bytes) {
  for (uint64_t n = random_word() % 4 + 1; n > 0; --n) {
    const double bad = hostile_number();
    memcpy((char*)record + first + 8 * (random_word() % doubles), &bad, 8);
  }
  if (random_word() % 4 == 0) ((unsigned char*)record)[random_word() % bytes] ^= (unsigned char)random_word();
}

static int bad_lane(yars_session* s, long count, int nav_too) {
  if (yars_claim_ownship_lane(s, PRIORITY) < 0) return 1;
  const yars_ownship good = latched_ownship(s);
  for (long i = 0; i < count; ++i) {
    yars_ownship own = good;
    yars_nav nav = nav_of(&good);
    memcpy(own.source, "hostile", 8);
    nav.reserved[0] = 0;
    own.epoch = (random_word() % 8 == 0) ? (uint32_t)random_word() : yars_epoch(s);
    if (nav_too) spoil(&nav, 8, 8, sizeof nav);
    if (!nav_too || random_word() % 2 == 0) spoil(&own, 8, 10, sizeof own);
    if (random_word() % 8 == 0) memset(own.source, 0x1b, sizeof own.source); /* ESC characters, no terminator */
    own.flags = (uint32_t)random_word();
    nav.flags = (uint32_t)random_word();
    yars_publish_nav(s, &nav);
    yars_publish_ownship(s, &own);
    rest(2000.0);
  }
  return 0;
}

static int bad_events(yars_session* s, long count) {
  if (yars_claim_input_lane(s, "hostile \x1b[2J") < 0) return 1;
  for (long i = 0; i < count; ++i) {
    yars_input_event event = {0};
    event.kind = (uint16_t)(random_word() % 8 == 0 ? random_word() : random_word() % 20);
    event.argument = (int16_t)(random_word() % 2 == 0 ? random_word() : random_word() % 24);
    event.x = random_word() % 2 == 0 ? hostile_number() : 0.5;
    event.y = random_word() % 2 == 0 ? hostile_number() : -0.5;
    const uint64_t text[2] = {random_word(), random_word()};
    memcpy(event.text, text, sizeof event.text);
    yars_push_event(s, &event);
    rest(2000.0);
  }
  return 0;
}

static int bad_traffic(yars_session* s, long count) {
  if (yars_claim_traffic(s) < 0) return 1;
  const yars_ownship own = latched_ownship(s);
  static yars_traffic traffic;
  for (long i = 0; i < count; ++i) {
    memset(&traffic, 0, sizeof traffic);
    traffic.count = (uint32_t)(random_word() % 4 == 0 ? random_word() : random_word() % 65);
    traffic.epoch = (uint32_t)random_word();
    for (int e = 0; e < 64; ++e) {
      yars_traffic_entity* entity = &traffic.entities[e];
      entity->latitude_deg = own.latitude_deg + 0.01 * e;
      entity->longitude_deg = own.longitude_deg;
      entity->height_m = 10.0;
      entity->cross_section_m2 = 1000.0;
      entity->id = (uint32_t)e;
      if (random_word() % 16 == 0) spoil(entity, 0, 6, sizeof *entity);
    }
    yars_publish_traffic(s, &traffic);
    rest(2000.0);
  }
  return 0;
}

/* Claims an ownship lane and an input lane, writes one valid record to each, and dies by SIGKILL. */
static int die_with_lane(yars_session* s) {
  if (yars_claim_ownship_lane(s, PRIORITY) < 0 || yars_claim_input_lane(s, "dying") < 0) return 1;
  yars_ownship own = latched_ownship(s);
  own.epoch = yars_epoch(s);
  witness_sign(&own, sizeof own);
  yars_publish_ownship(s, &own);
  const yars_input_event event = {.kind = 2, .x = 0.5};
  yars_push_event(s, &event);
  kill(getpid(), SIGKILL);
  return 1;
}

static int run_mode(yars_session* s, const char* mode, double number) {
  const long count = (long)number;
  if (strcmp(mode, "fly") == 0) return fly(s, number);
  if (strcmp(mode, "push") == 0) return push(s, number);
  if (strcmp(mode, "restore") == 0) return restore(s, (uint32_t)count);
  if (strcmp(mode, "frames") == 0) return frames(s);
  if (strcmp(mode, "clock") == 0) return set_clock(s);
  if (strcmp(mode, "bad-ownship") == 0) return bad_lane(s, count, 0);
  if (strcmp(mode, "bad-nav") == 0) return bad_lane(s, count, 1);
  if (strcmp(mode, "bad-events") == 0) return bad_events(s, count);
  if (strcmp(mode, "bad-traffic") == 0) return bad_traffic(s, count);
  if (strcmp(mode, "die-with-lane") == 0) return die_with_lane(s);
  snprintf(s->error, sizeof s->error, "unknown mode %s", mode);
  return 1;
}

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  yars_session s;
  if (yars_attach(&s, argv[2], "fault_client") != 0) {
    fprintf(stderr, "%s\n", s.error);
    return 1;
  }
  signal(SIGTERM, end);
  random_state = argc > 4 ? strtoull(argv[4], NULL, 10) : 1;
  const int outcome = run_mode(&s, argv[1], argc > 3 ? atof(argv[3]) : 0.0);
  if (outcome != 0) fprintf(stderr, "%s\n", s.error);
  yars_detach(&s);
  return outcome;
}
