// A file and what it includes, as one tree of GUF. `( include "part.guf" )` stands for what is in that file: several
// arguments where it is an argument by position, one value where it is the value of a slot. The path is relative to
// the including file and stays inside the folder of the first file. A first file in the messages of 1996 is translated,
// and `#include "part"` in it, under the same rules, takes messages. Errors: file, cycle, depth, count, outside.
#pragma once

#include <filesystem>

#include "config/parser.hpp"

namespace yars::config {

inline constexpr int kMaxIncludeDepth = 8;
inline constexpr int kMaxIncludes = 64;  // files of one configuration, repetitions counted

failure::Expected<ParsedText> read_tree(const std::filesystem::path& path);

// The same of a text in memory; includes are left as they stand in GUF, and refused in messages.
failure::Expected<ParsedText> tree_of_text(std::string_view text, const std::string& name);

}  // namespace yars::config
