#include "databuffer/messages/validation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <string_view>

#include "databuffer/messages/inspection.hpp"
#include "databuffer/messages/record_checks.hpp"
#include "databuffer/messages/world_lists.hpp"
#include "lib/radar/modes.hpp"
#include "lib/text/plain_text.hpp"

// check_fields() is generated from the ranges in the IDL. This file checks the fields whose range applies only under a
// condition on another field, such as a flag, and conditions over several fields. The IDL marks both with @by_hand.
namespace yars::databuffer {

namespace {

// Checks the cursor. Without kCursorValid its fields may be NaN, but numbers must still be in range.
void inspect_cursor(Inspection& inspection, const RadarState& state) {
  using Range = RadarStateLimits;
  const Missing missing = (state.flags & kCursorValid) != 0U ? Missing::refused : Missing::allowed;
  inspection.range("cursor_latitude_deg", state.cursor_latitude_deg, Range::cursor_latitude_deg, missing);
  inspection.range("cursor_longitude_deg", state.cursor_longitude_deg, Range::cursor_longitude_deg, missing);
  inspection.range("cursor_bearing_deg", state.cursor_bearing_deg, Range::cursor_bearing_deg, missing);
  inspection.range("cursor_range_nm", state.cursor_range_nm, Range::cursor_range_nm, missing);
  inspection.range("cursor_believed_latitude_deg", state.cursor_believed_latitude_deg,
                   Range::cursor_believed_latitude_deg, missing);
  inspection.range("cursor_believed_longitude_deg", state.cursor_believed_longitude_deg,
                   Range::cursor_believed_longitude_deg, missing);
}

}  // namespace

Refusal validate(const RadarState& state) {
  Inspection inspection;
  check_fields(inspection, state);
  inspect_cursor(inspection, state);
  return inspection.result();
}

Refusal validate(const ClockState& clock) {
  using Range = ClockStateLimits;
  Inspection inspection;
  check_fields(inspection, clock);
  // A NaN latitude means that no repositioning took place. The other reposition fields are then not used.
  if (std::isnan(clock.reposition_latitude_deg)) return inspection.result();
  inspection.range("reposition_latitude_deg", clock.reposition_latitude_deg, Range::reposition_latitude_deg);
  inspection.range("reposition_longitude_deg", clock.reposition_longitude_deg, Range::reposition_longitude_deg);
  inspection.range("reposition_altitude_m", clock.reposition_altitude_m, Range::reposition_altitude_m);
  inspection.range("reposition_heading_deg", clock.reposition_heading_deg, Range::reposition_heading_deg);
  inspection.range("reposition_speed_mps", clock.reposition_speed_mps, Range::reposition_speed_mps);
  return inspection.result();
}

Refusal validate(const Caption& caption) {
  Inspection inspection;
  check_fields(inspection, caption);
  inspection.at_most("step", caption.step, caption.steps);
  return inspection.result();
}

namespace {

// Checks that no two of the entries in use have the same id.
template <class Entry>
void inspect_ids(Inspection& inspection, std::string_view list, std::span<const Entry> in_use) {
  for (std::size_t i = 1; i < in_use.size(); ++i) {
    const std::uint32_t id = in_use[i].id;
    const auto earlier = in_use.first(i);
    if (std::ranges::find(earlier, id, &Entry::id) != earlier.end())
      inspection.fault(std::string(list) + '[' + std::to_string(i) + "].id", "an id that no earlier entry has",
                       std::to_string(id));
  }
}

// Checks that each sequence point has a valid name, a kind that fits it, and no name or number of an earlier point.
void inspect_points(Inspection& inspection, std::span<const WorldPoint> points) {
  std::array<radar::NamedPoint, kMaxWorldPoints> earlier{};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::string field = "points[" + std::to_string(i) + ']';
    const std::string_view text = text::text_of(points[i].name);
    const auto kind = static_cast<radar::PointKind>(points[i].kind);
    const auto name = radar::point_name(text);
    if (!name) return inspection.fault(field + ".name", "a name such as 2, 2., 2.1 or 2.01", text);
    if (!radar::is_kind_of(kind, *name))
      inspection.fault(field + ".kind", "the kind that the name has", std::to_string(points[i].kind));
    if (radar::conflict(*name, std::span(earlier).first(i)) != nullptr)
      inspection.fault(field + ".name", "a name and number that no earlier point has", text);
    earlier[i] = {*name, kind};
  }
}

}  // namespace

Refusal validate(const WorldState& world) {
  Inspection inspection;
  check_fields(inspection, world);
  for_each_list([&]<class Entry>(std::type_identity<Entry>) {
    inspect_ids(inspection, Entry::Values::list.name, ListOf<Entry>::entries_in_use(world));
  });
  inspect_points(inspection, used(world.points, world.point_count));
  return inspection.result();
}

Refusal validate(const ModelTick& tick) {
  using Range = RadarCommandLimits;
  Inspection inspection;
  check_fields(inspection, tick);
  const RadarCommand& command = tick.command;
  const Missing missing = (command.flags & kCursorValid) != 0U ? Missing::refused : Missing::allowed;
  inspection.range("command.cursor_latitude_deg", command.cursor_latitude_deg, Range::cursor_latitude_deg, missing);
  inspection.range("command.cursor_longitude_deg", command.cursor_longitude_deg, Range::cursor_longitude_deg, missing);
  return inspection.result();
}

namespace {

// Limits of the position error (about 100 NM) and velocity error (drift, 305 m/s), north and east each, that an
// instructor injects into a navigator.
constexpr double kMaxInjectedError_ft = 600'000.0;
constexpr double kMaxInjectedDrift_fps = 1'000.0;

constexpr EventKind kLastKind = EventKind::cursor;

void inspect_argument(Inspection& inspection, const InputEvent& event, int lower, int upper) {
  inspection.range("argument", event.argument, lower, upper);
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

void inspect_injected(Inspection& inspection, const InputEvent& event, double upper) {
  inspect_argument(inspection, event, 0, 1);
  inspection.range("x", event.x, -upper, upper);
  inspection.range("y", event.y, -upper, upper);
}

void inspect_name(Inspection& inspection, const InputEvent& event) {
  inspection.text("text", event.text);
  const auto end = std::ranges::find(event.text, '\0');
  if (!radar::point_name({event.text, static_cast<std::size_t>(end - event.text)}))
    inspection.fault("text", "a sequence point like 2, 2., 2.1, 2.01",
                     '"' + std::string(event.text, static_cast<std::size_t>(end - event.text)) + '"');
}

// Checks the fields whose meaning depends on the kind.
void inspect_kind(Inspection& inspection, const InputEvent& event) {
  switch (static_cast<EventKind>(event.kind)) {
    case EventKind::push_button:
      inspect_argument(inspection, event, 1, radar::kBezelButtons);
      break;
    case EventKind::tdc:
      inspection.range("x", event.x, -1.0, 1.0);
      inspection.range("y", event.y, -1.0, 1.0);
      break;
    case EventKind::cursor:
      inspection.range("x", event.x, 0.0, 1.0);
      inspection.range("y", event.y, 0.0, 1.0);
      break;
    case EventKind::elevation:
      inspection.range("x", event.x, -kMaxElevation_deg, kMaxElevation_deg);
      break;
    case EventKind::elevation_step:
      inspect_argument(inspection, event, -kMaxElevationSteps, kMaxElevationSteps);
      if (event.argument == 0) inspection.fault("argument", "a step up or down", "0");
      break;
    case EventKind::acquisition:
    case EventKind::contrast:
      inspect_sign(inspection, event);
      break;
    case EventKind::master_mode:
    case EventKind::power:
      inspect_argument(inspection, event, 0, 2);
      break;
    case EventKind::radar_mode:
      inspect_radar_mode(inspection, event);
      break;
    case EventKind::navigator:
      inspect_argument(inspection, event, -1, 1);
      break;
    case EventKind::altimeter:
      inspect_argument(inspection, event, 0, 1);
      break;
    case EventKind::sequence_point:
      inspect_name(inspection, event);
      break;
    case EventKind::navigator_error:
      inspect_injected(inspection, event, kMaxInjectedError_ft);
      break;
    case EventKind::navigator_drift:
      inspect_injected(inspection, event, kMaxInjectedDrift_fps);
      break;
    case EventKind::tdc_press:
    case EventKind::tdc_release:
    case EventKind::castle_up:
    case EventKind::freeze:
    case EventKind::next:
      break;
    case EventKind::none:
    default:
      inspection.fault("kind", "1.." + std::to_string(static_cast<int>(kLastKind)), std::to_string(event.kind));
  }
}

}  // namespace

Refusal validate(const InputEvent& event) {
  Inspection inspection;
  check_fields(inspection, event);
  inspect_kind(inspection, event);
  return inspection.result();
}

Refusal validate(const AppliedEvent& applied) {
  Inspection inspection;
  check_fields(inspection, applied);
  inspect_kind(inspection, applied.event);
  return inspection.result();
}

}  // namespace yars::databuffer
