/* User program with databuffer/client/yars.h in strict C99. Arguments: name of the session, mode. Mode `look` prints
 * the newest display frame. Other modes publish an aircraft, traffic and an event, and print the sim time. `stay` then
 * waits for the end of standard input. yars_header_test.cpp starts the program and checks the segment. */
#include "databuffer/client/yars.h"
/* yars.h comes first, because it defines _GNU_SOURCE. */
#include <stdio.h>
#include <stdlib.h>

static int give_up(const yars_session* s) {
  fprintf(stderr, "%s\n", s->error);
  return 1;
}

static int publish_all(yars_session* s) {
  yars_radar_state state;
  yars_model_status status;
  if (yars_read_radar_state(s, &state) != 1) return 2;
  if (yars_read_model_status(s, &status) != 0) return 3; /* none has been published */
  yars_ownship ownship = {0};
  ownship.latitude_deg = 34.5;
  ownship.altitude_msl_m = state.range_nm; /* copied, so that the test sees that the state was read */
  ownship.epoch = yars_epoch(s);
  strcpy(ownship.source, "c client");
  yars_nav nav = {0};
  nav.ins_longitude_deg = -120.25;
  if (yars_publish_ownship(s, &ownship) != 0 || yars_publish_nav(s, &nav) != 0) return give_up(s);
  yars_traffic traffic = {0};
  traffic.count = 1;
  traffic.entities[0].latitude_deg = 34.25;
  traffic.entities[0].id = 9;
  if (yars_claim_traffic(s) != 0 || yars_publish_traffic(s, &traffic) != 0) return give_up(s);
  yars_input_event event = {0};
  event.kind = 1;
  event.argument = 13;
  strcpy(event.text, "from C");
  return yars_push_event(s, &event) == 0 ? 0 : give_up(s);
}

/* Prints the size of the newest display frame and the sum of its bytes, which the test compares. */
static int print_frame(yars_session* s) {
  static unsigned char pixels[YARS_MOST_FRAME_BYTES];
  yars_glass_frame frame;
  unsigned long sum = 0;
  if (yars_read_frame(s, 0, &frame, pixels) != 1) return 4;
  if (yars_read_frame(s, frame.id, &frame, pixels) != 0) return 5; /* no frame is newer than this one */
  for (size_t i = 0; i < (size_t)frame.width * frame.height * 4; ++i) sum += pixels[i];
  printf("%u x %u: %lu\n", frame.width, frame.height, sum);
  return 0;
}

int main(int argc, char** argv) {
  yars_session s;
  if (argc != 3) return 64;
  if (yars_attach(&s, argv[1], "c-client") != 0) return give_up(&s);
  if (yars_claim_ownship_lane(&s, 70) < 0 || yars_claim_input_lane(&s, "c input") < 0) return give_up(&s);
  yars_heartbeat(&s);
  if (strcmp(argv[2], "look") == 0) {
    const int seen = print_frame(&s);
    yars_detach(&s);
    return seen;
  }
  int code = publish_all(&s);
  printf("%lld\n", (long long)yars_sim_time_ns(&s));
  fflush(stdout);
  if (strcmp(argv[2], "stay") == 0)
    while (getchar() != EOF) {
    }
  yars_detach(&s);
  return code;
}
