#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <ostream>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include "config/schema/load.hpp"
#include "databuffer/messages/model_records.hpp"
#include "databuffer/runtime/program.hpp"
#include "lib/file/output_file.hpp"
#include "lib/geo/quantity.hpp"
#include "lib/imageio/png.hpp"
#include "lib/radar/configuration.hpp"
#include "model/kernel/offline_scan.hpp"
#include "model/kernel/sweep_chain.hpp"
#include "model/kernel/tick_inputs.hpp"
#include "model/scene/index/scene_index.hpp"
#include "model/scene/index/scene_store.hpp"
#include "model/terrain/store/directory_store.hpp"
#include "tools/command/command.hpp"
#include "tools/command/input_checks.hpp"
#include "tools/command/output.hpp"
#include "tools/trade/scan_errors.hpp"

namespace yars::tools {

// Picture of one scan in the geometry of the display: ground track up, apex and scale from the configuration's view.
// Each pixel takes the sample that contains the pixel's centre. Pixels outside the scan are black.

enum class ScanColor : std::uint8_t { green, gray };

// `sweeps`: at least one, all of one scan, clockwise, with the same apex position and range.
imageio::Image scan_picture(std::span<const databuffer::Sweep> sweeps, const radar::ViewConfiguration& view,
                            ScanColor color);

namespace {

using databuffer::Sweep;

// Red, green and blue at full brightness. The video level, 0 to 255, scales them.
constexpr std::array<double, 3> kGreen{0.35, 1.0, 0.45};
constexpr std::array<double, 3> kGray{1.0, 1.0, 1.0};

// The sweep whose wedge contains an azimuth [deg true]; null outside the scan. All wedges have the same width.
const Sweep* sweep_at(std::span<const Sweep> sweeps, double azimuth_deg) {
  const double from_left_deg = geo::wrapped_degrees(azimuth_deg - sweeps.front().azimuth_left_deg);
  const double width_deg = geo::wrapped_degrees(sweeps.front().azimuth_right_deg - sweeps.front().azimuth_left_deg);
  // In a circular scan, azimuths to the left of the first edge belong to the last sweeps.
  const double turned_deg = from_left_deg < 0.0 ? from_left_deg + 360.0 : from_left_deg;
  const auto index = static_cast<std::size_t>(turned_deg / width_deg);
  return index < sweeps.size() ? &sweeps[index] : nullptr;
}

}  // namespace

imageio::Image scan_picture(std::span<const Sweep> sweeps, const radar::ViewConfiguration& view, ScanColor color) {
  const int size = view.size_pixels;
  imageio::Image image{size, size, 3, std::vector<std::uint8_t>(static_cast<std::size_t>(size) * size * 3, 0)};
  const std::array<double, 3>& tint = color == ScanColor::green ? kGreen : kGray;
  const double track_deg = sweeps.front().ground_track_deg;
  for (int row = 0; row < size; ++row) {
    const double up = view.height_max - (row + 0.5) / size * (view.height_max - view.height_min);
    for (int column = 0; column < size; ++column) {
      const double right = view.width_min + (column + 0.5) / size * (view.width_max - view.width_min);
      const double range = std::hypot(right, up);
      if (range >= 1.0) continue;
      const Sweep* sweep = sweep_at(sweeps, track_deg + std::atan2(right, up) / geo::kRadiansPerDegree);
      if (sweep == nullptr) continue;
      const double level = sweep->video[static_cast<std::size_t>(range * sweep->samples)];
      std::uint8_t* pixel = &image.pixels[(static_cast<std::size_t>(row) * size + column) * 3];
      for (std::size_t channel = 0; channel < 3; ++channel) {
        pixel[channel] = static_cast<std::uint8_t>(std::lround(level * tint[channel]));
      }
    }
  }
  return image;
}

// Shadow table of a scan as CSV with a header: one row for each sample of each sweep.
// Columns: sweep, azimuth_deg [0, 360) true at the aircraft, ground_range_m, latitude_deg, longitude_deg,
// elevation_m MSL, lit: 1 lit, 0 in shadow. `-` in elevation_m and lit: the terrain is void or not loaded.
// `-` in ground_range_m: no ground has the sample's slant range. `samples` has equally many entries for each place.
void write_shadow(std::ostream& out, std::span<const model::kernel::SweepHeader> positions,
                  std::span<const trade::RaySample> samples);

namespace {
constexpr const char* kUnknown = "-";
constexpr int kDigits = 12;  // significant digits: 1e-6 m of a range in hundreds of km, 0.1 mm of a longitude

void write_known(std::ostream& out, double value) {
  if (std::isnan(value))
    out << kUnknown;
  else
    out << value;
}
}  // namespace

void write_shadow(std::ostream& out, std::span<const model::kernel::SweepHeader> positions,
                  std::span<const trade::RaySample> samples) {
  out << "sweep,azimuth_deg,ground_range_m,latitude_deg,longitude_deg,elevation_m,lit\n";
  out.precision(kDigits);
  const std::size_t count = samples.size() / positions.size();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const trade::RaySample& sample = samples[i];
    const std::size_t sweep = i / count;
    out << sweep << ',' << model::kernel::geometry_of(positions[sweep]).azimuth.degrees() << ',';
    write_known(out, sample.distance_m);
    out << ',' << sample.position.latitude_deg << ',' << sample.position.longitude_deg << ',';
    write_known(out, sample.ground.elevation_m);
    out << ',' << (std::isnan(sample.ground.elevation_m) ? kUnknown : sample.lit ? "1" : "0") << '\n';
  }
}

// `yars scan`: computes one scan of the real beam map in this process. Writes a picture or numbers, and prints one line
// of JSON with run times and hash. Source of option names and JSON fields: docs/spec/commands.md#scan.

namespace {

using Milliseconds = std::chrono::duration<double, std::milli>;

struct ScanOptions {
  std::string terrain, fidelity, out, shadow;
  std::vector<std::string> scenes, without;
  std::string color = "green";
  double latitude_deg = 37.8, longitude_deg = -122.5, altitude_ft = 15000.0, heading_deg = 0.0;
  double range_nm = 40.0, width_deg = 100.0, elevation_deg = 0.0;
  int samples = 0, threads = 1, gain = 3, size = 0, repeat = 1, channel = 1;
  double time_s = 0.0;
  std::string band = "A";
  std::int64_t seed = -1;
  bool force = false;
};

double milliseconds_since(std::chrono::steady_clock::time_point begin) {
  return Milliseconds(std::chrono::steady_clock::now() - begin).count();
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

radar::RadarConfiguration configure(const CommonOptions& common, const ScanOptions& options) {
  auto loaded = config::load_configuration(common.config);
  if (!loaded) give_up(loaded.error());
  radar::RadarConfiguration configuration = std::move(loaded->radar);
  if (!options.fidelity.empty()) configuration.fidelity = *radar::fidelity_preset(options.fidelity);
  if (!options.terrain.empty()) configuration.terrain.directory = options.terrain;
  if (options.samples > 0) configuration.fidelity.samples = options.samples;
  if (options.size > 0) configuration.view.size_pixels = options.size;
  if (options.seed >= 0) configuration.seed = static_cast<std::uint64_t>(options.seed);
  if (auto added = model::scene::add_scenes(configuration.world.scenes, options.scenes, options.without); !added)
    give_up(error::usage_error(added.error()));
  return configuration;
}

model::kernel::ScanRequest request_of(const ScanOptions& options) {
  model::kernel::ScanRequest request;
  request.pose.position = {options.latitude_deg, options.longitude_deg};
  request.pose.altitude = geo::AltitudeMsl::feet(options.altitude_ft);
  request.pose.platform.heading = geo::Bearing::degrees(options.heading_deg);
  request.pose.platform.ground_track = request.pose.platform.heading;
  request.range = geo::Length::nautical_miles(options.range_nm);
  request.width = geo::Angle::degrees(options.width_deg);
  request.elevation = geo::Angle::degrees(options.elevation_deg);
  request.gain = options.gain;
  request.sim_time_ns = static_cast<std::int64_t>(options.time_s * 1e9);
  request.band = static_cast<std::uint8_t>(options.band.front() - 'A');
  request.channel = static_cast<std::uint8_t>(options.channel);
  return request;
}

void write_csv(std::ostream& file, std::span<const databuffer::Sweep> sweeps) {
  file << "sweep,azimuth_left_deg,azimuth_right_deg,range_m,hash,video...\n";
  file.precision(12);
  for (const databuffer::Sweep& sweep : sweeps) {
    file << sweep.number << ',' << sweep.azimuth_left_deg << ',' << sweep.azimuth_right_deg << ',' << sweep.range_m
         << ',' << sweep.hash;
    for (std::uint32_t i = 0; i < sweep.samples; ++i) file << ',' << static_cast<int>(sweep.video[i]);
    file << '\n';
  }
}

void write_text_file(const std::string& path, const std::ostringstream& text) {
  if (const auto written = file::write_file(path, text.view()); !written) give_up(written.error());
}

void write_result(const ScanOptions& options, const radar::ViewConfiguration& view,
                  const model::kernel::OfflineScan& work) {
  const std::filesystem::path path(options.out);
  const std::span<const databuffer::Sweep> sweeps = work.sweeps();
  if (ending_of(options.out) == ".f32") {
    if (auto written = write_floats(path, work.power()); !written) give_up(written.error());
    return;
  }
  if (ending_of(options.out) == ".png") {
    const ScanColor color = options.color == "gray" ? ScanColor::gray : ScanColor::green;
    if (auto written = imageio::write_png(path, scan_picture(sweeps, view, color)); !written) give_up(written.error());
    return;
  }
  std::ostringstream file;
  write_csv(file, sweeps);
  write_text_file(options.out, file);
}

void check_output(const ScanOptions& options) {
  check_file_name("--out", options.out, {".png", ".csv", ".f32"});
  check_file_name("--shadow", options.shadow, {".csv"});
}

struct Times {
  double first_ms = 0.0;           // [ms] wall time of the first scan, including the reading of terrain
  std::vector<double> measure_ms;  // [ms] wall time of each warm scan, terrain to power
  std::vector<double> whole_ms;    // [ms] wall time of each warm scan, terrain to video and hash
};

// Runs the first scan and `repeat` warm scans. `begin`: time at which the reading of terrain began.
Times run_scans(model::kernel::OfflineScan& work, const model::physics::Environment& environment, int repeat,
                std::chrono::steady_clock::time_point begin) {
  Times times;
  for (int run = 0; run <= repeat; ++run) {
    const auto run_begin = std::chrono::steady_clock::now();
    work.run(environment);
    if (run == 0) {
      times.first_ms = milliseconds_since(begin);
      continue;
    }
    times.whole_ms.push_back(milliseconds_since(run_begin));
    const auto measure_begin = std::chrono::steady_clock::now();
    work.measure(environment);
    times.measure_ms.push_back(milliseconds_since(measure_begin));
  }
  return times;
}

nlohmann::ordered_json summary(std::span<const databuffer::Sweep> sweeps, const Times& times, double index_ms) {
  const double kernel_ms = median(times.whole_ms);
  const double samples = static_cast<double>(sweeps.size()) * sweeps.front().samples;
  nlohmann::ordered_json line;
  line["sweeps"] = sweeps.size();
  line["samples"] = sweeps.front().samples;
  line["kernel_ms"] = kernel_ms;
  line["sweep_ms"] = median(times.measure_ms);
  line["first_ms"] = times.first_ms;
  line["index_ms"] = index_ms;
  line["samples_per_second"] = samples / (kernel_ms * 1e-3);
  return line;
}

void scan(const CommonOptions& common, const ScanOptions& options) {
  check_output(options);
  const radar::RadarConfiguration configuration = configure(common, options);
  const model::kernel::ScanRequest request = request_of(options);
  if (!options.force)
    if (const auto problem = beyond_gimbal(request.elevation, request.width, configuration.antenna)) give_up(*problem);
  const auto opening = std::chrono::steady_clock::now();
  auto store = model::terrain::open_terrain(configuration.terrain);
  if (!store) give_up(store.error());
  auto scenes =
      model::scene::open_scenes(configuration.world.scenes, configuration.terrain, model::scene::SceneUse::scatterers);
  if (!scenes) give_up(scenes.error());
  const double index_ms = milliseconds_since(opening);
  model::kernel::OfflineScan work(configuration, request, options.threads);

  const auto begin = std::chrono::steady_clock::now();
  const model::terrain::TerrainRegion region{request.pose.position, request.range.metres(),
                                             model::kernel::scan_detail(configuration.fidelity, request.range)};
  const auto terrain = (*store)->prepare(region);
  const auto scene = *scenes ? (*scenes)->prepare(region) : nullptr;
  check_terrain_read("yars scan", configuration.terrain.directory, **store);
  if (*scenes) check_scenes_read("yars scan", **scenes);
  if (!options.force)
    if (const auto problem = beneath_ground(request.pose.altitude, terrain->elevation_m(request.pose.position)))
      give_up(*problem);
  const Times times = run_scans(work, {*terrain, scene.get()}, options.repeat, begin);

  nlohmann::ordered_json line = summary(work.sweeps(), times, index_ms);
  line["terrain_bytes"] = terrain->resident_bytes();
  if (scene) line["scene_bytes"] = scene->resident_bytes();
  line["threads"] = options.threads;
  line["fidelity"] = configuration.fidelity.name;
  line["hash"] = model::kernel::scan_hash(work.sweeps());
  if (!options.out.empty()) write_result(options, configuration.view, work);
  if (!options.shadow.empty()) {
    std::ostringstream file;
    write_shadow(file, work.headers(), trade::ray_samples(configuration, work.headers(), *terrain));
    write_text_file(options.shadow, file);
  }
  std::printf("%s\n", line.dump().c_str());
}

}  // namespace

void add_scan_command(databuffer::Command app, const CommonOptions& common) {
  auto options = std::make_shared<ScanOptions>();
  databuffer::Command command = app.subcommand("scan", "one scan of the real beam map, without processes");
  command.option("--terrain", options->terrain, "directory of DTED or HGT cells (else the configuration's)");
  command.option("--scene", options->scenes, "OpenFlight file, as FILE or FILE@LAT,LON,HDG; may come again");
  command
      .option("--scene-without", options->without,
              "name of what is left out of scenes, as * and ? allow; may come again")
      .repeatable();
  command.option("--lat", options->latitude_deg, "[deg]").range(-90.0, 90.0);
  command.option("--lon", options->longitude_deg, "[deg]").range(-180.0, 180.0);
  command.option("--alt-ft", options->altitude_ft, "[ft] above mean sea level").range(-3000.0, 600000.0);
  command.option("--heading", options->heading_deg, "[deg] true; also the ground track").range(-360.0, 360.0);
  command.option("--range-nm", options->range_nm, "[NM]").range(0.1, 1000.0);
  command.option("--scan-width", options->width_deg, "[deg]").range(1.0, 120.0);
  command.option("--elevation", options->elevation_deg, "[deg] of the antenna, against the horizon").range(-60.0, 60.0);
  command.flag("--force", options->force, "beyond the gimbal and from below the ground, too");
  command.option("--fidelity", options->fidelity, "preset (else the configuration's)")
      .one_of(std::vector<std::string>(radar::fidelity_names().begin(), radar::fidelity_names().end()));
  command.option("--samples", options->samples, "a sweep").range(1, radar::kMaxSamples);
  command.option("--gain", options->gain, "0 to 3").range(0, 3);
  command.option("--band", options->band, "that jammers are on or not: A to E").one_of({"A", "B", "C", "D", "E"});
  command.option("--channel", options->channel, "1 to 8").range(1, 8);
  command.option("--time-s", options->time_s, "[s] sim time of the first sweep, for what moves").range(0.0, 1e8);
  command.option("--threads", options->threads).range(1, 256);
  command.option("--seed", options->seed, "of the noise").not_negative();
  command.option("--repeat", options->repeat, "warm scans to time; the first comes on top").range(1, 1000000);
  command.option("--size", options->size, "[pixels] of the picture").range(16, 8192);
  command.option("--color", options->color).one_of({"green", "gray"});
  command.option("--out", options->out,
                 "file: .png, .csv (video) or .f32 (power: little-endian floats, a row a sweep)");
  command.option("--shadow", options->shadow, "file: .csv of every sample's position, height and whether it is lit");
  command.callback([options, &common] { scan(common, *options); });
}

}  // namespace yars::tools
