// Flight along a recorded track, and the track's file.
#pragma once

#include <string_view>
#include <vector>

#include "databuffer/flight/motion.hpp"
#include "lib/error/error.hpp"

namespace yars::databuffer::flight {

// A recorded track: comma separated rows below a header row that names the columns, in any order, of
//   time [s], lat, lon [deg WGS84], alt_ft [ft above sea level], heading [deg true], pitch, roll [deg].
// Other columns are passed over. Times ascend. `#` begins a comment; a line `loop` at the end begins anew after
// the last row, which should then lie where the first one does.
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

// `name` is the file's, for errors: they carry the line.
error::Expected<Track> parse_track(std::string_view text, std::string_view name);

// Flies a recorded track: between two rows along the geodesic at a steady speed, attitude turned the shorter way
// (heading with respect to the geodesic, so that it holds at the poles too); velocity is that of the rows' places.
// At the end it stands where the last row is, or begins anew. It follows its file alone: it cannot be placed, but
// goes on from the time into the track that a predecessor told.
class TrackFlight final : public FlightModel {
 public:
  explicit TrackFlight(Track track);
  FlightSample step(geo::Duration dt) override;
  void reset() override;
  bool reposition(const Placement& placement) override;
  bool resume(const Ownship& last, geo::Duration gap) override;

 private:
  // Between a row and the next.
  struct Stretch {
    geo::GeodesicRay ray;
    geo::Length length;
    geo::Angle nose_at_start;  // heading against the geodesic
    geo::Angle nose_turn;      // by which that changes until the next row
  };
  static Stretch stretch_between(const TrackRow& from, const TrackRow& to);

  FlightSample present();
  void find_row();
  FlightSample sample_between(double share) const;
  FlightSample sample_at_end() const;

  Track track_;
  geo::Duration elapsed_;  // since the first row
  std::size_t row_ = 0;    // the stretch begins here
  Stretch stretch_;
};

}  // namespace yars::databuffer::flight
