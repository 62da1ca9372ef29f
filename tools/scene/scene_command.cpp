// `yars scene info`: describes OpenFlight files.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "lib/geo/frames.hpp"
#include "lib/radar/world.hpp"
#include "lib/text/plain_text.hpp"
#include "model/scene/index/scene_index.hpp"
#include "model/scene/openflight/reader.hpp"
#include "tools/command/command.hpp"

namespace yars::tools {

void add_scene_command(runtime::Command app, const CommonOptions& /*common*/) {
  runtime::Command scene = app.subcommand("scene", "polygonal scenes (OpenFlight): generate, info, image");
  scene.require_subcommand();
  add_scene_generate(scene);
  add_scene_info(scene);
  add_scene_image(scene);
}

// `yars scene info`: prints counts, materials, extent and origin of OpenFlight files, as text or JSON.

namespace {

using namespace model::scene;

struct InfoOptions {
  std::vector<std::string> files;
  std::vector<std::string> without;
  bool json = false;
};

// Bounding box [m]: x east, y north, z up from the model's origin.
struct Extent {
  Vector3 min{INFINITY, INFINITY, INFINITY}, max{-INFINITY, -INFINITY, -INFINITY};
};

Extent extent_of(const Model& model) {
  Extent extent;
  for (const ModelVertex& vertex : model.vertices) {
    const double x = static_cast<double>(vertex.position_m[0]) + model.base.x;
    const double y = static_cast<double>(vertex.position_m[1]) + model.base.y;
    const double z = static_cast<double>(vertex.position_m[2]) + model.base.z;
    extent.min = {std::min(extent.min.x, x), std::min(extent.min.y, y), std::min(extent.min.z, z)};
    extent.max = {std::max(extent.max.x, x), std::max(extent.max.y, y), std::max(extent.max.z, z)};
  }
  return extent;
}

std::map<int, std::uint64_t> triangles_by_material(const Model& model) {
  std::map<int, std::uint64_t> counts;
  for (const ModelTriangle& triangle : model.triangles) ++counts[model.kinds[triangle.kind].material];
  return counts;
}

nlohmann::ordered_json origin_json(const std::optional<geo::GeoPoint>& origin) {
  if (!origin) return nullptr;
  return {{"latitude_deg", origin->latitude_deg}, {"longitude_deg", origin->longitude_deg}};
}

nlohmann::ordered_json describe(const std::string& file, const Model& model) {
  nlohmann::ordered_json report{{"file", file}, {"revision", model.header.revision}};
  report["metres_per_unit"] = model.header.metres_per_unit;
  report["origin"] = origin_json(model.header.origin);
  report["origin_in_name"] = origin_json(position_in_name(file.substr(file.find_last_of('/') + 1)));
  const FileCounts& c = model.counts;
  report["in_file"] = {{"vertices", c.vertices},   {"faces", c.faces},
                       {"corners", c.corners},     {"hidden_faces", c.hidden_faces},
                       {"objects", c.objects},     {"meshes", c.meshes},
                       {"materials", c.materials}, {"levels_of_detail", c.levels_of_detail},
                       {"instances", c.instances}, {"external_references", c.external_references}};
  report["shown"] = {{"polygons", model.polygons},
                     {"triangles", model.triangles.size()},
                     {"vertices", model.vertices.size()},
                     {"objects", model.objects.size() - 1},
                     {"kinds_of_surface", model.kinds.size()}};
  for (const auto& [material, count] : triangles_by_material(model))
    report["triangles_by_material"][std::to_string(material)] = count;
  if (!model.vertices.empty()) {
    const Extent extent = extent_of(model);
    report["extent_m"] = {{"west", extent.min.x},  {"east", extent.max.x},   {"south", extent.min.y},
                          {"north", extent.max.y}, {"lowest", extent.min.z}, {"highest", extent.max.z}};
  }
  report["external_files"] = model.files;
  report["left_out"] = model.left_out;
  report["warnings"] = model.warnings;
  return report;
}

std::string origin_text(const nlohmann::ordered_json& origin) {
  if (origin.is_null()) return "none";
  char text[64];
  std::snprintf(text, sizeof text, "%.6f, %.6f", origin["latitude_deg"].get<double>(),
                origin["longitude_deg"].get<double>());
  return text;
}

void print_counts(const char* title, const nlohmann::ordered_json& counts) {
  std::printf("  %s:", title);
  for (const auto& [name, count] : counts.items()) {
    std::string words = name;
    std::replace(words.begin(), words.end(), '_', ' ');
    std::printf("  %s %llu", words.c_str(), static_cast<unsigned long long>(count.get<std::uint64_t>()));
  }
  std::printf("\n");
}

void print(const nlohmann::ordered_json& report) {
  std::printf("%s\n  revision %.2f, unit %g m, origin %s\n", text::printable(report["file"].get<std::string>()).c_str(),
              report["revision"].get<int>() / 100.0, report["metres_per_unit"].get<double>(),
              origin_text(report["origin"]).c_str());
  if (!report["origin_in_name"].is_null())
    std::printf("  origin in the name %s\n", origin_text(report["origin_in_name"]).c_str());
  print_counts("in the file", report["in_file"]);
  print_counts("shown", report["shown"]);
  if (report.contains("triangles_by_material"))
    print_counts("triangles by surface material code", report["triangles_by_material"]);
  if (report.contains("extent_m")) {
    const auto& e = report["extent_m"];
    std::printf("  east %.1f to %.1f m, north %.1f to %.1f m, up %.1f to %.1f m\n", e["west"].get<double>(),
                e["east"].get<double>(), e["south"].get<double>(), e["north"].get<double>(), e["lowest"].get<double>(),
                e["highest"].get<double>());
  }
  const auto print_each = [&](const char* title, const char* field) {
    for (const auto& sentence : report[field])
      std::printf("  %s %s\n", title, text::printable(sentence.get<std::string>()).c_str());
  };
  print_each("with", "external_files");
  print_each("left out:", "left_out");
  print_each("warning:", "warnings");
}

void report_files(const InfoOptions& options) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  NameFilter filter = name_filter(options.without);
  std::size_t unreadable = 0, incomplete = 0;
  for (const std::string& text : options.files) {
    const auto scene = parse_scene(text);
    if (!scene) throw_failure(error::usage_error(scene.error()));
    const std::string& file = scene->file;
    const auto model = read_openflight(file, &filter);
    if (!model && options.files.size() == 1) throw_failure(model.error());
    if (!model) {
      std::fprintf(stderr, "yars scene info: %s\n", model.error().message().c_str());
      ++unreadable;
      continue;
    }
    all.push_back(describe(file, *model));
    incomplete += model->left_out.empty() ? 0 : 1;
    if (!options.json) print(all.back());
  }
  if (options.json) print_json({{"files", all}}, JsonLines::many);
  std::fflush(stdout);
  if (unreadable > 0)
    throw CommandFailed{"expected OpenFlight files, found " + std::to_string(unreadable) + " of " +
                        std::to_string(options.files.size()) + " that cannot be read"};
  if (const auto problem = filter.unmatched_error("--without")) throw_failure(*problem);
  if (incomplete > 0)
    throw CommandFailed{"expected OpenFlight files that are read whole, found " + std::to_string(incomplete) + " of " +
                        std::to_string(options.files.size()) + " with parts left out; see 'left out' above"};
}

}  // namespace

void add_scene_info(runtime::Command scene) {
  const auto options = std::make_shared<InfoOptions>();
  runtime::Command command =
      scene.subcommand("info", "print contents of OpenFlight files: counts, materials, extent, origin");
  command.option("--scene,FILE", options->files, "OpenFlight file; several may be given").value_name("FILE").required();
  add_without(command, options->without);
  add_json_flag(command, options->json);
  command.callback([options] { report_files(*options); });
}

}  // namespace yars::tools
