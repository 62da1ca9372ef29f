#include "tests/fuzz/attaching_client.h"

#include "databuffer/client/yars.h"

int attach_as_a_client(const char* session_name) {
  yars_session session;
  if (yars_attach(&session, session_name, "fuzz client") != 0) return 0;
  static unsigned char pixels[YARS_MOST_FRAME_BYTES];
  yars_radar_state state;
  yars_outputs outputs;
  yars_model_status status;
  yars_glass_frame frame;
  yars_read_radar_state(&session, &state);
  yars_read_outputs(&session, &outputs);
  yars_read_model_status(&session, &status);
  yars_read_frame(&session, 0, &frame, pixels);
  yars_ownship own = {0};
  own.epoch = yars_epoch(&session);
  yars_nav nav = {0};
  yars_input_event event = {0};
  event.kind = 3; /* TDC press */
  if (yars_claim_ownship_lane(&session, 50) >= 0) {
    yars_publish_ownship(&session, &own);
    yars_publish_nav(&session, &nav);
  }
  if (yars_claim_input_lane(&session, "fuzz client") >= 0) yars_push_event(&session, &event);
  yars_detach(&session);
  return 1;
}
