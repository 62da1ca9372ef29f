// Factory of the flight model that the option `--source` names; straight and level flight; flight along a recorded
// track.
// Inputs: route:FILE, fixed:LAT,LON,ALT_FT,HDG,KT or csv:FILE; track text; steps of sim time. flightmodel/bridges has
// the other sources.
// Outputs: a FlightModel with a description for the log; Ownship and Nav.
// Errors: a malformed option value is a usage error (Error::bad_usage). An error in a file names the line. Of a track:
// fewer than two rows; a missing column, times that do not ascend, a value out of range, or text after `loop`.
// Source: docs/spec/formats.md#csv.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "flightmodel/motion.hpp"
#include "lib/error/error.hpp"

namespace yars::flightmodel {

// Row of a track file. Rows are comma-separated, below a header row with these columns in any order:
//   time [s], lat, lon [deg WGS84], alt_ft [ft above mean sea level], heading [deg true],
//   pitch [deg, nose up positive], roll [deg, right wing down positive].
// Other columns are ignored. Times ascend. `#` begins a comment. Ranges: time [0, 1e9] s, alt_ft of values::Pose,
// heading [-180, 360].
// A last line `loop` repeats the track from its first row. First and last row should then have the same position.
struct TrackRow {
  geo::Duration time;
  geo::GeoPoint point;
  geo::AltitudeMsl altitude;
  Attitude attitude;
};

struct Track {
  std::vector<TrackRow> rows;  // at least two
  bool loop = false;
};

// `name`: file name for errors.
error::Expected<Track> parse_track(std::string_view text, std::string_view name);

// Flies a recorded track. Between two rows the point below the aircraft follows the geodesic at constant speed, and
// the climb rate is constant.
// Pitch, roll, and the angle from the geodesic to the heading are interpolated linearly. Roll and this angle change in
// the shorter direction. The angle replaces the heading, so that the interpolation is valid near the poles.
// Ground speed is the distance between the rows, scaled to the aircraft's altitude, divided by their time difference.
// After the last row the position stays and the velocity is 0. With `loop` the track repeats instead.
// reposition() always returns false. resume() continues at last.flight_time_s + gap. It returns false if flight_time_s
// is not positive or exceeds the duration of the track.
class TrackFlight final : public FlightModel {
 public:
  explicit TrackFlight(Track track);
  FlightSample step(geo::Duration dt) override;
  void reset() override;
  bool reposition(const Placement& placement) override;
  bool resume(const databuffer::Ownship& last, geo::Duration gap) override;

 private:
  // Interpolation data between one row and the next.
  struct Segment {
    geo::GeodesicRay ray;
    geo::Length length;
    geo::Angle crab_at_start;  // heading minus azimuth of the geodesic, at the first of the two rows
    geo::Angle crab_change;    // change of this angle to the second row, in [-180, 180] deg
  };
  static Segment segment_between(const TrackRow& from, const TrackRow& to);

  FlightSample present();
  void find_row();
  FlightSample sample_between(double fraction) const;  // `fraction` of the time between the rows, [0, 1]
  FlightSample sample_at_end() const;

  Track track_;
  geo::Duration elapsed_;  // sim time since the first row; with `loop`, since the last return to it
  std::size_t row_ = 0;    // index of the row at which segment_ begins
  Segment segment_;
};

// Parameters of FixedFlight.
// Text form: LAT,LON,ALT_FT,HDG,KT in degrees, degrees, feet above mean sea level, degrees true, knots over ground.
struct FixedSetting {
  Placement start;
  geo::Speed ground_speed;
};

// Ranges: latitude [-90, 90], longitude [-180, 180], altitude [-1000, 200000] ft, heading [0, 360], speed [0, 5000] kt.
error::Expected<FixedSetting> parse_fixed(std::string_view text);

// Straight and level flight along a geodesic at constant speed. At 0 kt the aircraft stays at its position in the air.
class FixedFlight final : public FlightModel {
 public:
  explicit FixedFlight(const FixedSetting& setting);
  FlightSample step(geo::Duration dt) override;
  void reset() override;
  bool reposition(const Placement& placement) override;

 private:
  FixedSetting setting_;
  geo::Speed ground_speed_;
  Placement origin_;  // origin of ray_: the start, or the position and heading of the last repositioning
  geo::GeodesicRay ray_;
  geo::Length flown_;  // distance from the origin along ray_, on the ellipsoid
};

// Flight model that a value of `--source` names.
struct FlightSource {
  std::unique_ptr<FlightModel> model;
  std::string description;  // for the log: kind, file, number of waypoints or rows
};

// Makes the flight model and reads its file. `text`: value of `--source`.
error::Expected<FlightSource> open_source(std::string_view text);

}  // namespace yars::flightmodel
