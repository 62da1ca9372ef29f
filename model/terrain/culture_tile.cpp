#include "model/terrain/culture_tile.hpp"

#include <system_error>

namespace yars::model::terrain {

std::filesystem::path culture_path(const std::filesystem::path& elevation) {
  std::filesystem::path stem = elevation;
  if (stem.extension() == ".zip" || stem.extension() == ".gz") stem.replace_extension();
  return stem.replace_extension(".smc.png");
}

std::optional<std::filesystem::path> find_culture(const std::filesystem::path& elevation) {
  std::filesystem::path path = culture_path(elevation);
  std::error_code code;
  if (!std::filesystem::is_regular_file(path, code)) return std::nullopt;
  return path;
}

}  // namespace yars::model::terrain
