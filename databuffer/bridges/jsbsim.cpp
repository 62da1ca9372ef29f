#include "databuffer/bridges/jsbsim.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "databuffer/records/plain_text.hpp"

namespace yars::databuffer::bridges {

namespace {

constexpr std::string_view kLabels = "<LABELS>";

enum Value : std::size_t { kLatitude, kLongitude, kAltitude, kRoll, kPitch, kHeading, kNorth, kEast, kDown, kTime };

constexpr std::array<std::string_view, kJsbsimValues> kNames{"position/lat-geod-deg",  "position/long-gc-deg",
                                                             "position/h-sl-ft",       "attitude/phi-deg",
                                                             "attitude/theta-deg",     "attitude/psi-deg",
                                                             "velocities/v-north-fps", "velocities/v-east-fps",
                                                             "velocities/v-down-fps",  "Time"};

// Geocentric: 0.19 deg beside the geodetic one at 45 degrees, 11 NM off.
constexpr std::array<std::string_view, 4> kGeocentric{"lat-gc-deg", "lat-gc-rad", "Latitude (deg)",
                                                      "Latitude Geocentric (deg)"};

constexpr std::size_t kLongestShown = 24;  // [characters] of a broken field in a message

std::string_view last_part(std::string_view name) {
  return name.substr(name.find_last_of('/') + 1);
}

// JSBSim prints "lat-geod-deg" of "position/lat-geod-deg"; other versions, and other programs, print the whole.
bool names(std::string_view label, std::string_view property) {
  return label == property || last_part(label) == last_part(property);
}

// A field from outside as a message may hold it.
std::string shown(std::string_view field) {
  std::string text(field.substr(0, kLongestShown));
  std::ranges::replace_if(
      text, [](char character) { return character < ' ' || character > '~'; }, '?');
  return text;
}

failure::Error missing_columns(const std::vector<std::string_view>& labels, const std::string& missing) {
  const bool geocentric = std::ranges::any_of(labels, [](std::string_view label) {
    return std::ranges::find(kGeocentric, last_part(label)) != kGeocentric.end();
  });
  const std::string found = std::to_string(labels.size()) + " columns without " + missing +
                            (geocentric ? " (the latitude that is there is geocentric, up to 11 NM off)" : "");
  return {"jsbsim", "columns of place, attitude and velocity", found,
          "put <property>NAME</property> for each of them into the <output> of the aircraft", false};
}

}  // namespace

failure::Expected<JsbsimColumns> parse_jsbsim_labels(std::string_view line) {
  if (!line.starts_with(kLabels)) return failure::fail("jsbsim", std::string(kLabels), "another line");
  line.remove_prefix(kLabels.size());
  std::vector<std::string_view> labels = fields_of(line, ',');
  // The mark is followed by a comma: what stands between is no column.
  if (labels.front().empty()) labels.erase(labels.begin());
  JsbsimColumns columns;
  columns.count = labels.size();
  std::string missing;
  for (std::size_t value = 0; value < kJsbsimValues; ++value) {
    const auto found =
        std::ranges::find_if(labels, [&](std::string_view label) { return names(label, kNames[value]); });
    columns.of_value[value] = static_cast<std::size_t>(found - labels.begin());
    if (found == labels.end()) missing += (missing.empty() ? "" : ", ") + std::string(kNames[value]);
  }
  if (!missing.empty()) return tl::unexpected(missing_columns(labels, missing));
  return columns;
}

failure::Expected<JsbsimState> parse_jsbsim_line(const JsbsimColumns& columns, std::string_view line) {
  const std::vector<std::string_view> fields = fields_of(line, ',');
  if (fields.size() != columns.count)
    return failure::fail("jsbsim", std::to_string(columns.count) + " columns, as the labels name",
                         std::to_string(fields.size()));
  std::array<double, kJsbsimValues> values{};
  for (std::size_t value = 0; value < kJsbsimValues; ++value) {
    const std::string_view field = fields[columns.of_value[value]];
    const auto number = finite_number(field);
    if (!number) return failure::fail("jsbsim", std::string(kNames[value]) + ", a number", '"' + shown(field) + '"');
    values[value] = *number;
  }
  const Reading reading{values[kLatitude],
                        values[kLongitude],
                        values[kAltitude] * geo::kMetresPerFoot,
                        values[kHeading],
                        values[kPitch],
                        values[kRoll],
                        values[kNorth] * geo::kMetresPerFoot,
                        values[kEast] * geo::kMetresPerFoot,
                        values[kDown] * geo::kMetresPerFoot};
  auto sample = checked_sample("jsbsim", reading);
  if (!sample) return tl::unexpected(sample.error());
  return JsbsimState{geo::Duration::seconds(values[kTime]), *sample};
}

void JsbsimBridge::keep(const JsbsimColumns& columns) {
  std::erase_if(labels_, [this](const Labels& labels) { return labels.sender == sender_; });
  // Never those of the source that flies: whose line was read last.
  const auto flies = [this](const Labels& labels) { return labels.sender == flies_; };
  if (labels_.size() >= kMostSenders) labels_.erase(std::ranges::find_if_not(labels_, flies));
  labels_.push_back({sender_, columns});
}

const JsbsimColumns* JsbsimBridge::columns() const {
  const auto found = std::ranges::find(labels_, sender_, &Labels::sender);
  if (found != labels_.end()) return &found->columns;
  return columns_ ? &*columns_ : nullptr;
}

failure::Expected<std::optional<ExternalSample>> JsbsimBridge::receive(Bytes datagram, geo::Duration) {
  if (datagram.size() > kLongestJsbsimLine)
    return failure::fail("jsbsim", "a line of at most " + std::to_string(kLongestJsbsimLine) + " characters",
                         std::to_string(datagram.size()));
  const std::string_view line = trimmed({reinterpret_cast<const char*>(datagram.data()), datagram.size()});
  if (line.starts_with(kLabels)) {
    auto columns = parse_jsbsim_labels(line);
    if (!columns) return tl::unexpected(columns.error());
    keep(*columns);
    return std::nullopt;
  }
  const JsbsimColumns* const columns = this->columns();
  if (columns == nullptr)
    return failure::fail("jsbsim", "a line of labels first", "a line of numbers",
                         "start flight-model before JSBSim, which sends its labels once, or name them: "
                         "jsbsim:PORT,Time,lat-geod-deg,...");
  const auto state = parse_jsbsim_line(*columns, line);
  if (!state) return tl::unexpected(state.error());
  if (const auto reason = order_.why_not_news(state->time)) return failure::fail("jsbsim", "a newer line", *reason);
  flies_ = sender_;
  return state->sample;
}

}  // namespace yars::databuffer::bridges
