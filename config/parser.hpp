// GUF text to its tree. Includes are still forms named `include`; read_tree.hpp replaces them.
// Errors: file:line:column, what the grammar allows there, what was found. Never reads beyond its limits.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "config/value.hpp"
#include "lib/failure/error.hpp"

namespace yars::config {

// Bounds of a text: a file of a person's is far below each, a hostile one cannot take the process down with it.
inline constexpr std::size_t kMaxTextBytes = 1 << 20;
inline constexpr int kMaxTokens = 200'000;        // of one text; a token costs some 200 bytes of tree
inline constexpr int kMaxDepth = 64;              // parentheses within parentheses
inline constexpr std::size_t kMaxWarnings = 200;  // of one configuration; more help nobody

struct ParsedText {
  std::vector<Slot> arguments;        // what stands outside all parentheses, in order
  int tokens = 0;                     // words read, comments apart
  std::vector<std::string> warnings;  // old spellings, each with its place and the modern one
};

// `name` stands for the text in messages: a path.
failure::Expected<ParsedText> parse_text(std::string_view text, const std::string& name);

}  // namespace yars::config
