/* A user's own program as databuffer/yars.h promises it, in strict C99: takes the session's name, feeds an aircraft
 * and one event, and tells what it reads. yars_header_test.cpp starts it and looks at the other end. */
#include "databuffer/yars.h"
/* The header asks for its own extensions and comes first. */
#include <stdio.h>
#include <stdlib.h>

static int give_up(const yars_session* s) {
  fprintf(stderr, "%s\n", s->error);
  return 1;
}

static int feed(yars_session* s) {
  yars_radar_state state;
  yars_model_status status;
  if (yars_read_radar_state(s, &state) != 1) return 2;
  if (yars_read_model_status(s, &status) != 0) return 3; /* nobody has published one */
  yars_ownship ownship = {0};
  ownship.latitude_deg = 34.5;
  ownship.altitude_msl_m = state.range_nm; /* shows that the state was read */
  ownship.epoch = yars_epoch(s);
  strcpy(ownship.source, "c client");
  yars_nav nav = {0};
  nav.ins_longitude_deg = -120.25;
  if (yars_publish_ownship(s, &ownship) != 0 || yars_publish_nav(s, &nav) != 0) return give_up(s);
  yars_input_event event = {0};
  event.kind = 1;
  event.argument = 13;
  strcpy(event.text, "from C");
  return yars_push_event(s, &event) == 0 ? 0 : give_up(s);
}

int main(int argc, char** argv) {
  yars_session s;
  if (argc != 3) return 64;
  if (yars_attach(&s, argv[1], "c-client") != 0) return give_up(&s);
  if (yars_claim_ownship_lane(&s, 70) < 0 || yars_claim_input_lane(&s, "c input") < 0) return give_up(&s);
  yars_heartbeat(&s);
  int code = feed(&s);
  printf("%lld\n", (long long)yars_sim_time_ns(&s));
  fflush(stdout);
  if (strcmp(argv[2], "stay") == 0)
    while (getchar() != EOF) {
    }
  yars_detach(&s);
  return code;
}
