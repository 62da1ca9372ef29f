// The messages of 1996 to a tree of their own.
#pragma once

#include <string>
#include <string_view>

#include "config/guf/parser.hpp"

namespace yars::config {

// The messages of 1996, `[ name := ] keyword: value`, to a tree of their own; message_translation.hpp makes GUF of it.
// A message is the slot `keyword`, braces are the form kBraces, `name :=` is the slot kInstance before its message,
// N37@30.5 is the form lat-long, #include "f" is the form include. Limits and errors are those of parser.hpp.
inline constexpr const char* kBraces = "{";
inline constexpr const char* kInstance = ":=";

error::Expected<ParsedText> parse_messages(std::string_view text, const std::string& name);

// Whether a text is written in messages: its first word is a directive (#), or a name before : or :=. No GUF file
// begins so, outside all parentheses stand forms alone.
bool is_in_messages(std::string_view text);

// What scanner and grammar of the messages of 1996 need beyond parser.hpp.

// "N37@30.5" to ( lat-long N 37 30.5 ); `state.token` is the place of its parts and of a violation.
Form coordinate_of(std::string_view text, const ScanState& state);

// "name :=" to "name".
std::string first_name(std::string_view text);

Slot include_slot(const Location& where, const std::string& file);

}  // namespace yars::config
