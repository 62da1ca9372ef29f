// The messages of 1996, `[ name := ] keyword: value`, to a tree of their own; message_translation.hpp makes GUF of it.
// A message is the slot `keyword`, braces are the form kBraces, `name :=` is the slot kInstance before its message,
// N37@30.5 is the form lat-long, #include "f" is the form include. Limits and errors are those of parser.hpp.
#pragma once

#include "config/parser.hpp"

namespace yars::config {

inline constexpr const char* kBraces = "{";
inline constexpr const char* kInstance = ":=";

failure::Expected<ParsedText> parse_messages(std::string_view text, const std::string& name);

// Whether a text is written in messages: its first word is a directive (#), or a name before : or :=. No GUF file
// begins so, outside all parentheses stand forms alone.
bool is_in_messages(std::string_view text);

}  // namespace yars::config
