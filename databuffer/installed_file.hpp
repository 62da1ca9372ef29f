// Files that are installed beside the programs: configurations, routes, scripts. They are found from where the program
// lies (PREFIX/bin), so that an installation may be moved.
#pragma once

#include <filesystem>
#include <string>

namespace yars::databuffer {

// A bare name that is no file here and stands in PREFIX/share/yars/config or its folders is that file; anything else
// stays as it is.
std::string installed_file(const std::string& name, const std::filesystem::path& programs);

// The same for this program.
std::string installed_file(const std::string& name);

}  // namespace yars::databuffer
