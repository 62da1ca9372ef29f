// The project's own tile of culture: an indexed PNG beside the elevation cell, w122/n36.smc.png beside w122/n36.dt1,
// N36W122.smc.png beside N36W122.hgt. A pixel's number is the surface material code of a post; rows from north to
// south as in any picture, all four edges included; 2 to 10801 posts a side, whatever the elevation's. The palette
// is for eyes only.
#pragma once

#include <filesystem>
#include <optional>

namespace yars::model::terrain {

inline constexpr int kMostCulturePosts = 10801;  // a side: a third of an arc second

// Where the culture of a cell lies, given its elevation file (.zip and .gz are left off first).
std::filesystem::path culture_path(const std::filesystem::path& elevation);

// The same, if there is such a file.
std::optional<std::filesystem::path> find_culture(const std::filesystem::path& elevation);

}  // namespace yars::model::terrain
