#include "databuffer/flight/track.hpp"

#include <algorithm>

#include "databuffer/flight/numbers.hpp"

namespace yars::databuffer::flight {

namespace {

using failure::Expected;
using failure::fail;

// In the order in which parse_row uses them. Headings are taken from either convention, -180..180 or 0..360.
const std::vector<NumberField> kColumns{
    {"time", 0.0, 1e9},         {"lat", -90.0, 90.0},   {"lon", -180.0, 180.0},  {"alt_ft", -3'000.0, 600'000.0},
    {"heading", -180.0, 360.0}, {"pitch", -90.0, 90.0}, {"roll", -180.0, 180.0},
};

using ColumnPlaces = std::vector<std::size_t>;  // for each of kColumns, its place in a row

Expected<ColumnPlaces> parse_header(std::string_view line, const std::string& place) {
  const auto names = fields_of(line, ',');
  ColumnPlaces places;
  for (const NumberField& column : kColumns) {
    const auto found = std::ranges::find(names, column.name);
    if (found == names.end())
      return fail(place, "a header row with time,lat,lon,alt_ft,heading,pitch,roll",
                  "no column " + std::string(column.name));
    places.push_back(static_cast<std::size_t>(found - names.begin()));
  }
  return places;
}

Expected<TrackRow> parse_row(std::string_view line, const ColumnPlaces& places, const std::string& place) {
  const auto fields = fields_of(line, ',');
  if (fields.size() <= *std::ranges::max_element(places))
    return fail(place, "as many fields as the header has", std::to_string(fields.size()));
  std::vector<std::string_view> texts;
  for (const std::size_t column : places) texts.push_back(fields[column]);
  const auto numbers = parse_numbers(place, texts, kColumns, ",");
  if (!numbers) return tl::unexpected(numbers.error());
  const auto& value = *numbers;
  return TrackRow{geo::Duration::seconds(value[0]),
                  {value[1], value[2]},
                  geo::AltitudeMsl::feet(value[3]),
                  {geo::Bearing::degrees(value[4]), geo::Angle::degrees(value[5]), geo::Angle::degrees(value[6])}};
}

}  // namespace

Expected<Track> parse_track(std::string_view text, std::string_view name) {
  const auto lines = numbered_lines(text);
  if (lines.empty()) return fail(std::string(name), "a header row and at least two rows", "no line");
  const auto places = parse_header(lines.front().text, place_in_file(name, lines.front().number));
  if (!places) return tl::unexpected(places.error());
  Track track;
  for (auto line = lines.begin() + 1; line != lines.end(); ++line) {
    const std::string place = place_in_file(name, line->number);
    if (track.loop) return fail(place, "nothing behind loop", '"' + std::string(line->text) + '"');
    track.loop = line->text == "loop";
    if (track.loop) continue;
    const auto row = parse_row(line->text, *places, place);
    if (!row) return tl::unexpected(row.error());
    if (!track.rows.empty() && row->time <= track.rows.back().time)
      return fail(place, "a time after " + text_of_number(track.rows.back().time.seconds()) + " s",
                  text_of_number(row->time.seconds()) + " s");
    track.rows.push_back(*row);
  }
  if (track.rows.size() < 2) return fail(std::string(name), "at least two rows", std::to_string(track.rows.size()));
  return track;
}

}  // namespace yars::databuffer::flight
