// `yars scan`: computes one scan of the real beam map in this process. Writes a picture or numbers, and prints what was
// computed, shares, run time and hash, or the same and more as JSON. Source of option names and JSON fields:
// docs/commands.md#scan.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <ostream>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include "lib/file/output_file.hpp"
#include "lib/geo/quantity.hpp"
#include "lib/imageio/png.hpp"
#include "lib/text/plain_text.hpp"
#include "model/kernel/sweep_chain.hpp"
#include "radar/private_data.hpp"
#include "runtime/program.hpp"
#include "tools/command/command.hpp"
#include "yars/radar.hpp"

namespace yars::tools {

// Picture of one scan in the geometry of the display: the first sweep's ground track points up; `view` gives apex and
// scale. Each pixel takes the sample that contains the pixel's centre. Pixels outside the scan are black.

enum class ScanColor : std::uint8_t { green, gray };

imageio::Image scan_picture(const Scan& scan, const radar::ViewConfiguration& view, ScanColor color);

namespace {

// Factors [0, 1] of red, green and blue. Each channel of a pixel is the video level (0 to 255) times its factor.
constexpr std::array<double, 3> kGreen{0.35, 1.0, 0.45};
constexpr std::array<double, 3> kGray{1.0, 1.0, 1.0};

// Index of the sweep whose wedge contains this azimuth [deg true]; nullopt outside the scan. All wedges have the same
// width.
std::optional<std::size_t> sweep_at(const ScanSweep& first, std::size_t sweeps, double azimuth_deg) {
  const double from_left_deg = geo::wrapped_degrees(azimuth_deg - first.azimuth_left_deg);
  const double width_deg = geo::wrapped_degrees(first.azimuth_right_deg - first.azimuth_left_deg);
  // wrapped_degrees() makes azimuths 180 deg or more clockwise of the first sweep's left edge negative.
  const double offset_deg = from_left_deg < 0.0 ? from_left_deg + 360.0 : from_left_deg;
  const auto index = static_cast<std::size_t>(offset_deg / width_deg);
  return index < sweeps ? std::optional(index) : std::nullopt;
}

}  // namespace

imageio::Image scan_picture(const Scan& scan, const radar::ViewConfiguration& view, ScanColor color) {
  const int size = view.size_pixels;
  imageio::Image image{size, size, 3, std::vector<std::uint8_t>(static_cast<std::size_t>(size) * size * 3, 0)};
  const std::array<double, 3>& tint = color == ScanColor::green ? kGreen : kGray;
  const double track_deg = scan.facts().ground_track_deg;
  const ScanSweep first = *scan.sweep(0);
  for (int row = 0; row < size; ++row) {
    const double up = view.height_max - (row + 0.5) / size * (view.height_max - view.height_min);
    for (int column = 0; column < size; ++column) {
      const double right = view.width_min + (column + 0.5) / size * (view.width_max - view.width_min);
      const double range = std::hypot(right, up);
      if (range >= 1.0) continue;
      const auto index = sweep_at(first, scan.sweeps(), track_deg + std::atan2(right, up) / geo::kRadiansPerDegree);
      if (!index) continue;
      const auto sample = static_cast<std::size_t>(range * static_cast<double>(scan.samples()));
      const double level = scan.sweep(*index)->video[sample];
      std::uint8_t* pixel = &image.pixels[(static_cast<std::size_t>(row) * size + column) * 3];
      for (std::size_t channel = 0; channel < 3; ++channel) {
        pixel[channel] = static_cast<std::uint8_t>(std::lround(level * tint[channel]));
      }
    }
  }
  return image;
}

// Shadow table of a scan as CSV with a header line: one row for each sample of each sweep.
// Columns: sweep; azimuth_deg: true bearing of the sweep's middle at the aircraft, [0, 360); ground_range_m;
// latitude_deg; longitude_deg; elevation_m: ground above mean sea level; lit: 1 lit, 0 in shadow.
// `-` in elevation_m and lit: the terrain is void or not loaded. `-` in ground_range_m, too: no ground has the sample's
// slant range; latitude and longitude are then the aircraft's.
// `samples` has the same number of elements for each sweep.
void write_shadow(std::ostream& out, std::span<const model::kernel::SweepHeader> positions,
                  std::span<const radar::RaySample> samples);

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
                  std::span<const radar::RaySample> samples) {
  out << "sweep,azimuth_deg,ground_range_m,latitude_deg,longitude_deg,elevation_m,lit\n";
  out.precision(kDigits);
  const std::size_t count = samples.size() / positions.size();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const radar::RaySample& sample = samples[i];
    const std::size_t sweep = i / count;
    out << sweep << ',' << model::kernel::geometry_of(positions[sweep]).azimuth.degrees() << ',';
    write_known(out, sample.distance_m);
    out << ',' << sample.position.latitude_deg << ',' << sample.position.longitude_deg << ',';
    write_known(out, sample.ground.elevation_m);
    out << ',' << (std::isnan(sample.ground.elevation_m) ? kUnknown : sample.lit ? "1" : "0") << '\n';
  }
}

namespace {

struct ScanCommandOptions {
  ConfigurationOptions configuration;
  ScanRequest request;
  std::string out = kNoFile, shadow = kNoFile;  // kNoFile: computed and reported, nothing written
  std::string color = "green";
  std::optional<int> size;  // nullopt: as configured
  int repeat = 1;
  bool json = false;
};

radar::RadarConfiguration configure(const CommonOptions& common, const ScanCommandOptions& options) {
  radar::RadarConfiguration configuration = read_configuration(common.config, options.configuration);
  if (options.size) configuration.view.size_pixels = *options.size;
  return configuration;
}

// A header line, then one row for each sweep: number, azimuths of edges, range, hash, video [0, 255] of all samples.
void write_csv(std::ostream& file, const Scan& scan) {
  file << "sweep,azimuth_left_deg,azimuth_right_deg,range_m,hash,video...\n";
  file.precision(12);
  const double range_m = scan.facts().range_m;
  for (std::size_t number = 0; number < scan.sweeps(); ++number) {
    const ScanSweep sweep = *scan.sweep(number);
    file << number << ',' << sweep.azimuth_left_deg << ',' << sweep.azimuth_right_deg << ',' << range_m << ','
         << sweep.hash;
    for (const std::uint8_t level : sweep.video) file << ',' << static_cast<int>(level);
    file << '\n';
  }
}

void write_text_file(const std::string& path, const std::ostringstream& text) {
  if (const auto written = file::write_file(path, text.view()); !written) throw_failure(written.error());
}

void write_result(const ScanCommandOptions& options, const radar::ViewConfiguration& view, const Scan& scan) {
  const std::filesystem::path path(options.out);
  if (ending_of(options.out) == ".f32") {
    if (auto written = write_floats(path, scan.power()); !written) throw_failure(written.error());
    return;
  }
  if (ending_of(options.out) == ".png") {
    const ScanColor color = options.color == "gray" ? ScanColor::gray : ScanColor::green;
    if (auto written = imageio::write_png(path, scan_picture(scan, view, color)); !written)
      throw_failure(written.error());
    return;
  }
  std::ostringstream file;
  write_csv(file, scan);
  write_text_file(options.out, file);
}

void check_output(const ScanCommandOptions& options) {
  check_file_name("--out", options.out, {".png", ".csv", ".f32"});
  check_file_name("--shadow", options.shadow, {".csv"});
}

// A warm scan is a scan after the first: the terrain is then in memory.
struct Times {
  double first_ms = 0.0;           // [ms] wall time of the first scan, including reading of terrain
  std::vector<double> measure_ms;  // [ms] wall time of each warm scan, from terrain to power
  std::vector<double> whole_ms;    // [ms] wall time of each warm scan, from terrain to video and hash
  std::vector<double> cpu_ms;      // [ms] processor time of all threads in the same scan
};

// Ends with the error of a call.
void check(const Expected<void>& done) {
  if (!done) throw_failure(done.error());
}

// Runs one scan. Then, `repeat` times, runs a warm scan to the video and another warm scan to the power only.
// `begin_ms`: value of wall_ms() when the reading of terrain began.
Times run_scans(Scan& scan, int repeat, double begin_ms) {
  Times times;
  for (int run = 0; run <= repeat; ++run) {
    const double run_begin_ms = wall_ms();
    const double cpu_begin_ms = processor_ms();
    check(scan.run());
    if (run == 0) {
      times.first_ms = wall_ms() - begin_ms;
      continue;
    }
    times.whole_ms.push_back(wall_ms() - run_begin_ms);
    times.cpu_ms.push_back(processor_ms() - cpu_begin_ms);
    const double measure_begin_ms = wall_ms();
    scan.measure();
    times.measure_ms.push_back(wall_ms() - measure_begin_ms);
  }
  return times;
}

nlohmann::ordered_json summary(const Scan& scan, const Times& times, double index_ms) {
  const double kernel_ms = median(times.whole_ms);
  nlohmann::ordered_json line;
  line["sweeps"] = scan.sweeps();
  line["samples"] = scan.samples();
  line["kernel_ms"] = kernel_ms;
  line["mean_ms"] =
      std::accumulate(times.whole_ms.begin(), times.whole_ms.end(), 0.0) / static_cast<double>(times.whole_ms.size());
  line["cpu_ms"] = median(times.cpu_ms);
  line["sweep_ms"] = median(times.measure_ms);
  line["first_ms"] = times.first_ms;
  line["index_ms"] = index_ms;
  line["samples_per_second"] = static_cast<double>(scan.power().size()) / (kernel_ms * 1e-3);
  return line;
}

// Prints the summary for people.
void print_text(const ScanCommandOptions& options, const nlohmann::ordered_json& line,
                std::span<const radar::RaySample> samples) {
  const auto percent = [&](auto&& has) {
    return 100.0 * static_cast<double>(std::ranges::count_if(samples, has)) / static_cast<double>(samples.size());
  };
  const auto is_void = [](const radar::RaySample& sample) { return std::isnan(sample.ground.elevation_m); };
  std::printf("scan    %zu sweeps of %u samples, %g NM, preset %s\n", line["sweeps"].get<std::size_t>(),
              line["samples"].get<unsigned>(), options.request.range_nm, line["fidelity"].get<std::string>().c_str());
  std::printf("ground  %.1f %% lit, %.1f %% in shadow, %.1f %% without elevation\n",
              percent([&](const radar::RaySample& sample) { return !is_void(sample) && sample.lit; }),
              percent([&](const radar::RaySample& sample) { return !is_void(sample) && !sample.lit; }),
              percent(is_void));
  std::printf("time    %.1f ms on %s, median of %d\n", line["kernel_ms"].get<double>(),
              text::counted(options.request.threads, "thread").c_str(), options.repeat);
  std::printf("hash    %llu\n", line["hash"].get<unsigned long long>());
  for (const std::string& file : {options.out, options.shadow})
    if (names_file(file)) std::printf("file    %s\n", text::printable(file).c_str());
}

void scan(const CommonOptions& common, const ScanCommandOptions& options) {
  check_output(options);
  const Radar radar(configure(common, options));
  const double opening_ms = wall_ms();
  const auto terrain = radar.terrain();
  if (!terrain) throw_failure(terrain.error());
  const double index_ms = wall_ms() - opening_ms;
  const double begin_ms = wall_ms();
  auto scan = Scan::prepare(radar, *terrain, options.request, nullptr, {.warn = warn_as("yars scan")});
  if (!scan) throw_failure(scan.error());
  const Times times = run_scans(*scan, options.repeat, begin_ms);

  const ScanFacts facts = scan->facts();
  nlohmann::ordered_json line = summary(*scan, times, index_ms);
  line["rays"] = facts.rays;
  line["terrain_bytes"] = facts.terrain_bytes;
  if (scan->work().environment.scene) line["scene_bytes"] = facts.scene_bytes;
  line["threads"] = options.request.threads;
  line["fidelity"] = facts.preset;
  line["hash"] = scan->hash();
  line["left_out"] = scan->left_out();
  if (names_file(options.out)) write_result(options, radar.configuration().view, *scan);
  std::vector<radar::RaySample> samples;
  if (names_file(options.shadow) || !options.json) samples = scan->work().ray_samples();
  if (names_file(options.shadow)) {
    std::ostringstream file;
    write_shadow(file, scan->work().headers(), samples);
    write_text_file(options.shadow, file);
  }
  options.json ? print_json(line) : print_text(options, line, samples);
  std::fflush(stdout);
  fail_if_left_out(scan->left_out());
}

}  // namespace

void add_scan_command(runtime::Command app, const CommonOptions& common) {
  auto options = std::make_shared<ScanCommandOptions>();
  runtime::Command command = app.subcommand("scan", "compute one scan of the real beam map, without a session");
  add_terrain_option(command, options->configuration.terrain).otherwise("the configuration's");
  add_scene_options(command, options->configuration);
  add_preset_option(command, "--fidelity", options->configuration.fidelity, "preset").otherwise("the configuration's");
  add_request_options(command, options->request);
  command.option("--repeat", options->repeat, "number of warm scans to time, after the first scan").range(1, 1000000);
  command.option("--size", options->size, "[pixels] per side of the picture")
      .range(16, 8192)
      .otherwise("the configuration's");
  command.option("--color", options->color, "colours of the picture").one_of({"green", "gray"});
  command
      .option("--out", options->out,
              "file: .png, .csv (video) or .f32 (power: little-endian floats, one row per sweep); none: no file")
      .value_name("FILE");
  command
      .option("--shadow", options->shadow,
              "file: .csv with position, elevation and shadow of each sample; none: no file")
      .value_name("FILE");
  add_json_flag(command, options->json);
  command.callback([options, &common] { scan(common, *options); });
}

}  // namespace yars::tools
