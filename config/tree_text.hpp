// A tree as GUF text in the modern spelling: what fits stands on one line, everything else on lines of its own,
// indented by two spaces a bracket. Reads back as an equal tree; comments are no part of a tree.
#pragma once

#include <string>
#include <vector>

#include "config/value.hpp"

namespace yars::config {

std::string tree_text(const std::vector<Slot>& arguments);

}  // namespace yars::config
