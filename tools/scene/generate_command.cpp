// `yars scene generate`: writes a made-up airfield, harbour, bridge or town as an OpenFlight file.

#include "tools/scene/generate_command.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "lib/file/output_file.hpp"
#include "lib/radar/world.hpp"
#include "lib/text/plain_text.hpp"
#include "model/scene/index/scene_index.hpp"
#include "tools/command/command.hpp"
#include "tools/command/json_output.hpp"
#include "tools/command/output.hpp"
#include "worldgen/scene/scene_builder.hpp"

namespace yars::tools {

SceneFile generate_scene_file(const SceneGenerateOptions& options, const parallel::GoesOn& goes_on) {
  check_file_name("--out", options.out, {".flt"});
  worldgen::SceneRequest order{.triangles = options.triangles, .seed = options.seed, .origin = {}};
  order.kind = *worldgen::generated_kind(options.kind);
  const auto parsed = model::scene::parse_scene_position(options.origin);
  if (!parsed) {
    error::Error problem = parsed.error();
    problem.subject = "--origin";
    throw_failure(error::usage_error(std::move(problem)));
  }
  order.origin = parsed->position;
  order.heading_deg = parsed->heading_deg;
  constexpr std::uint64_t kStep = 10'000;  // triangles per progress report
  Progress progress(options.triangles / kStep + 1);
  const worldgen::GeneratedScene made = worldgen::generate_scene(order, [&](std::uint64_t triangles) {
    parallel::check(goes_on);
    progress.done(text::counted(triangles, "triangle"));
  });
  const std::filesystem::path path = std::filesystem::absolute(options.out);
  if (const auto written = file::write_file_and_folders(path, made.file); !written) throw_failure(written.error());
  return {made.triangles, made.file.size()};
}

void add_scene_generate_options(runtime::Command command, SceneGenerateOptions& options) {
  command.option("--kind", options.kind, "kind of scene").one_of({"airfield", "harbour", "bridge", "town"});
  command.option("--triangles", options.triangles, "approximate number; an instance counts at each use")
      .range(std::uint64_t{1}, worldgen::kMaxGenerated);
  command.option("--seed", options.seed, "seed; each seed gives another scene");
  command
      .option("--origin", options.origin,
              "[deg] centre of the scene and the true bearing of its north (without a bearing, by the seed)")
      .value_name("LAT,LON[,HDG]")
      .required();
  command.option("--out", options.out, "OpenFlight file").value_name("FILE").required();
  add_json_flag(command, options.json);
}

void add_scene_generate(runtime::Command scene) {
  const auto options = std::make_shared<SceneGenerateOptions>();
  runtime::Command command = scene.subcommand("generate", "write a made-up scene as an OpenFlight file");
  add_scene_generate_options(command, *options);
  command.callback([options] {
    const SceneFile made = generate_scene_file(*options);
    if (options->json)
      return print_json(
          {{"file", options->out}, {"kind", options->kind}, {"triangles", made.triangles}, {"bytes", made.bytes}});
    std::printf("%s  %s of %s, %s\n", options->out.c_str(), options->kind.c_str(),
                text::counted(made.triangles, "triangle").c_str(), text::counted(made.bytes, "byte").c_str());
  });
}

}  // namespace yars::tools
