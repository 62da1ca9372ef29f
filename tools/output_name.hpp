// What names of outputs have to look like. Each throws CommandFailed (bad usage) and says what is expected.
#pragma once

#include <string>
#include <vector>

namespace yars::tools {

// A file whose name ends in one of `endings` (".png"); an empty name is no file.
void check_file_name(const std::string& option, const std::string& name, const std::vector<std::string>& endings);

// A folder: no name that ends like one of the files that YARS writes or reads.
void check_folder_name(const std::string& option, const std::string& name);

}  // namespace yars::tools
