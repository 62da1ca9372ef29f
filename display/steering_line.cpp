#include "display/steering_line.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <string_view>

#include "databuffer/records/navigation.hpp"

namespace yars::display {

namespace {

using databuffer::SteeringLine;

constexpr float kBegin = 10.0F, kEnd = 70.0F;  // [units] from the target: clear of its symbol, long enough to aim by
constexpr float kArrow = 8.0F, kRing = 4.0F;   // [units]

// Off along a direction of the glass, degrees clockwise from up.
Point off(Point from, double direction_deg, float distance) {
  const double angle_rad = direction_deg * geo::kRadiansPerDegree;
  return {from.x + distance * static_cast<float>(std::sin(angle_rad)),
          from.y - distance * static_cast<float>(std::cos(angle_rad))};
}

// Points the way the aircraft is to fly.
void draw_arrowhead(Point end, double approach_deg, DrawList& list) {
  constexpr double kSpread_deg = 150.0;
  const std::array<Point, 3> head{off(end, approach_deg - kSpread_deg, kArrow), end,
                                  off(end, approach_deg + kSpread_deg, kArrow)};
  list.polyline(head);
}

Label heading_label(double magnetic_deg, Point target) {
  std::array<char, 16> text{};
  // 359.6 rounds to 360, which reads 000.
  const double shown_deg = std::fmod(std::round(magnetic_deg) + 720.0, 360.0);
  const int length = std::snprintf(text.data(), text.size(), "%03.0f\u00b0", shown_deg);
  return label_of(LabelRole::heading, {text.data(), static_cast<std::size_t>(length)}, target);
}

}  // namespace

std::optional<Label> draw_steering_line(const GlassInput& input, const GlassView& view, const GlassFrame& frame,
                                        DrawList& list) {
  const databuffer::RadarState& state = input.state;
  const auto line = static_cast<SteeringLine>(state.steering_line);
  if ((state.flags & databuffer::kTargetDesignated) == 0 || line == SteeringLine::none) return std::nullopt;
  const auto belief = databuffer::belief_in_use(input.ownship, input.nav, state);
  const Point target = view.at_ground(frame, belief.on_video({state.target_latitude_deg, state.target_longitude_deg}));
  if (!on_glass(target)) return std::nullopt;
  const double approach_deg = (geo::Bearing::degrees(state.steering_line_deg) - frame.up).degrees();
  const double back_deg = approach_deg + 180.0;
  const Point end = off(target, back_deg, kEnd);
  list.draw_on(Layer::lines);
  const bool ring = line == SteeringLine::fixed;
  list.line(off(target, back_deg, kBegin), ring ? off(target, back_deg, kEnd - kRing) : end);
  if (ring) list.circle(end, kRing);
  if (line == SteeringLine::slewing) draw_arrowhead(end, approach_deg, list);
  list.draw_on(Layer::symbols);
  return heading_label(state.steering_line_deg - state.magnetic_variation_deg, target);
}

}  // namespace yars::display
