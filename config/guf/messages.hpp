// Parser of the message syntax, in which the configurations of 1996 are written, to a syntax tree.
// A message is `[ name := ] keyword: value`.
// Inputs: a text, and a name for it in errors.
// Outputs: the tree. `keyword: value` becomes a slot named `keyword`, a value in braces becomes a form named kBraces.
// `name :=` becomes a slot named kInstance before the slot that follows it. N37@30.5 becomes a form lat-long, and
// #include "f" a form include.
// Errors: limits and errors of parser.hpp.
// Use: message_translation.hpp converts this tree to a tree of GUF.
#pragma once

#include <string>
#include <string_view>

#include "config/guf/parser.hpp"

namespace yars::config {

inline constexpr const char* kBraces = "{";
inline constexpr const char* kInstance = ":=";

error::Expected<ParsedText> parse_messages(std::string_view text, const std::string& name);

// True if the text is in the message syntax: it begins with a directive (#), or with a name before : or :=. A GUF text
// begins with a form, and so with a parenthesis.
bool is_in_messages(std::string_view text);

// The form ( lat-long N 37 30.5 ) for the text "N37@30.5". Its slots, or an error, have the location `state.token`.
Form coordinate_of(std::string_view text, const ScanState& state);

// The text "name" from "name :=" or "name :".
std::string first_name(std::string_view text);

// An unnamed slot with the form ( include "FILE" ) as its value.
Slot include_slot(const Location& where, const std::string& file);

}  // namespace yars::config
