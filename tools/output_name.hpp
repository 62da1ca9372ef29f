// Whether outputs can be written where they are named, found out before the work begins.
// Each throws CommandFailed and says what is expected.
#pragma once

#include <string>
#include <vector>

namespace yars::tools {

// ".png", of whatever case.
std::string ending_of(const std::string& name);

// A file whose name ends in one of `endings` (".png"), in a folder that is there and may be written to; an empty name
// is no file.
void check_file_name(const std::string& option, const std::string& name, const std::vector<std::string>& endings);

// A folder: no name that ends like one of the files that YARS writes or reads.
void check_folder_name(const std::string& option, const std::string& name);

}  // namespace yars::tools
