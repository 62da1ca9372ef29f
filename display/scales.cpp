#include "display/scales.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "display/video_levels.hpp"

namespace yars::display {

namespace {

// Azimuth scale, along the bottom at the apex. The window size stands below it, the message above.
constexpr float kAzimuthZero = 240.0F;  // [units] x of 0 deg
constexpr float kAzimuthUnitsPerDegree = 2.0F;
constexpr float kAzimuthTickTop = 438.0F, kAzimuthTickBottom = 445.0F;
constexpr float kAzimuthTrack = 64.0F;  // [deg] the caret stops here
constexpr float kLimitBallRadius = 3.0F;
constexpr float kLimitBallTrack = 115.0F;  // [deg] the limit balls stop here, at the edge of the glass

// Elevation scale, in the column between the legends of the left side and the picture.
constexpr float kElevationZero = 240.0F;  // [units] y of the horizon
constexpr float kElevationUnitsPerDegree = 8.0F;
constexpr float kElevationTickLeft = 68.0F;
constexpr float kTrackTop = 46.0F, kTrackBottom = 434.0F;  // [units] carets and ball stop here
constexpr float kBallColumn = 92.0F;
constexpr float kBallRadius = 5.5F;
constexpr float kWing = 5.0F;
constexpr float kCaretLength = 8.0F, kCaretHalf = 4.0F;

// Gray scale, in the lower right, where no beam of +-60 deg reaches.
constexpr Rect kGrayScale{420.0F, 344.0F, 434.0F, 424.0F};

constexpr float kSector = 60.0F;      // [deg] arcs reach to the gimbal limit
constexpr double kUsualArcs = 0.25;   // of the range from arc to arc
constexpr double kFinestArcs = 0.05;  // closer arcs would hide the video

float on_track(double degrees) {
  const float y = kElevationZero - kElevationUnitsPerDegree * static_cast<float>(degrees);
  return std::clamp(y, kTrackTop, kTrackBottom);
}

float x_of(float degrees) {
  return kAzimuthZero + kAzimuthUnitsPerDegree * degrees;
}

float tick_length(int degrees) {
  return degrees == 0 ? 12.0F : std::abs(degrees) >= 5 ? 8.0F : 5.0F;
}

}  // namespace

void draw_azimuth_scale(double antenna_right_of_track_deg, DrawList& list) {
  for (const float degrees : {-60.0F, 0.0F, 60.0F}) {
    list.line({x_of(degrees), kAzimuthTickTop}, {x_of(degrees), kAzimuthTickBottom});
  }
  const float x = x_of(std::clamp(static_cast<float>(antenna_right_of_track_deg), -kAzimuthTrack, kAzimuthTrack));
  const float tip = kAzimuthTickTop - 1.0F;
  const std::array<Point, 3> caret{Point{x - kCaretHalf, tip - kCaretLength}, Point{x, tip},
                                   Point{x + kCaretHalf, tip - kCaretLength}};
  list.polyline(caret);
  list.occupy("azimuth scale",
              {x_of(-kAzimuthTrack) - kCaretHalf, tip - kCaretLength - 1.0F, x_of(kAzimuthTrack) + kCaretHalf,
               kAzimuthTickBottom + 1.0F},
              BoxKind::scale);
  list.occupy("azimuth ticks", {x_of(-60.0F) - 2.0F, kAzimuthTickTop - 1.0F, x_of(60.0F) + 2.0F, kAzimuthTickBottom},
              BoxKind::solid);
}

void draw_limit_balls(double left_deg, double right_deg, double blind_zone_deg, DrawList& list) {
  constexpr float middle = (kAzimuthTickTop + kAzimuthTickBottom) / 2.0F;
  const auto blind = static_cast<float>(blind_zone_deg);
  for (const float degrees : {-blind, blind}) list.line({x_of(degrees), middle}, {x_of(degrees), kAzimuthTickBottom});
  for (const double degrees : {left_deg, right_deg}) {
    const float x = x_of(std::clamp(static_cast<float>(degrees), -kLimitBallTrack, kLimitBallTrack));
    list.circle({x, middle}, kLimitBallRadius);
    list.occupy("limit ball", grown({x, middle, x, middle}, kLimitBallRadius + 1.0F), BoxKind::scale);
  }
}

void draw_elevation_scale(double antenna_deg, DrawList& list) {
  for (const int degrees : {-10, -5, -2, -1, 0, 1, 2, 5, 10}) {
    const float y = on_track(degrees);
    list.line({kElevationTickLeft, y}, {kElevationTickLeft + tick_length(degrees), y});
  }
  const float y = on_track(antenna_deg);
  const float tip = kElevationTickLeft - 1.0F;
  const std::array<Point, 3> caret{Point{tip - kCaretLength, y - kCaretHalf}, Point{tip, y},
                                   Point{tip - kCaretLength, y + kCaretHalf}};
  list.polyline(caret);
  list.occupy("elevation scale",
              {tip - kCaretLength, kTrackTop - kBallRadius - kWing, kBallColumn + kBallRadius + kWing,
               kTrackBottom + kBallRadius},
              BoxKind::scale);
}

void draw_pitch_ball(double pitch_deg, double roll_deg, AttitudeSource source, DrawList& list) {
  const Point center{kBallColumn, on_track(pitch_deg)};
  const float r = kBallRadius;
  if (source == AttitudeSource::ahrs) {
    const std::array<Point, 4> corners{Point{center.x - r, center.y - r}, Point{center.x + r, center.y - r},
                                       Point{center.x + r, center.y + r}, Point{center.x - r, center.y + r}};
    list.polygon(corners, false);
  } else {
    list.circle(center, r);
  }
  if (source == AttitudeSource::invalid) {
    const float d = r + 2.0F;
    list.line({center.x - d, center.y - d}, {center.x + d, center.y + d});
    list.line({center.x - d, center.y + d}, {center.x + d, center.y - d});
    return;
  }
  // Wings show the bank: right wing down, right stub down.
  const auto cosine = static_cast<float>(std::cos(roll_deg * geo::kRadiansPerDegree));
  const auto sine = static_cast<float>(std::sin(roll_deg * geo::kRadiansPerDegree));
  for (const float side : {-1.0F, 1.0F}) {
    const auto out = [&](float length) {
      return Point{center.x + side * length * cosine, center.y + side * length * sine};
    };
    list.line(out(r), out(r + kWing));
  }
}

double arc_spacing(double range_nm, std::size_t range_index, std::span<const double> spacing_nm) {
  if (spacing_nm.empty()) return kUsualArcs;
  double spacing = spacing_nm[std::min(range_index, spacing_nm.size() - 1)] / range_nm;
  if (!(spacing > 0.0)) return kUsualArcs;
  while (spacing < kFinestArcs) spacing *= 2.0;
  return spacing;
}

void draw_range_arcs(const GlassView& view, double spacing, DrawList& list) {
  constexpr double kWhole = 1e-9;  // a spacing that divides the range may miss its end by rounding
  list.draw_on(Layer::grid);
  const auto arc = [&](double fraction) {
    list.thin_arc(view.apex(), static_cast<float>(fraction) * view.units_per_range(), -kSector, kSector);
  };
  for (int i = 1; i * spacing < 1.0 - kWhole; ++i) arc(i * spacing);
  arc(1.0);
  list.draw_on(Layer::symbols);
}

void draw_zero_azimuth_line(const GlassView& view, DrawList& list) {
  list.draw_on(Layer::grid);
  list.line(view.apex(), view.at_polar(0.0, 1.0), Ink::dim);
  list.draw_on(Layer::symbols);
}

void draw_gray_scale(DrawList& list) {
  const float height = (kGrayScale.bottom - kGrayScale.top) / kGrays;
  for (int gray = 0; gray < kGrays; ++gray) {
    // The middle of the gray's eighth of the video's reach, black at the bottom.
    const auto video = static_cast<std::uint8_t>((gray * 256 + 128) / kGrays);
    const float bottom = kGrayScale.bottom - height * static_cast<float>(gray);
    list.video_step({kGrayScale.left, bottom - height, kGrayScale.right, bottom}, video);
  }
  const std::array<Point, 5> frame{Point{kGrayScale.left, kGrayScale.top}, Point{kGrayScale.right, kGrayScale.top},
                                   Point{kGrayScale.right, kGrayScale.bottom},
                                   Point{kGrayScale.left, kGrayScale.bottom}, Point{kGrayScale.left, kGrayScale.top}};
  list.polyline(frame, Ink::dim);
  list.occupy("gray scale", kGrayScale, BoxKind::solid);
}

}  // namespace yars::display
