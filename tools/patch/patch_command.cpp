// `yars patch`: computes one patch map in this process. Writes a picture or numbers to the file of --out, if given.
// Prints what was computed, shares, run time and hash, or the same and more as JSON. Source of option names and JSON
// fields: docs/commands.md#patch.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lib/imageio/png.hpp"
#include "lib/radar/configuration.hpp"
#include "lib/text/plain_text.hpp"
#include "model/terrain/gdal/map_writer.hpp"
#include "model/terrain/gdal/raster.hpp"
#include "runtime/program.hpp"
#include "tools/command/command.hpp"
#include "yars/radar.hpp"

namespace yars::tools {

// Output of `yars patch`: a picture (.png), power (.f32, see output.hpp), or picture or power as GeoTIFF (.tif, by
// GDAL). The first row is the far edge of the map. Errors: the functions throw CommandFailed.

struct PatchOutput {
  std::string file = kNoFile;    // kNoFile: computed and reported, nothing written
  std::string pixels = "video";  // pixels of a .tif: "video" or "power"
};

// Checks the options before the computation. Throws for an unknown file extension, for a file that cannot be created,
// for pixels "power" without a .tif, and for a .tif in a build without GDAL.
void check_patch_output(const PatchOutput& output);

// Writes the file. A power of 1 is the return of level ground with gamma 1 at the map's centre. With the preset `1996`
// the power values are brightness 0 to 1. With any preset, the power of pixels in the blind zone is "no data" in a .tif
// and -1 in a .f32.
void write_patch(const PatchOutput& output, const Patch& patch);

namespace {

namespace gdal = model::terrain::gdal;

void write_raster(const PatchOutput& output, const Patch& patch) {
  const PatchFacts facts = patch.facts();
  gdal::MapPicture picture;
  picture.columns = picture.rows = patch.size();
  picture.origin_latitude_deg = facts.latitude_deg;
  picture.origin_longitude_deg = facts.longitude_deg;
  picture.plane_from_pixel = facts.plane_from_pixel;
  if (output.pixels == "video") {
    picture.pixels = std::vector<std::uint8_t>(patch.video().begin(), patch.video().end());
    picture.description = "video, 0 black to 255 white";
  } else {
    std::vector<float> power(patch.power().begin(), patch.power().end());
    std::replace_if(
        power.begin(), power.end(), [](float value) { return value < 0.0F; }, std::numeric_limits<float>::quiet_NaN());
    picture.pixels = std::move(power);
    picture.description = "power as gamma of level ground, before speckle and noise";
  }
  if (auto written = gdal::write_map(output.file, picture); !written) throw_failure(written.error());
}

}  // namespace

void check_patch_output(const PatchOutput& output) {
  const std::string suffix = ending_of(output.file);
  if (output.pixels != "video" && suffix != ".tif")
    throw_failure(error::usage_error("--pixels", "an --out that ends in .tif", output.file));
  if (suffix == ".tif" && !gdal::available())
    throw_failure({output.file, "a YARS built with GDAL to write a GeoTIFF", "one built without it",
                   "run `scripts/setup --gdal` and build again, or write a .png"});
  check_file_name("--out", output.file, {".png", ".tif", ".f32"});
}

void write_patch(const PatchOutput& output, const Patch& patch) {
  const std::filesystem::path path(output.file);
  const std::string suffix = ending_of(output.file);
  if (suffix == ".f32") {
    if (auto written = write_floats(path, patch.power()); !written) throw_failure(written.error());
    return;
  }
  if (suffix == ".tif") return write_raster(output, patch);
  imageio::Image picture{patch.size(), patch.size(), 1, {patch.video().begin(), patch.video().end()}};
  if (auto written = imageio::write_png(path, picture); !written) throw_failure(written.error());
}

namespace {

// Times of one map [ms]: wall time of all steps together, and of each of Patch::steps().
struct Timing {
  double whole_ms = 0.0;
  double cpu_ms = 0.0;  // processor time of all threads, all steps together
  std::map<std::string_view, double> steps_ms;
};

struct PatchCommandOptions {
  ConfigurationOptions configuration;
  PatchRequest request;
  PatchOutput output;
  int repeat = 1;
  bool json = false;
};

Timing run_once(Patch& patch) {
  Timing timing;
  const double begin_ms = wall_ms();
  const double cpu_begin_ms = processor_ms();
  double step_begin_ms = begin_ms;
  const auto done = patch.run({.progress = [&](std::string_view step, double) {
    timing.steps_ms[step] += wall_ms() - step_begin_ms;  // large maps come by sectors
    step_begin_ms = wall_ms();
  }});
  if (!done) throw_failure(done.error());
  timing.whole_ms = wall_ms() - begin_ms;
  timing.cpu_ms = processor_ms() - cpu_begin_ms;
  return timing;
}

// Names the cause of black pixels on standard error, because the picture does not show it: the blind zone; or shadow
// and horizon, if no pixel has a return.
void report_dark_pixels(std::span<const float> powers) {
  const auto pixels = static_cast<double>(powers.size());
  const auto blind = std::ranges::count_if(powers, [](float power) { return power < 0.0F; });
  const bool seen = std::ranges::any_of(powers, [](float power) { return power > 0.0F; });
  if (blind > 0)
    std::fprintf(stderr, "yars patch: %.1f %% of the map lie in the blind zone and are blank\n",
                 100.0 * static_cast<double>(blind) / pixels);
  if (!seen && static_cast<double>(blind) < pixels)
    std::fprintf(stderr, "yars patch: nothing of the map is seen: it lies in shadow or beyond the horizon\n");
}

// Prints the summary for people.
void print_text(const PatchCommandOptions& options, const nlohmann::ordered_json& line, const Patch& patch) {
  const auto percent = [&](auto&& has) {
    return 100.0 * static_cast<double>(std::ranges::count_if(patch.power(), has)) /
           static_cast<double>(patch.power().size());
  };
  std::printf("map     %d x %d pixels, %g NM, preset %s, %s of scenes\n", patch.size(), patch.size(),
              geo::Length::metres(patch.facts().window_m).nautical_miles(), line["fidelity"].get<std::string>().c_str(),
              text::counted(line["triangles"].get<std::size_t>(), "triangle").c_str());
  std::printf("pixels  %.1f %% with an echo, %.1f %% without, %.1f %% in the blind zone\n",
              percent([](float power) { return power > 0.0F; }), percent([](float power) { return power == 0.0F; }),
              percent([](float power) { return power < 0.0F; }));
  std::printf("time    %.1f ms on %s, median of %d; the radar takes %.1f s\n", line["kernel_ms"].get<double>(),
              text::counted(line["threads"].get<std::size_t>(), "thread").c_str(), options.repeat,
              line["formation_s"].get<double>());
  std::printf("hash    %llu\n", line["hash"].get<unsigned long long>());
  if (names_file(options.output.file)) std::printf("file    %s\n", text::printable(options.output.file).c_str());
}

void patch(const CommonOptions& common, const PatchCommandOptions& options) {
  check_patch_output(options.output);
  const Radar radar(read_configuration(common.config, options.configuration));
  const auto terrain = radar.terrain();
  if (!terrain) throw_failure(terrain.error());
  const double begin_ms = wall_ms();
  auto patch = Patch::prepare(radar, *terrain, options.request, {}, {.warn = warn_as("yars patch")});
  if (!patch) throw_failure(patch.error());
  const double database_ms = wall_ms() - begin_ms;
  std::vector<double> whole_ms, cpu_ms;
  std::map<std::string_view, std::vector<double>> steps_ms;
  for (int run = 0; run <= options.repeat; ++run) {
    const Timing timing = run_once(*patch);
    if (run == 0) continue;  // warm-up: its time is not used
    whole_ms.push_back(timing.whole_ms);
    cpu_ms.push_back(timing.cpu_ms);
    for (const auto& [step, time_ms] : timing.steps_ms) steps_ms[step].push_back(time_ms);
  }
  const PatchFacts facts = patch->facts();
  nlohmann::ordered_json line;
  line["size"] = patch->size();
  line["triangles"] = facts.triangles;
  line["kernel_ms"] = median(whole_ms);
  line["cpu_ms"] = median(cpu_ms);
  for (const std::string_view step : Patch::steps()) line["stages_ms"][std::string(step)] = median(steps_ms[step]);
  line["database_ms"] = database_ms;
  line["formation_s"] = facts.formation_s;
  line["resolution_ft"] = geo::Length::metres(facts.resolution_m).feet();
  line["terrain_bytes"] = facts.terrain_bytes;
  line["threads"] = facts.threads;
  line["fidelity"] = facts.preset;
  line["hash"] = patch->hash();
  line["left_out"] = patch->left_out();
  report_dark_pixels(patch->power());
  if (names_file(options.output.file)) write_patch(options.output, *patch);
  options.json ? print_json(line) : print_text(options, line, *patch);
  std::fflush(stdout);
  fail_if_left_out(patch->left_out());
}

}  // namespace

void add_patch_command(runtime::Command app, const CommonOptions& common) {
  auto options = std::make_shared<PatchCommandOptions>();
  runtime::Command command = app.subcommand("patch", "compute one patch map, without a session");
  add_terrain_option(command, options->configuration.terrain).otherwise("the configuration's");
  add_scene_options(command, options->configuration);
  add_preset_option(command, "--fidelity", options->configuration.fidelity, "preset").otherwise("the configuration's");
  add_request_options(command, options->request);
  command.option("--repeat", options->repeat, "number of maps to time, after one untimed map").range(1, 1000000);
  command
      .option("--out", options->output.file,
              "file: .png, .tif (georeferenced) or .f32 (power: little-endian floats, rows from the far edge); none: "
              "no file")
      .value_name("FILE");
  command.option("--pixels", options->output.pixels, "pixels of a .tif: video (8 bits) or power (32-bit float)")
      .one_of({"video", "power"});
  add_json_flag(command, options->json);
  command.callback([options, &common] { patch(common, *options); });
}

}  // namespace yars::tools
