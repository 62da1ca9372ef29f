// Flight along a recorded track, and the parser of the track file.
// Inputs: track text; steps of sim time.
// Outputs: Ownship and Nav.
// Errors: fewer than two rows; a missing column, times that do not ascend, a value out of range, or text after `loop`
// (the error then names the line).
// Source: docs/spec/formats.md#csv.
#pragma once

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

}  // namespace yars::flightmodel
