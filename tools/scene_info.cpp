// `yars scene info`: what OpenFlight files hold.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "model/scene/openflight_reader.hpp"
#include "model/scene/scene_source.hpp"
#include "tools/command.hpp"
#include "tools/scene_commands.hpp"

namespace yars::tools {

namespace {

using namespace model::scene;

struct InfoOptions {
  std::vector<std::string> files;
  std::vector<std::string> without;
  bool json = false;
};

struct Extent {
  Vector3 least{INFINITY, INFINITY, INFINITY}, most{-INFINITY, -INFINITY, -INFINITY};
};

Extent extent_of(const Model& model) {
  Extent extent;
  for (const ModelVertex& vertex : model.vertices) {
    const double x = static_cast<double>(vertex.place_m[0]) + model.base.x;
    const double y = static_cast<double>(vertex.place_m[1]) + model.base.y;
    const double z = static_cast<double>(vertex.place_m[2]) + model.base.z;
    extent.least = {std::min(extent.least.x, x), std::min(extent.least.y, y), std::min(extent.least.z, z)};
    extent.most = {std::max(extent.most.x, x), std::max(extent.most.y, y), std::max(extent.most.z, z)};
  }
  return extent;
}

std::map<int, std::uint64_t> triangles_by_material(const Model& model) {
  std::map<int, std::uint64_t> counts;
  for (const ModelTriangle& triangle : model.triangles) ++counts[model.kinds[triangle.kind].material];
  return counts;
}

nlohmann::json origin_json(const std::optional<geo::GeoPoint>& place) {
  if (!place) return nullptr;
  return {{"latitude_deg", place->latitude_deg}, {"longitude_deg", place->longitude_deg}};
}

nlohmann::json describe(const std::string& file, const Model& model) {
  nlohmann::json told{{"file", file}, {"revision", model.header.revision}};
  told["metres_per_unit"] = model.header.metres_per_unit;
  told["origin"] = origin_json(model.header.origin);
  told["origin_in_name"] = origin_json(place_in_name(file.substr(file.find_last_of('/') + 1)));
  const FileCounts& c = model.counts;
  told["in_file"] = {{"vertices", c.vertices},   {"faces", c.faces},
                     {"corners", c.corners},     {"hidden_faces", c.hidden_faces},
                     {"objects", c.objects},     {"meshes", c.meshes},
                     {"materials", c.materials}, {"levels_of_detail", c.levels_of_detail},
                     {"instances", c.instances}, {"external_references", c.external_references}};
  told["shown"] = {{"polygons", model.polygons},
                   {"triangles", model.triangles.size()},
                   {"vertices", model.vertices.size()},
                   {"objects", model.objects.size() - 1},
                   {"kinds_of_surface", model.kinds.size()}};
  for (const auto& [material, count] : triangles_by_material(model))
    told["triangles_by_material"][std::to_string(material)] = count;
  if (!model.vertices.empty()) {
    const Extent extent = extent_of(model);
    told["extent_m"] = {{"west", extent.least.x}, {"east", extent.most.x},    {"south", extent.least.y},
                        {"north", extent.most.y}, {"lowest", extent.least.z}, {"highest", extent.most.z}};
  }
  told["external_files"] = model.files;
  told["warnings"] = model.warnings;
  return told;
}

std::string place_text(const nlohmann::json& place) {
  if (place.is_null()) return "none";
  char text[64];
  std::snprintf(text, sizeof text, "%.6f, %.6f", place["latitude_deg"].get<double>(),
                place["longitude_deg"].get<double>());
  return text;
}

void print_counts(const char* title, const nlohmann::json& counts) {
  std::printf("  %s:", title);
  for (const auto& [name, count] : counts.items()) {
    std::string words = name;
    std::replace(words.begin(), words.end(), '_', ' ');
    std::printf("  %s %llu", words.c_str(), static_cast<unsigned long long>(count.get<std::uint64_t>()));
  }
  std::printf("\n");
}

void print(const nlohmann::json& told) {
  std::printf("%s\n  revision %.2f, unit %g m, origin %s\n", told["file"].get<std::string>().c_str(),
              told["revision"].get<int>() / 100.0, told["metres_per_unit"].get<double>(),
              place_text(told["origin"]).c_str());
  if (!told["origin_in_name"].is_null())
    std::printf("  origin in the name %s\n", place_text(told["origin_in_name"]).c_str());
  print_counts("in the file", told["in_file"]);
  print_counts("shown", told["shown"]);
  if (told.contains("triangles_by_material"))
    print_counts("triangles by surface material code", told["triangles_by_material"]);
  if (told.contains("extent_m")) {
    const auto& e = told["extent_m"];
    std::printf("  east %.1f to %.1f m, north %.1f to %.1f m, up %.1f to %.1f m\n", e["west"].get<double>(),
                e["east"].get<double>(), e["south"].get<double>(), e["north"].get<double>(), e["lowest"].get<double>(),
                e["highest"].get<double>());
  }
  for (const auto& file : told["external_files"]) std::printf("  with %s\n", file.get<std::string>().c_str());
  for (const auto& warning : told["warnings"]) std::printf("  warning: %s\n", warning.get<std::string>().c_str());
}

void tell(const InfoOptions& options) {
  nlohmann::json all = nlohmann::json::array();
  NameFilter filter = name_filter(options.without);
  std::size_t unreadable = 0;
  for (const std::string& file : options.files) {
    const auto model = read_openflight(file, &filter);
    if (!model && options.files.size() == 1) give_up(model.error());
    if (!model) {
      std::fprintf(stderr, "yars scene info: %s\n", model.error().message().c_str());
      ++unreadable;
      continue;
    }
    all.push_back(describe(file, *model));
    if (!options.json) print(all.back());
  }
  if (unreadable > 0)
    throw CommandFailed{"expected OpenFlight files, found " + std::to_string(unreadable) + " of " +
                        std::to_string(options.files.size()) + " that cannot be read"};
  if (const auto complaint = filter.complaint("--without")) give_up(*complaint);
  if (options.json) std::printf("%s\n", all.dump(2).c_str());
}

}  // namespace

void add_scene_info(CLI::App& scene) {
  const auto options = std::make_shared<InfoOptions>();
  CLI::App* command = scene.add_subcommand("info", "what OpenFlight files hold: counts, materials, extent, origin");
  command->add_option("files", options->files, "OpenFlight files")->required();
  add_without(*command, options->without);
  command->add_flag("--json", options->json, "as JSON");
  command->callback([options] { tell(*options); });
}

}  // namespace yars::tools
