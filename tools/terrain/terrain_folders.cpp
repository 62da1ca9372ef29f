#include "tools/terrain/terrain_folders.hpp"

#include <limits>
#include <system_error>

#include "lib/error/error.hpp"
#include "lib/file/output_file.hpp"
#include "model/scene/index/scene_store.hpp"
#include "model/terrain/formats/cell_reading.hpp"
#include "model/terrain/store/cell_files.hpp"

namespace yars::tools {

using namespace model::terrain;

bool lies_in(const std::filesystem::path& inner, const std::filesystem::path& outer) {
  const std::filesystem::path relative =
      std::filesystem::weakly_canonical(inner).lexically_relative(std::filesystem::weakly_canonical(outer));
  return !relative.empty() && *relative.begin() != "..";
}

std::size_t copy_scenes(const std::string& in, const std::string& out, std::vector<std::string>& failed) {
  namespace fs = std::filesystem;
  const fs::path from = fs::path(in) / model::scene::kTerrainScenes;
  std::error_code code;
  if (!fs::is_directory(from, code)) return 0;
  const fs::path root = fs::weakly_canonical(in, code);
  std::size_t copied = 0;
  fs::recursive_directory_iterator entry(from, code);
  for (const fs::recursive_directory_iterator end; !code && entry != end; entry.increment(code)) {
    const fs::path& path = entry->path();
    std::error_code ignored;
    if (entry->is_directory(ignored)) continue;
    if (links_outside(path, root)) {
      failed.push_back(error::Error{path.string(), "a file inside " + root.string(), "a link that leads out",
                                    "copy the file into the folder"}
                           .message());
      continue;
    }
    const auto bytes = read_file(path, std::numeric_limits<std::size_t>::max());
    const auto written = bytes ? file::write_file_and_folders(fs::path(out) / path.lexically_relative(in), *bytes)
                               : tl::unexpected(bytes.error());
    if (written)
      ++copied;
    else
      failed.push_back(written.error().message());
  }
  if (code) failed.push_back(from.string() + ": " + error::reason_of(code.value()));
  return copied;
}

}  // namespace yars::tools
