// What commands have in common that make a folder of terrain from another one.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace yars::tools {

// True if `inner` is `outer` or lies in it.
bool lies_in(const std::filesystem::path& inner, const std::filesystem::path& outer);

// Copies the scenes that stand on the ground of the folder `in`, with the files beside them, to the folder `out`.
// Returns the number of copied files. `failed` receives a sentence for each file that is not copied.
std::size_t copy_scenes(const std::string& in, const std::string& out, std::vector<std::string>& failed);

}  // namespace yars::tools
