#include "model/scene/scene_index.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "model/scene/openflight_reader.hpp"
#include "model/scene/scene_source.hpp"
#include "model/terrain/link_target.hpp"

namespace yars::model::scene {

namespace {

namespace fs = std::filesystem;

double distance_m(geo::GeoPoint a, geo::GeoPoint b) {
  return geo::geodesic_inverse(a, b).distance.metres();
}

// From the header's corners; they count from the header's own origin, wherever the scene is put.
double reach_of(const Header& header) {
  if (!header.origin || !header.south_west || !header.north_east) return kUnknownReach_m;
  const geo::GeoPoint south_east{header.south_west->latitude_deg, header.north_east->longitude_deg};
  const geo::GeoPoint north_west{header.north_east->latitude_deg, header.south_west->longitude_deg};
  double most_m = 0.0;
  for (const geo::GeoPoint corner : {*header.south_west, *header.north_east, south_east, north_west})
    most_m = std::max(most_m, distance_m(*header.origin, corner));
  return most_m;
}

failure::Expected<IndexedScene> index_file(const fs::path& file, const radar::Scene& scene) {
  const auto header = read_openflight_header(file);
  if (!header) return tl::unexpected(header.error());
  IndexedScene found{file, {scene.place, scene.heading_deg, scene.heights}, reach_of(*header), scene.without};
  if (std::isfinite(scene.place.latitude_deg) && std::isfinite(scene.place.longitude_deg)) return found;
  if (const auto named = place_in_name(file.filename().string())) {
    found.placement.place = *named;
  } else if (header->origin) {
    found.placement.place = *header->origin;
  } else {
    return failure::fail(file.string(), "a scene with a place: given with it, in its name, or as its header's origin",
                         "none", "give latitude and longitude, or FILE@LAT,LON,HDG");
  }
  return found;
}

// Of a folder each file leaves out what it has of the names.
failure::Expected<void> check_names(const radar::Scene& scene) {
  if (scene.without.empty()) return {};
  NameFilter filter(scene.without);
  if (const auto model = read_openflight(scene.file, &filter); !model) return tl::unexpected(model.error());
  if (const auto complaint = filter.complaint(scene.file)) return tl::unexpected(*complaint);
  return {};
}

std::vector<fs::path> files_in(const fs::path& folder) {
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

}  // namespace

failure::Expected<std::vector<IndexedScene>> index_scenes(const std::vector<radar::Scene>& scenes,
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
    const std::vector<fs::path> files = files_in(scene.file);
    if (files.empty())
      return failure::fail(scene.file, "a folder with .flt files", "none", "give a file or another folder");
    const fs::path root = fs::weakly_canonical(scene.file, code);
    for (const fs::path& file : files) {
      if (terrain::leads_out(file, root)) {
        problems.push_back(failure::Error{file.string(), "a file inside " + root.string(), "a link that leads out",
                                          "copy the scene there, or name it by itself", false}
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
