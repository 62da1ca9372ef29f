#include "model/terrain/link_target.hpp"

#include <algorithm>
#include <system_error>

namespace yars::model::terrain {

bool leads_out(const std::filesystem::path& path, const std::filesystem::path& root) {
  std::error_code code;
  if (!std::filesystem::is_symlink(path, code)) return false;
  const std::filesystem::path target = std::filesystem::weakly_canonical(path, code);
  return code || std::mismatch(root.begin(), root.end(), target.begin(), target.end()).first != root.end();
}

}  // namespace yars::model::terrain
