/* yars_header_client.c with libyars-client in place of yars.h, in strict C99: the same arguments, the same output. */
#include <stdio.h>
#include <string.h>

#include "databuffer/client/yars_client.h"

static int give_up(void) {
  fprintf(stderr, "%s\n", yars_client_error());
  return 1;
}

static int publish_all(yars_client* c) {
  yars_radar_state state;
  yars_model_status status;
  if (yars_client_read_radar_state(c, &state) != 1) return 2;
  if (yars_client_read_model_status(c, &status) != 0) return 3; /* none has been published */
  yars_ownship ownship = {0};
  ownship.latitude_deg = 34.5;
  ownship.altitude_msl_m = state.range_nm; /* copied, so that the test sees that the state was read */
  ownship.epoch = yars_client_epoch(c);
  strcpy(ownship.source, "c client");
  yars_nav nav = {0};
  nav.ins_longitude_deg = -120.25;
  if (yars_client_publish_ownship(c, &ownship) != 0 || yars_client_publish_nav(c, &nav) != 0) return give_up();
  yars_traffic traffic = {0};
  traffic.count = 1;
  traffic.entities[0].latitude_deg = 34.25;
  traffic.entities[0].id = 9;
  if (yars_client_claim_traffic(c) != 0 || yars_client_publish_traffic(c, &traffic) != 0) return give_up();
  yars_input_event event = {0};
  event.kind = YARS_EVENT_PUSH_BUTTON;
  event.argument = 13;
  strcpy(event.text, "from C");
  return yars_client_push_event(c, &event) == 0 ? 0 : give_up();
}

/* Prints the size of the newest display frame and the sum of its bytes, which the test compares. */
static int print_frame(yars_client* c) {
  const unsigned char* pixels = NULL;
  yars_glass_frame frame;
  unsigned long sum = 0;
  if (yars_client_read_frame(c, 0, &frame, &pixels) != 1) return 4;
  for (size_t i = 0; i < (size_t)frame.width * frame.height * 4; ++i) sum += pixels[i];
  if (yars_client_read_frame(c, frame.id, &frame, &pixels) != 0) return 5; /* no frame is newer than this one */
  printf("%u x %u: %lu\n", frame.width, frame.height, sum);
  return 0;
}

int main(int argc, char** argv) {
  yars_client* c = NULL;
  if (argc != 3) return 64;
  if (yars_client_attach(argv[1], "c-client", &c) != 0) return give_up();
  if (yars_client_claim_ownship(c, 70) < 0 || yars_client_claim_input(c, "c input") < 0) return give_up();
  if (yars_client_heartbeat(c) != 0) return give_up();
  if (strcmp(argv[2], "look") == 0) {
    const int seen = print_frame(c);
    yars_client_detach(c);
    return seen;
  }
  const int code = publish_all(c);
  printf("%lld\n", (long long)yars_client_sim_time_ns(c));
  fflush(stdout);
  if (strcmp(argv[2], "stay") == 0)
    while (getchar() != EOF) {
    }
  yars_client_detach(c);
  return code;
}
