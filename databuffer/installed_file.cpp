#include "databuffer/installed_file.hpp"

#include <system_error>

namespace yars::databuffer {

namespace fs = std::filesystem;

std::string installed_file(const std::string& name, const fs::path& programs) {
  std::error_code problem;
  // A name with a folder says where to look.
  if (name.empty() || name.find('/') != std::string::npos || fs::exists(name, problem)) return name;
  const fs::path installed = programs.parent_path() / "share/yars/config";
  for (const char* folder : {"", "routes", "scripts"})
    if (const fs::path file = installed / folder / name; fs::is_regular_file(file, problem)) return file.string();
  return name;
}

std::string installed_file(const std::string& name) {
  std::error_code problem;
  const fs::path program = fs::read_symlink("/proc/self/exe", problem);
  return problem ? name : installed_file(name, program.parent_path());
}

}  // namespace yars::databuffer
