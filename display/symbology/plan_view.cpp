#include "display/symbology/plan_view.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "databuffer/messages/derived_values.hpp"
#include "lib/geo/frames.hpp"
#include "lib/geo/geodesy.hpp"
#include "lib/radar/view.hpp"

namespace yars::display {

PlanView::PlanView(const radar::ViewConfiguration& view) {
  const double width = view.width_max - view.width_min;
  const double height = view.height_max - view.height_min;
  const double edge = static_cast<double>(kDisplayUnits);
  const double scale = edge / std::max(width, height);
  // Both axes have the same scale. The shorter side is centered.
  const double left = (edge - width * scale) / 2.0;
  const double bottom = edge - (edge - height * scale) / 2.0;
  apex_ = {static_cast<float>(left - view.width_min * scale), static_cast<float>(bottom + view.height_min * scale)};
  units_per_range_ = static_cast<float>(scale);
}

PlanView::PlanView(const databuffer::PatchMap& map) {
  const double edge = static_cast<double>(kDisplayUnits);
  const double distance = map.distance_m / frame_of(map).range_m;
  apex_ = {kDisplayUnits / 2.0F, static_cast<float>(edge / 2.0 + distance * edge)};
  units_per_range_ = kDisplayUnits;
}

Point PlanView::at_polar(double right_deg, double fraction) const {
  const double angle = right_deg * geo::kRadiansPerDegree;
  const double length = fraction * static_cast<double>(units_per_range_);
  return {apex_.x + static_cast<float>(length * std::sin(angle)),
          apex_.y - static_cast<float>(length * std::cos(angle))};
}

Point PlanView::at_ground(const ViewFrame& frame, geo::GeoPoint position) const {
  const geo::GeodesicInverse line = geo::geodesic_inverse(frame.apex, position);
  return at_polar((line.azimuth_at_start - frame.up).degrees(), line.distance.metres() / frame.range_m);
}

ViewFrame frame_of(const databuffer::PatchMap& map) {
  return {{map.apex_latitude_deg, map.apex_longitude_deg},
          geo::Bearing::degrees(map.up_deg),
          map.window_nm * geo::kMetresPerNauticalMile};
}

double displacement_units(const PlanView& view, const ViewFrame& drawn, const ViewFrame& present) {
  if (drawn.range_m != present.range_m) return std::numeric_limits<double>::infinity();
  const double moved = geo::geodesic_inverse(drawn.apex, present.apex).distance.metres() / present.range_m;
  const double turned = std::abs((present.up - drawn.up).radians());
  return (moved + turned) * static_cast<double>(view.units_per_range());
}

std::optional<Movement> movement_units(const PlanView& view, const ViewFrame& drawn, const ViewFrame& present) {
  constexpr double kNear_m = 1.0;  // between nearer apexes the azimuth is of no account, and may be undefined
  const geo::GeodesicInverse line = geo::geodesic_inverse(drawn.apex, present.apex);
  const double moved_m = line.distance.metres();
  if (drawn.range_m != present.range_m || !(moved_m <= drawn.range_m)) return std::nullopt;
  const bool near = moved_m < kNear_m;
  const double aside = near ? 0.0 : (line.azimuth_at_start - drawn.up).radians();
  // A straight flight changes its true bearing where meridians converge.
  const double convergence = near ? 0.0 : (line.azimuth_at_end - line.azimuth_at_start).radians();
  const double turned = std::remainder((present.up - drawn.up).radians() - convergence, 2.0 * std::numbers::pi);
  const auto units = static_cast<double>(view.units_per_range());
  const double moved = moved_m / drawn.range_m * units;
  return Movement{moved * std::cos(aside), moved * std::abs(std::sin(aside)) + std::abs(turned) * units};
}

namespace {

constexpr double kMinRange_m =
    geo::kMetresPerNauticalMile;  // used while RadarState has no range, to avoid a division by 0

}  // namespace

ViewFrame present_frame(const DisplayInput& input, const StoredSweep* newest) {
  const double range_m = input.state.range_nm * geo::kMetresPerNauticalMile;
  ViewFrame frame;
  frame.range_m = range_m > 0.0 ? range_m : kMinRange_m;
  const bool frozen = (input.model.flags & databuffer::kModelFrozen) != 0;
  if (frozen && newest != nullptr) {
    frame.apex = newest->apex;
    frame.up = newest->ground_track;
  } else {
    frame.apex = {input.ownship.latitude_deg, input.ownship.longitude_deg};
    frame.up = databuffer::ground_track_of(input.ownship);
  }
  return frame;
}

namespace {

// Converts earth-centred positions to display units, by projection to the tangent plane at the apex of the frame.
class GroundPlan {
 public:
  GroundPlan(const PlanView& view, const ViewFrame& frame)
      : tangent_(frame.apex, geo::HeightAboveEllipsoid::metres(0.0)),
        apex_(view.apex()),
        units_per_metre_(static_cast<double>(view.units_per_range()) / frame.range_m),
        sine_(std::sin(frame.up.radians())),
        cosine_(std::cos(frame.up.radians())) {}

  Point at(geo::Vector3 ecef) const {
    const geo::Vector3 enu = tangent_.enu_from_ecef(ecef);
    const double right_m = enu.x * cosine_ - enu.y * sine_;
    const double up_m = enu.x * sine_ + enu.y * cosine_;
    return {apex_.x + static_cast<float>(right_m * units_per_metre_),
            apex_.y - static_cast<float>(up_m * units_per_metre_)};
  }

  // Direction from one position to another, as a unit vector on the display.
  Point direction(geo::Vector3 from_ecef, geo::Vector3 to_ecef) const {
    const geo::Vector3 from = tangent_.enu_from_ecef(from_ecef);
    const geo::Vector3 to = tangent_.enu_from_ecef(to_ecef);
    const double east = to.x - from.x;
    const double north = to.y - from.y;
    const double length = std::hypot(east, north);
    return {static_cast<float>((east * cosine_ - north * sine_) / length),
            static_cast<float>(-(east * sine_ + north * cosine_) / length)};
  }

  double units_per_metre() const { return units_per_metre_; }

 private:
  geo::LocalTangentFrame tangent_;
  Point apex_;
  double units_per_metre_;
  double sine_, cosine_;
};

// Leaves out the samples beyond the arc of the selected range about the present apex.
void cut_at_outer_arc(Wedge& wedge, const PlanView& view) {
  const Point from{wedge.apex.x - view.apex().x, wedge.apex.y - view.apex().y};
  const Point both{wedge.left.x + wedge.right.x, wedge.left.y + wedge.right.y};
  const float length = std::hypot(both.x, both.y);
  const float along = (from.x * both.x + from.y * both.y) / length;
  const float arc = view.units_per_range();
  const float root = along * along + arc * arc - from.x * from.x - from.y * from.y;
  const float cut = root > 0.0F ? std::max(0.0F, std::sqrt(root) - along) : 0.0F;  // [units] from the wedge's apex
  if (cut >= wedge.range) return;
  const auto samples = static_cast<float>(wedge.samples);
  wedge.samples = static_cast<int>(std::lround(samples * cut / wedge.range));
  wedge.range *= static_cast<float>(wedge.samples) / samples;
}

}  // namespace

void place_wedges(const PolarStore& store, const PlanView& view, const ViewFrame& frame, std::vector<Wedge>& wedges,
                  std::uint64_t after) {
  const GroundPlan plan(view, frame);
  wedges.clear();
  for (const StoredSweep& sweep : store.by_azimuth()) {
    if (sweep.serial <= after) continue;
    Wedge wedge{plan.at(sweep.apex_ecef),
                plan.direction(sweep.apex_ecef, sweep.left_ecef),
                plan.direction(sweep.apex_ecef, sweep.right_ecef),
                static_cast<float>(sweep.range_m * plan.units_per_metre()),
                static_cast<float>(sweep.half_width_rad),
                sweep.row,
                sweep.samples,
                sweep.serial};
    constexpr double kRounding = 1.001;  // a sweep may be shortened by up to a sample (PolarStore)
    if (sweep.range_m > frame.range_m * kRounding) cut_at_outer_arc(wedge, view);
    if (wedge.samples > 0) wedges.push_back(wedge);
  }
  std::sort(wedges.begin(), wedges.end(), [](const Wedge& a, const Wedge& b) { return a.serial < b.serial; });
}

}  // namespace yars::display
