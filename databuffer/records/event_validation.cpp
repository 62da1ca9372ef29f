#include "databuffer/records/event_validation.hpp"

#include <algorithm>
#include <array>

#include "databuffer/records/inspection.hpp"
#include "lib/radar/limits.hpp"
#include "lib/radar/modes.hpp"
#include "lib/radar/point_name.hpp"

namespace yars::databuffer {

namespace {

// [ft] and [ft/s] that the instructor may put in: 100 NM, and the speed of sound.
constexpr double kLargestInjectedError = 600'000.0;
constexpr double kLargestInjectedDrift = 1'000.0;

void inspect_word(Inspection& inspection, const InputEvent& event, int least, int most) {
  inspection.range("argument", event.argument, least, most);
}

void inspect_sign(Inspection& inspection, const InputEvent& event) {
  if (event.argument != 1 && event.argument != -1)
    inspection.fault("argument", "+1 or -1", std::to_string(event.argument));
}

void inspect_radar_mode(Inspection& inspection, const InputEvent& event) {
  constexpr std::array kCommanded{radar::Mode::rbm, radar::Mode::hrm, radar::Mode::beacon, radar::Mode::pvu};
  const auto matches = [&event](radar::Mode mode) { return event.argument == static_cast<int>(mode); };
  if (std::ranges::none_of(kCommanded, matches))
    inspection.fault("argument", "RBM 0, HRM 1, BCN 3 or PVU 4", std::to_string(event.argument));
}

void inspect_injected(Inspection& inspection, const InputEvent& event, double most) {
  inspect_word(inspection, event, 0, 1);
  inspection.range("x", event.x, -most, most);
  inspection.range("y", event.y, -most, most);
}

void inspect_name(Inspection& inspection, const InputEvent& event) {
  inspection.text("text", event.text);
  const auto end = std::ranges::find(event.text, '\0');
  if (!radar::point_name({event.text, static_cast<std::size_t>(end - event.text)}))
    inspection.fault("text", "a sequence point like 2, 2., 2.1, 2.01", "another name");
}

}  // namespace

Refusal why_refused(const InputEvent& event) {
  Inspection inspection;
  switch (static_cast<EventKind>(event.kind)) {
    case EventKind::push_button:
      inspect_word(inspection, event, 1, radar::kBezelButtons);
      break;
    case EventKind::tdc:
      inspection.range("x", event.x, -1.0, 1.0);
      inspection.range("y", event.y, -1.0, 1.0);
      break;
    case EventKind::elevation:
      inspection.range("x", event.x, -60.0, 60.0);
      break;
    case EventKind::elevation_step:
      // Whole travel of the antenna; zero steps are no event.
      inspect_word(inspection, event, -240, 240);
      if (event.argument == 0) inspection.fault("argument", "a step up or down", "0");
      break;
    case EventKind::acquisition:
    case EventKind::contrast:
      inspect_sign(inspection, event);
      break;
    case EventKind::master_mode:
    case EventKind::power:
      inspect_word(inspection, event, 0, 2);
      break;
    case EventKind::radar_mode:
      inspect_radar_mode(inspection, event);
      break;
    case EventKind::navigator:
      inspect_word(inspection, event, -1, 1);
      break;
    case EventKind::altimeter:
      inspect_word(inspection, event, 0, 1);
      break;
    case EventKind::sequence_point:
      inspect_name(inspection, event);
      break;
    case EventKind::navigator_error:
      inspect_injected(inspection, event, kLargestInjectedError);
      break;
    case EventKind::navigator_drift:
      inspect_injected(inspection, event, kLargestInjectedDrift);
      break;
    case EventKind::tdc_press:
    case EventKind::tdc_release:
    case EventKind::coolie_up:
    case EventKind::freeze:
      break;
    case EventKind::none:
    default:
      inspection.fault("kind", "1..18", std::to_string(event.kind));
  }
  return inspection.result();
}

}  // namespace yars::databuffer
