// `yars scene image`: an OpenFlight file seen from above, for people to look at.
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "model/scene/openflight_reader.hpp"
#include "tools/command.hpp"
#include "tools/output_name.hpp"
#include "tools/scene_commands.hpp"
#include "tools/scene_plan.hpp"

namespace yars::tools {

namespace {

struct Options {
  std::string file;
  std::string out;
  std::vector<std::string> without;
  int width = 1024;
  bool material = false;
  std::vector<double> window;  // west, south, side; empty: all of it
};

void draw(const Options& options) {
  check_file_name("--out", options.out, {".png"});
  if (!options.window.empty() && !(options.window[2] > 0.0))
    throw CommandFailed{"--window: expected a side longer than 0 m, found " + std::to_string(options.window[2]), 2};
  model::scene::NameFilter filter = name_filter(options.without);
  const auto model = model::scene::read_openflight(options.file, &filter);
  if (!model) give_up(model.error());
  if (const auto complaint = filter.complaint(options.file)) give_up(*complaint);
  PlanFrame frame = plan_frame(*model, options.width);
  if (!options.window.empty())
    frame = {options.window[0] - model->base.x, options.window[1] - model->base.y, options.window[2] / options.width,
             options.width, options.width};
  const PlanColors colors = options.material ? PlanColors::material : PlanColors::file;
  if (const auto written = imageio::write_png(options.out, draw_plan(*model, frame, colors)); !written)
    give_up(written.error());
}

}  // namespace

void add_scene_image(CLI::App& scene) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = scene.add_subcommand("image", "a plan view as PNG, north up, shaded by normals");
  command->add_option("file", options->file, "OpenFlight file")->required();
  command->add_option("--out", options->out, "PNG file")->required();
  command->add_option("--width", options->width, "[pixels] of the longer side")
      ->check(CLI::Range(16, 8192))
      ->capture_default_str();
  command->add_option("--window", options->window, "WEST SOUTH SIDE [m] from the origin; else all of it")->expected(3);
  add_without(*command, options->without);
  command->add_flag("--material", options->material, "colours by surface material code, magenta where there is none");
  command->callback([options] { draw(*options); });
}

}  // namespace yars::tools
