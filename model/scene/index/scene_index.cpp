#include "model/scene/index/scene_index.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <string_view>
#include <vector>

#include "lib/radar/world.hpp"
#include "lib/text/plain_text.hpp"
#include "model/scene/openflight/node_tree.hpp"
#include "model/scene/openflight/reader.hpp"
#include "model/terrain/store/cell_files.hpp"

namespace yars::model::scene {

namespace {

std::optional<std::vector<double>> numbers(std::string_view list) {
  std::vector<double> found;
  for (const std::string_view field : text::fields_of(list, ',')) {
    const std::optional<double> value = text::finite_number(field);
    if (!value) return std::nullopt;
    found.push_back(*value);
  }
  return found;
}

// Parses an angle: the letter `positive` or `negative`, then degrees_minutes_seconds. Removes the angle from the front
// of `text`.
std::optional<double> take_angle(std::string_view& text, char positive, char negative) {
  if (text.empty()) return std::nullopt;
  const char side = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  if (side != positive && side != negative) return std::nullopt;
  text.remove_prefix(1);
  double degrees = 0.0;
  for (const double parts : {1.0, 60.0, 3600.0}) {
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || value < 0 || (parts > 1.0 && value >= 60)) return std::nullopt;
    degrees += value / parts;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    if (parts == 3600.0) break;
    if (text.empty() || text[0] != '_') return std::nullopt;
    text.remove_prefix(1);
  }
  return side == negative ? -degrees : degrees;
}

// Adds `name`, the name of parts to leave out, to radar::Scene::without of each scene that is a folder, and of each
// scene that is a file with a matching part.
error::Expected<void> exclude(std::vector<radar::Scene>& scenes, const std::string& name) {
  NameFilter all(name);
  if (scenes.empty() || all.unmatched_names().empty())
    return error::fail("scene_without", "a scene, and the name of a part to leave out",
                       scenes.empty() ? "no scene" : "an empty name", "give the file of a scene, and a name");
  bool applied = false;
  for (radar::Scene& scene : scenes) {
    std::error_code code;
    if (!std::filesystem::is_directory(scene.file, code)) {
      NameFilter filter(name);
      if (const auto model = read_openflight(scene.file, &filter); !model) return tl::unexpected(model.error());
      all.add_seen(filter);
      if (!filter.unmatched_names().empty()) continue;
    }
    applied = true;
    scene.without += (scene.without.empty() ? "" : ",") + name;
  }
  if (applied) return {};
  return tl::unexpected(*all.unmatched_error("scene_without"));
}

}  // namespace

error::Expected<ScenePosition> scene_position(std::span<const double> numbers) {
  const auto is_within = [&](std::size_t at, double limit) {
    return numbers.size() <= at || std::abs(numbers[at]) <= limit;
  };
  if (numbers.size() == 2 || numbers.size() == 3)
    if (is_within(0, 90.0) && is_within(1, 360.0) && is_within(2, 360.0))
      return ScenePosition{{numbers[0], geo::wrapped_degrees(numbers[1])},
                           numbers.size() == 3 ? std::optional(numbers[2]) : std::nullopt};
  std::string found;
  for (const double number : numbers) found += (found.empty() ? "" : ",") + text::text_of_number(number);
  return tl::unexpected(error::usage_error({}, "LATITUDE,LONGITUDE or LATITUDE,LONGITUDE,HEADING in degrees",
                                           "'" + found + "'", "write it as 37.5,-122.3,45"));
}

error::Expected<ScenePosition> parse_scene_position(const std::string& text) {
  auto position = scene_position(numbers(text).value_or(std::vector<double>()));
  if (!position) position.error().found = "'" + text + "'";
  return position;
}

error::Expected<radar::Scene> parse_scene(const std::string& text) {
  radar::Scene scene;
  const std::size_t at = text.rfind('@');
  std::error_code code;
  scene.file = text.substr(0, at == std::string::npos || std::filesystem::exists(text, code) ? text.size() : at);
  if (scene.file.size() == text.size()) return scene;
  const auto position = parse_scene_position(text.substr(at + 1));
  if (!position || scene.file.empty())
    return error::fail(text, "an existing file, FILE@LATITUDE,LONGITUDE or FILE@LATITUDE,LONGITUDE,HEADING in degrees",
                       std::string("'").append(text, at) + "'", "write it as airfield.flt@37.5,-122.3,45");
  scene.position = position->position;
  scene.heading_deg = position->heading_deg.value_or(0.0);
  return scene;
}

error::Expected<void> add_scenes(std::vector<radar::Scene>& scenes, const std::vector<std::string>& texts,
                                 const std::vector<std::string>& names) {
  for (const std::string& text : texts) {
    auto scene = parse_scene(text);
    if (!scene) return tl::unexpected(scene.error());
    scenes.push_back(std::move(*scene));
  }
  for (const std::string& name : names)
    if (auto done = exclude(scenes, name); !done) return done;
  return {};
}

std::optional<geo::GeoPoint> position_in_name(const std::string& name) {
  for (std::size_t start = 0; start < name.size(); ++start) {
    std::string_view rest = std::string_view(name).substr(start);
    const std::optional<double> latitude_deg = take_angle(rest, 'N', 'S');
    if (!latitude_deg) continue;
    if (!rest.empty() && rest[0] == '_') rest.remove_prefix(1);
    const std::optional<double> longitude_deg = take_angle(rest, 'E', 'W');
    if (longitude_deg && std::abs(*latitude_deg) <= 90.0 && std::abs(*longitude_deg) <= 180.0)
      return geo::GeoPoint{*latitude_deg, *longitude_deg};
  }
  return std::nullopt;
}

namespace {

namespace fs = std::filesystem;

double distance_m(geo::GeoPoint a, geo::GeoPoint b) {
  return geo::geodesic_inverse(a, b).distance.metres();
}

// Maximum distance from the header's origin to the header's corners. It does not depend on the scene's position.
double reach_of(const Header& header) {
  if (!header.origin || !header.south_west || !header.north_east) return kUnknownReach_m;
  const geo::GeoPoint south_east{header.south_west->latitude_deg, header.north_east->longitude_deg};
  const geo::GeoPoint north_west{header.north_east->latitude_deg, header.south_west->longitude_deg};
  double max_m = 0.0;
  for (const geo::GeoPoint corner : {*header.south_west, *header.north_east, south_east, north_west})
    max_m = std::max(max_m, distance_m(*header.origin, corner));
  return max_m;
}

error::Expected<IndexedScene> index_file(const fs::path& file, const radar::Scene& scene) {
  const auto header = read_openflight_header(file);
  if (!header) return tl::unexpected(header.error());
  IndexedScene found{file, {scene.position, scene.heading_deg, scene.heights}, reach_of(*header), scene.without};
  if (std::isfinite(scene.position.latitude_deg) && std::isfinite(scene.position.longitude_deg)) return found;
  if (const auto named = position_in_name(file.filename().string())) {
    found.placement.position = *named;
  } else if (header->origin) {
    found.placement.position = *header->origin;
  } else {
    return error::fail(file.string(), "a scene with a position: in the scene argument, the file's name or the header",
                       "none", "give latitude and longitude, or FILE@LAT,LON,HDG");
  }
  return found;
}

// Checks that each name to leave out matches a part of the scene's file. Not called for the files of a folder, in which
// a name may match nothing.
error::Expected<void> check_names(const radar::Scene& scene) {
  if (scene.without.empty()) return {};
  NameFilter filter(scene.without);
  if (const auto model = read_openflight(scene.file, &filter); !model) return tl::unexpected(model.error());
  if (const auto unmet = filter.unmatched_error(scene.file)) return tl::unexpected(*unmet);
  return {};
}

}  // namespace

std::vector<fs::path> scene_files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code code;
  for (fs::directory_iterator entry(folder, code), end; !code && entry != end; entry.increment(code)) {
    std::string extension = entry->path().extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
    if (extension == ".flt") files.push_back(entry->path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

error::Expected<std::vector<IndexedScene>> index_scenes(const std::vector<radar::Scene>& scenes,
                                                        std::vector<std::string>& problems) {
  std::vector<IndexedScene> index;
  for (const radar::Scene& scene : scenes) {
    std::error_code code;
    if (!fs::is_directory(scene.file, code)) {
      auto found = index_file(scene.file, scene);
      if (!found) return tl::unexpected(found.error());
      if (auto known = check_names(scene); !known) return tl::unexpected(known.error());
      index.push_back(std::move(*found));
      continue;
    }
    const std::vector<fs::path> files = scene_files_in(scene.file);
    if (files.empty())
      return error::fail(scene.file, "a folder with .flt files", "none", "give a file or another folder");
    const fs::path root = fs::weakly_canonical(scene.file, code);
    for (const fs::path& file : files) {
      if (terrain::links_outside(file, root)) {
        problems.push_back(error::Error{file.string(), "a file inside " + root.string(), "a link that leads out",
                                        "copy the scene into that folder, or give the path of the file"}
                               .message());
        continue;
      }
      auto found = index_file(file, scene);
      if (found)
        index.push_back(std::move(*found));
      else
        problems.push_back(found.error().message());
    }
  }
  return index;
}

}  // namespace yars::model::scene
