#include "flightmodel/source_reader.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "flightmodel/motion.hpp"
#include "flightmodel/route_flight.hpp"
#include "lib/file/text_file.hpp"
#include "lib/text/plain_text.hpp"
#include "lib/values/fields.hpp"

namespace yars::flightmodel {

namespace {

using error::Expected;
using error::fail;

// Columns in the order in which parse_row() reads them, with their ranges. Headings may be -180..180 or 0..360.
const std::vector<file::NumberField> kColumns{
    {"time", 0.0, 1e9},         {"lat", -90.0, 90.0},
    {"lon", -180.0, 180.0},     {"alt_ft", values::Pose::altitude.low, values::Pose::altitude.high},
    {"heading", -180.0, 360.0}, {"pitch", -90.0, 90.0},
    {"roll", -180.0, 180.0},
};

using ColumnIndices = std::vector<std::size_t>;  // for each of kColumns, the index of its field in a row

Expected<ColumnIndices> parse_header(std::string_view line, const std::string& line_name) {
  const auto names = text::fields_of(line, ',');
  ColumnIndices indices;
  for (const file::NumberField& column : kColumns) {
    const auto found = std::ranges::find(names, column.name);
    if (found == names.end())
      return fail(line_name, "a header row with time,lat,lon,alt_ft,heading,pitch,roll",
                  "no column " + std::string(column.name));
    indices.push_back(static_cast<std::size_t>(found - names.begin()));
  }
  return indices;
}

Expected<TrackRow> parse_row(std::string_view line, const ColumnIndices& indices, const std::string& line_name) {
  const auto fields = text::fields_of(line, ',');
  if (fields.size() <= *std::ranges::max_element(indices))
    return fail(line_name, "a field for each required column", std::to_string(fields.size()));
  std::vector<std::string_view> texts;
  for (const std::size_t column : indices) texts.push_back(fields[column]);
  const auto numbers = file::parse_numbers(line_name, texts, kColumns, ",");
  if (!numbers) return tl::unexpected(numbers.error());
  const auto& value = *numbers;
  return TrackRow{geo::Duration::seconds(value[0]),
                  {value[1], value[2]},
                  geo::AltitudeMsl::feet(value[3]),
                  {geo::Bearing::degrees(value[4]), geo::Angle::degrees(value[5]), geo::Angle::degrees(value[6])}};
}

}  // namespace

Expected<Track> parse_track(std::string_view text, std::string_view name) {
  const auto lines = text::numbered_lines(text);
  if (lines.empty()) return fail(std::string(name), "a header row and at least two rows", "no line");
  const auto indices = parse_header(lines.front().text, file::line_location(name, lines.front().number));
  if (!indices) return tl::unexpected(indices.error());
  Track track;
  for (auto line = lines.begin() + 1; line != lines.end(); ++line) {
    const std::string line_name = file::line_location(name, line->number);
    if (track.loop) return fail(line_name, "nothing behind loop", '"' + std::string(line->text) + '"');
    track.loop = line->text == "loop";
    if (track.loop) continue;
    const auto row = parse_row(line->text, *indices, line_name);
    if (!row) return tl::unexpected(row.error());
    if (!track.rows.empty() && row->time <= track.rows.back().time)
      return fail(line_name, "a time after " + text::text_of_number(track.rows.back().time.seconds()) + " s",
                  text::text_of_number(row->time.seconds()) + " s");
    track.rows.push_back(*row);
  }
  if (track.rows.size() < 2) return fail(std::string(name), "at least two rows", std::to_string(track.rows.size()));
  return track;
}

namespace {

// Interpolates an angle in the shorter direction. `fraction`: 0 gives `from`, 1 gives `to`.
geo::Angle between(geo::Angle from, geo::Angle to, double fraction) {
  const double turn_deg = geo::wrapped_degrees(to.degrees() - from.degrees());
  return geo::Angle::degrees(geo::wrapped_degrees(from.degrees() + fraction * turn_deg));
}

}  // namespace

TrackFlight::Segment TrackFlight::segment_between(const TrackRow& from, const TrackRow& to) {
  const auto inverse = geo::geodesic_inverse(from.point, to.point);
  const geo::Angle at_start = from.attitude.heading - inverse.azimuth_at_start;
  const geo::Angle at_end = to.attitude.heading - inverse.azimuth_at_end;
  return {geo::GeodesicRay(from.point, inverse.azimuth_at_start), inverse.distance, at_start,
          geo::Angle::degrees(geo::wrapped_degrees(at_end.degrees() - at_start.degrees()))};
}

TrackFlight::TrackFlight(Track track)
    : track_(std::move(track)), segment_(segment_between(track_.rows[0], track_.rows[1])) {}

void TrackFlight::reset() {
  elapsed_ = {};
  row_ = 0;
  segment_ = segment_between(track_.rows[0], track_.rows[1]);
}

bool TrackFlight::reposition(const Placement&) {
  return false;
}

bool TrackFlight::resume(const databuffer::Ownship& last, geo::Duration gap) {
  const geo::Duration duration = track_.rows.back().time - track_.rows.front().time;
  if (!(last.flight_time_s > 0.0) || last.flight_time_s > duration.seconds()) return false;
  reset();
  elapsed_ = geo::Duration::seconds(last.flight_time_s) + gap;
  return true;
}

// Advances row_ and segment_ to the rows between which elapsed_ lies.
void TrackFlight::find_row() {
  const auto start_of = [this](std::size_t row) { return track_.rows[row].time - track_.rows.front().time; };
  const std::size_t before = row_;
  while (row_ + 2 < track_.rows.size() && elapsed_ >= start_of(row_ + 1)) ++row_;
  if (row_ != before) segment_ = segment_between(track_.rows[row_], track_.rows[row_ + 1]);
}

FlightSample TrackFlight::step(geo::Duration dt) {
  elapsed_ = elapsed_ + forward_step(dt);
  FlightSample sample = present();
  const geo::Duration duration = track_.rows.back().time - track_.rows.front().time;
  sample.ownship.flight_time_s = std::min(elapsed_, duration).seconds();
  return sample;
}

FlightSample TrackFlight::present() {
  const geo::Duration duration = track_.rows.back().time - track_.rows.front().time;
  if (track_.loop && elapsed_ >= duration) {
    const auto into_repeat = geo::Duration::seconds(std::fmod(elapsed_.seconds(), duration.seconds()));
    reset();
    elapsed_ = into_repeat;
  }
  if (elapsed_ >= duration) return sample_at_end();
  find_row();
  const geo::Duration start = track_.rows[row_].time - track_.rows.front().time;
  const geo::Duration length = track_.rows[row_ + 1].time - track_.rows[row_].time;
  return sample_between((elapsed_ - start) / length);
}

FlightSample TrackFlight::sample_between(double fraction) const {
  const TrackRow& from = track_.rows[row_];
  const TrackRow& to = track_.rows[row_ + 1];
  const double seconds = (to.time - from.time).seconds();
  const auto end = segment_.ray.position_and_azimuth(fraction * segment_.length);
  const geo::Length rise = to.altitude - from.altitude;
  Motion motion{end.point, from.altitude + fraction * rise, end.azimuth, {}, {}};
  motion.ground_speed = speed_at_altitude(motion, geo::Speed::metres_per_second(segment_.length.metres() / seconds));
  motion.climb = geo::Speed::metres_per_second(rise.metres() / seconds);
  const Attitude attitude{end.azimuth + segment_.crab_at_start + fraction * segment_.crab_change,
                          from.attitude.pitch + fraction * (to.attitude.pitch - from.attitude.pitch),
                          between(from.attitude.roll, to.attitude.roll, fraction)};
  return sample_of(motion, attitude, "csv");
}

FlightSample TrackFlight::sample_at_end() const {
  const TrackRow& last = track_.rows.back();
  return sample_of({last.point, last.altitude, last.attitude.heading, {}, {}}, last.attitude, "csv");
}

error::Expected<FixedSetting> parse_fixed(std::string_view text) {
  const auto numbers = file::parse_numbers("fixed", text::fields_of(text, ','),
                                           {{"LAT", -90.0, 90.0},
                                            {"LON", -180.0, 180.0},
                                            {"ALT_FT", values::Pose::altitude.low, values::Pose::altitude.high},
                                            {"HDG", values::Pose::heading.low, values::Pose::heading.high},
                                            {"KT", 0.0, values::Reposition::speed.high}},
                                           ",");
  if (!numbers) return tl::unexpected(numbers.error());
  const auto& value = *numbers;
  return FixedSetting{{{value[0], value[1]}, geo::AltitudeMsl::feet(value[2]), geo::Bearing::degrees(value[3])},
                      geo::Speed::knots(value[4])};
}

FixedFlight::FixedFlight(const FixedSetting& setting)
    : setting_(setting),
      ground_speed_(setting.ground_speed),
      origin_(setting.start),
      ray_(setting.start.point, setting.start.heading) {}

void FixedFlight::reset() {
  reposition(setting_.start);
  ground_speed_ = setting_.ground_speed;
}

bool FixedFlight::reposition(const Placement& placement) {
  origin_ = placement;
  if (placement.ground_speed) ground_speed_ = *placement.ground_speed;
  ray_ = geo::GeodesicRay(placement.point, placement.heading);
  flown_ = geo::Length();
  return true;
}

FlightSample FixedFlight::step(geo::Duration dt) {
  const auto motion_here = [this] {
    const auto end = ray_.position_and_azimuth(flown_);
    return Motion{end.point, origin_.altitude, end.azimuth, ground_speed_, {}};
  };
  const Motion before = motion_here();
  const auto flown = geo::Length::metres(ground_speed_.metres_per_second() * forward_step(dt).seconds());
  flown_ = flown_ + surface_distance(before, flown);
  const Motion motion = motion_here();
  return sample_of(motion, coordinated_attitude(motion, {}), "fixed");
}

namespace {

using error::Expected;

constexpr std::string_view kForms =
    "route:FILE, fixed:LAT,LON,ALT_FT,HDG,KT, csv:FILE, flightgear:PORT, jsbsim:PORT, xplane:HOST:PORT or dis:PORT";

Expected<FlightSource> open_fixed(std::string_view setting) {
  auto parsed = parse_fixed(setting);
  if (!parsed) return tl::unexpected(error::usage_error(parsed.error()));
  return FlightSource{std::make_unique<FixedFlight>(*parsed), "fixed:" + std::string(setting)};
}

Expected<FlightSource> open_route(std::string_view file) {
  const auto text = file::read_text_file(file);
  if (!text) return tl::unexpected(text.error());
  auto route = parse_route(*text, file);
  if (!route) return tl::unexpected(route.error());
  const std::string length = text::counted(route->waypoints.size(), "waypoint") + (route->loop ? ", looped" : "");
  return FlightSource{std::make_unique<RouteFlight>(*std::move(route)), "route " + std::string(file) + ", " + length};
}

Expected<FlightSource> open_track(std::string_view file) {
  const auto text = file::read_text_file(file);
  if (!text) return tl::unexpected(text.error());
  auto track = parse_track(*text, file);
  if (!track) return tl::unexpected(track.error());
  const std::string length = text::counted(track->rows.size(), "row") + (track->loop ? ", looped" : "");
  return FlightSource{std::make_unique<TrackFlight>(*std::move(track)), "track " + std::string(file) + ", " + length};
}

}  // namespace

Expected<FlightSource> open_source(std::string_view text) {
  const std::size_t colon = std::min(text.find(':'), text.size());
  const std::string_view kind = text.substr(0, colon);
  const std::string_view rest = text.substr(std::min(colon + 1, text.size()));
  if (kind == "fixed") return open_fixed(rest);
  if (kind == "route" && !rest.empty()) return open_route(rest);
  if (kind == "csv" && !rest.empty()) return open_track(rest);
  static const std::vector<std::string> kKinds{"route:", "fixed:", "csv:", "flightgear:", "jsbsim:", "xplane:", "dis:"};
  const std::string named = std::string(kind) + ':';
  const bool is_known = std::ranges::find(kKinds, named) != kKinds.end();  // a known kind without its argument
  return tl::unexpected(error::usage_error("--source", std::string(kForms), '"' + std::string(text) + '"',
                                           is_known ? "" : text::did_you_mean(named, kKinds)));
}

}  // namespace yars::flightmodel
