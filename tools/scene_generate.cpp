// `yars scene generate`: a made-up airfield, harbour, bridge or town as an OpenFlight file.
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "lib/file/new_file.hpp"
#include "model/scene/generator.hpp"
#include "model/scene/scene_source.hpp"
#include "tools/command.hpp"
#include "tools/output_name.hpp"
#include "tools/progress.hpp"
#include "tools/scene_commands.hpp"

namespace yars::tools {

namespace {

using namespace model::scene;

struct GenerateOptions {
  std::string kind = "airfield";
  std::uint64_t triangles = 20'000;
  std::uint64_t seed = 1;
  std::string origin;
  std::string out;
};

void generate(const GenerateOptions& options) {
  check_file_name("--out", options.out, {".flt"});
  SceneOrder order{.triangles = options.triangles, .seed = options.seed, .origin = {}};
  order.kind = *generated_kind(options.kind);
  const auto place = parse_scene("--origin@" + options.origin);
  if (!place)
    throw CommandFailed{"--origin: expected LATITUDE,LONGITUDE in degrees, found '" + options.origin + "'", 2};
  order.origin = place->place;
  constexpr std::uint64_t kStep = 10'000;
  Progress progress(options.triangles / kStep + 1, stderr);
  const GeneratedScene made =
      generate_scene(order, [&](std::uint64_t triangles) { progress.done(std::to_string(triangles) + " triangles"); });
  const std::filesystem::path path = std::filesystem::absolute(options.out);
  if (const auto written = file::write_file_and_folders(path, made.file); !written) give_up(written.error());
  std::printf("%s  %s of %llu triangles, %zu bytes\n", options.out.c_str(), options.kind.c_str(),
              static_cast<unsigned long long>(made.triangles), made.file.size());
}

}  // namespace

void add_scene_generate(CLI::App& scene) {
  const auto options = std::make_shared<GenerateOptions>();
  CLI::App* command = scene.add_subcommand("generate", "a made-up scene as an OpenFlight file");
  command->add_option("--kind", options->kind, "what it is")
      ->check(CLI::IsMember({"airfield", "harbour", "bridge", "town"}))
      ->capture_default_str();
  command->add_option("--triangles", options->triangles, "about how many, instances counted each time")
      ->check(CLI::Range(std::uint64_t{1}, kMostGenerated))
      ->capture_default_str();
  command->add_option("--seed", options->seed, "another seed, another scene")->capture_default_str();
  command->add_option("--origin", options->origin, "LAT,LON [deg]: where its middle stands")->required();
  command->add_option("--out", options->out, "OpenFlight file")->required();
  command->callback([options] { generate(*options); });
}

}  // namespace yars::tools
