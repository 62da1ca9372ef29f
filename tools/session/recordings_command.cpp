// `yars recordings`: lists recordings by their headers and indexes, and says where a live set would go on (--at).

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lib/geo/quantity.hpp"
#include "lib/log/log.hpp"
#include "lib/text/plain_text.hpp"
#include "radar/recording/branch.hpp"
#include "radar/recording/recording_io.hpp"
#include "runtime/program.hpp"
#include "tools/command/command.hpp"

namespace yars::tools {

namespace {

using nlohmann::ordered_json;
using recording::RecordingReader;

struct RecordingsOptions {
  std::vector<std::string> paths;
  bool json = false;
  bool lines = false;  // for scripts/start: the facts of --at alone, NAME = VALUE
  std::optional<double> at_s;
  std::optional<int> newest;  // of each folder
};

// Sim time [s] of a tick; a tick is 5 ms, so three decimals are exact.
ordered_json seconds_at(std::int64_t tick) {
  return std::round(static_cast<double>(tick) * radar::kTickSeconds * 1e3) / 1e3;
}

template <class T>
bool has(const RecordingReader& reader) {
  return std::ranges::any_of(reader.blocks(), [](const recording::IndexEntry& block) {
    return (block.kinds >> recording::kKindOf<T>.number & 1U) != 0;
  });
}

// Source of flight-model with which the recording begins; empty: not recorded.
std::string flight_source_of(RecordingReader& reader) {
  const auto items = reader.items_of(0);
  if (!items) return {};
  const auto item = items->last_of(recording::kKindOf<recording::FlightSource>.number);
  return item ? recording::text_of(std::get<recording::FlightSource>(*item)) : std::string();
}

// Source with which a live flight-model goes on from a recorded point.
struct LiveFlight {
  std::string source;
  std::string reason;  // why the recorded flight cannot go on, and the aircraft flies straight and level; empty: it can
};

std::string straight_and_level(const databuffer::Ownship& ownship) {
  const double speed_mps = std::hypot(ownship.velocity_north_mps, ownship.velocity_east_mps);
  const auto course = geo::Bearing::radians(std::atan2(ownship.velocity_east_mps, ownship.velocity_north_mps));
  char text[160];
  std::snprintf(text, sizeof text, "fixed:%.12f,%.12f,%.6f,%.9f,%.9f", ownship.latitude_deg, ownship.longitude_deg,
                geo::AltitudeMsl::metres(ownship.altitude_msl_m).feet(),
                speed_mps > 1.0 ? course.degrees() : ownship.heading_deg,
                geo::Speed::metres_per_second(speed_mps).knots());
  return text;
}

LiveFlight live_flight(const recording::BranchPoint& point) {
  const std::string& source = point.flight_source;
  const std::string kind = source.substr(0, source.find(':'));
  const std::string_view flown = text::text_of(point.status.ownship.source);
  LiveFlight flight{source, {}};
  if (source.empty())
    flight.reason = "the recording does not name the source of its flight";
  else if (kind != "route" && kind != "csv" && kind != "fixed")
    flight.reason = "its source " + source + " flies by its own clock";
  else if (kind != flown)
    flight.reason = "at this time '" + std::string(flown) + "' flew the aircraft, not " + source;
  else if (kind != "fixed" && !std::ifstream(source.substr(kind.size() + 1)))
    flight.reason = "the file of its source " + source + " cannot be read";
  if (!flight.reason.empty()) flight.source = straight_and_level(point.status.ownship);
  return flight;
}

ordered_json fly_out_of(RecordingReader& reader, const std::string& file, double at_s) {
  const auto tick = recording::tick_at(reader, at_s, file, "--at");
  if (!tick) throw_failure(tick.error());
  const auto point = recording::find_branch_point(reader, *tick, file);
  if (!point) throw_failure(point.error());
  const LiveFlight flight = live_flight(*point);
  return {{"tick", point->tick},
          {"at_s", seconds_at(point->tick)},
          {"source", flight.source},
          {"continues", flight.reason.empty()},
          {"reason", flight.reason}};
}

ordered_json description_of(RecordingReader& reader, const std::filesystem::path& file) {
  std::error_code code;
  const auto range = recording::tick_range(reader);
  const bool writing = recording::is_being_written(file);
  ordered_json object;
  object["file"] = std::filesystem::absolute(file).lexically_normal().string();
  object["begin_s"] = range ? seconds_at(range->first) : ordered_json();
  object["end_s"] = range ? seconds_at(range->last) : ordered_json();
  object["duration_s"] = range ? seconds_at(range->last - range->first) : ordered_json();
  object["bytes"] = std::filesystem::file_size(file, code);
  object["configuration"] = reader.header().configuration;
  object["terrain"] = reader.header().terrain;
  object["model"] = reader.header().model;
  object["source"] = flight_source_of(reader);
  object["sweeps"] = has<databuffer::Sweep>(reader);
  object["maps"] = has<recording::Patch>(reader);
  object["can_fly_out"] = range && has<recording::StateChange>(reader) &&
                          (has<recording::StatusReport>(reader) || has<recording::StartingPoint>(reader));
  object["cut_short"] = reader.cut_short() && !writing;
  object["writing"] = writing;
  return object;
}

// True if the file begins as a recording does, or has the name of one.
bool may_be_recording(const std::filesystem::path& file) {
  if (file.extension() == ".yars") return true;
  std::ifstream stream(file, std::ios::binary);
  std::string magic(recording::file_magic().size(), '\0');
  stream.read(magic.data(), static_cast<std::streamsize>(magic.size()));
  return stream && magic == recording::file_magic();
}

// Removes all but the `count` files that were written last. Returns the number of removed files.
std::size_t keep_newest(std::vector<std::filesystem::path>& files, std::size_t count) {
  if (files.size() <= count) return 0;
  std::vector<std::pair<std::filesystem::file_time_type, std::filesystem::path>> dated;
  std::error_code gone;  // a file without a time counts as the oldest
  for (auto& file : files) dated.emplace_back(std::filesystem::last_write_time(file, gone), std::move(file));
  std::ranges::nth_element(dated, dated.begin() + static_cast<std::ptrdiff_t>(count), std::greater());
  files.clear();
  for (std::size_t i = 0; i < count; ++i) files.push_back(std::move(dated[i].second));
  return dated.size() - count;
}

// Recordings in a folder; those of its subfolders are left out.
std::vector<std::filesystem::path> recordings_in(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  std::error_code code;
  for (std::filesystem::directory_iterator entry(folder, code), end; !code && entry != end; entry.increment(code)) {
    std::error_code kind;
    if (entry->is_regular_file(kind) && may_be_recording(entry->path())) files.push_back(entry->path());
  }
  if (code)
    throw_failure({folder.string(), "a folder that can be read", error::reason_of(code.value()), "check the path"});
  return files;
}

class Listing {
 public:
  explicit Listing(const RecordingsOptions& options) : options_(&options) {}

  void add(const std::string& path) {
    std::error_code code;
    if (!std::filesystem::is_directory(path, code)) return add_file(path, true);
    auto files = recordings_in(path);
    if (options_->newest) left_out_ += keep_newest(files, static_cast<std::size_t>(*options_->newest));
    std::ranges::sort(files);
    for (const auto& file : files) add_file(file, false);
  }
  void print() const {
    if (options_->lines) return print_lines();
    if (options_->json)
      return print_json({{"recordings", recordings_}, {"refused", refused_}, {"left_out", left_out_}});
    for (const ordered_json& one : recordings_) print_text(one);
    for (const ordered_json& one : refused_) log::warning("not listed: " + one["reason"].get<std::string>());
    if (left_out_ > 0) std::printf("and %s that are older\n", text::counted(left_out_, "recording").c_str());
    if (recordings_.empty() && refused_.empty()) std::printf("no recordings\n");
  }
  // True if a file that the user named is no recording.
  bool has_failed() const { return failed_; }

 private:
  void add_file(const std::filesystem::path& file, bool named) {
    auto reader = RecordingReader::open(file);
    if (!reader && options_->at_s) throw_failure(reader.error());
    if (!reader) {
      refused_.push_back({{"file", file.string()}, {"reason", reader.error().message()}});
      failed_ = failed_ || named;
      return;
    }
    ordered_json object = description_of(*reader, file);
    if (options_->at_s) object["fly_out"] = fly_out_of(*reader, file.string(), *options_->at_s);
    recordings_.push_back(std::move(object));
  }
  void print_lines() const {
    for (const ordered_json& one : recordings_)
      for (const auto& [name, value] : {std::pair<const char*, std::string>{"config", one["configuration"]},
                                        {"terrain", one["terrain"]},
                                        {"source", one["fly_out"]["source"]},
                                        {"reason", one["fly_out"]["reason"]}})
        std::printf("%s = %s\n", name, text::printable(value).c_str());
  }
  static void print_text(const ordered_json& one) {
    const auto yes = [&one](const char* field, const char* text) {
      return one[field].get<bool>() ? std::string(", ") + text : std::string();
    };
    const std::string time = one["begin_s"].is_null()
                                 ? "no ticks"
                                 : text::text_of_number(one["begin_s"].get<double>()) + " to " +
                                       text::text_of_number(one["end_s"].get<double>()) + " s of sim time, " +
                                       text::text_of_number(one["duration_s"].get<double>()) + " s";
    const auto or_built_in = [](const std::string& path) { return path.empty() ? std::string("built-in") : path; };
    std::printf("%s: %s; %s%s%s%s%s\n  configuration %s, terrain %s\n", one["file"].get<std::string>().c_str(),
                time.c_str(), text::counted(one["bytes"].get<std::uint64_t>(), "byte").c_str(),
                yes("sweeps", "sweeps with video").c_str(), yes("maps", "maps").c_str(),
                yes("cut_short", "cut short").c_str(), yes("writing", "being written").c_str(),
                or_built_in(one["configuration"]).c_str(), or_built_in(one["terrain"]).c_str());
    if (!one.contains("fly_out")) return;
    const ordered_json& point = one["fly_out"];
    const std::string reason = point["reason"];
    std::printf("  goes on at %s s (tick %lld), flight-model --source %s%s\n",
                text::text_of_number(point["at_s"].get<double>()).c_str(),
                static_cast<long long>(point["tick"].get<std::int64_t>()), point["source"].get<std::string>().c_str(),
                reason.empty() ? "" : (", straight and level: " + reason).c_str());
  }

  const RecordingsOptions* options_;
  ordered_json recordings_ = ordered_json::array(), refused_ = ordered_json::array();
  std::size_t left_out_ = 0;  // by --newest
  bool failed_ = false;
};

void list(const RecordingsOptions& options) {
  if (options.at_s && options.paths.size() != 1)
    throw_failure(
        error::usage_error("--at", "one FILE with it", std::to_string(options.paths.size()), "name the recording"));
  Listing listing(options);
  for (const std::string& path : options.paths.empty() ? std::vector<std::string>{"."} : options.paths)
    listing.add(path);
  listing.print();
  std::fflush(stdout);
  if (listing.has_failed()) throw CommandFailed{{}, runtime::kExitFailure};
}

}  // namespace

void add_recordings_command(runtime::Command app) {
  runtime::Command command = app.subcommand("recordings", "list recordings: time, size, terrain, what they hold");
  auto options = std::make_shared<RecordingsOptions>();
  command.option("FILE", options->paths, "recordings, or folders with recordings")
      .value_name("FILE")
      .otherwise("the current folder");
  runtime::Option at = command.option(
      "--at", options->at_s,
      "[s] sim time: say where a live set goes on from there, and by which flight (--fly-out of the start script)");
  at.range(0.0, databuffer::kLatestSimTime_s).otherwise("none");
  command.flag("--lines", options->lines, "print the facts of --at as lines NAME = VALUE, for scripts").needs(at);
  command.option("--newest", options->newest, "of each folder only so many recordings, those written last")
      .value_name("NUMBER")
      .range(1, 1'000'000)
      .otherwise("all");
  add_json_flag(command, options->json);
  command.callback([options] { list(*options); });
}

}  // namespace yars::tools
