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
#include "lib/values/fields.hpp"
#include "radar/limits.hpp"
#include "tools/command/command.hpp"
#include "worldgen/scene/scene_builder.hpp"

namespace yars::tools {

SceneFile generate_scene_file(const std::string& file, const SceneGeneration& request,
                              const model::scene::ScenePosition& origin, const parallel::GoesOn& goes_on) {
  radar::check_fields(request);
  constexpr std::uint64_t kStep = 10'000;  // triangles per progress report
  Progress progress(request.triangles / kStep + 1);
  const worldgen::GeneratedScene made =
      worldgen::generate_scene({request.kind, request.triangles, request.seed, origin.position, origin.heading_deg},
                               [&](std::uint64_t triangles) {
                                 parallel::check(goes_on);
                                 progress.done(text::counted(triangles, "triangle"));
                               });
  const std::filesystem::path path = std::filesystem::absolute(file);
  if (const auto written = file::write_file_and_folders(path, made.file); !written) throw_failure(written.error());
  return {made.triangles, made.file.size()};
}

namespace {

struct SceneGenerateOptions {
  SceneGeneration request;
  std::string origin;  // LAT,LON[,HDG] [deg]
  std::string out;
  bool json = false;
};

}  // namespace

void add_scene_generate(runtime::Command scene) {
  const auto options = std::make_shared<SceneGenerateOptions>();
  runtime::Command command = scene.subcommand("generate", "write a made-up scene as an OpenFlight file");
  add_request_options(command, options->request);
  command
      .option("--origin", options->origin,
              "[deg] centre of the scene and the true bearing of its north (without a bearing, by the seed)")
      .value_name("LAT,LON[,HDG]")
      .required();
  command.option("--out", options->out, "OpenFlight file").value_name("FILE").required();
  add_json_flag(command, options->json);
  command.callback([options] {
    check_file_name("--out", options->out, {".flt"});
    auto origin = model::scene::parse_scene_position(options->origin);
    if (!origin) {
      origin.error().subject = "--origin";
      throw_failure(origin.error());
    }
    const SceneFile made = generate_scene_file(options->out, options->request, *origin);
    const std::string kind(values::SceneGeneration::kind.values[static_cast<std::size_t>(options->request.kind)]);
    if (options->json)
      return print_json({{"file", options->out}, {"kind", kind}, {"triangles", made.triangles}, {"bytes", made.bytes}});
    std::printf("%s  %s of %s, %s\n", options->out.c_str(), kind.c_str(),
                text::counted(made.triangles, "triangle").c_str(), text::counted(made.bytes, "byte").c_str());
  });
}

}  // namespace yars::tools
