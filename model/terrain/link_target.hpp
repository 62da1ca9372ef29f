// Whether a link leads out of a folder that a user has named: what is read from a folder lies in it.
#pragma once

#include <filesystem>

namespace yars::model::terrain {

// `root` is canonical. A link to nowhere counts by where it points; what is no link never leads out.
bool leads_out(const std::filesystem::path& path, const std::filesystem::path& root);

}  // namespace yars::model::terrain
