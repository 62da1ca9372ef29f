// A recorded track: comma separated rows below a header row that names the columns, in any order, of
//   time [s], lat, lon [deg WGS84], alt_ft [ft above sea level], heading [deg true], pitch, roll [deg].
// Other columns are passed over. Times ascend. `#` begins a comment; a line `loop` at the end begins anew after
// the last row, which should then lie where the first one does.
#pragma once

#include <string_view>
#include <vector>

#include "databuffer/flight/motion.hpp"
#include "lib/failure/error.hpp"

namespace yars::databuffer::flight {

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
failure::Expected<Track> parse_track(std::string_view text, std::string_view name);

}  // namespace yars::databuffer::flight
