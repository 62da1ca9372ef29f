// Parser of the message syntax, the first configuration language of the 1996 report: text to syntax tree.
// A text is a sequence of messages `[ name := ] keyword: value`.
// Inputs: a text, and a name for it in errors.
// Outputs: the tree. `keyword: value` becomes a slot named `keyword`. A value in braces becomes a form named kBraces.
// `name :=` becomes a slot named kInstance, before the slot of its message. N37@30.5 (37 deg 30.5 min north) becomes a
// form named lat-long. #include "f" becomes a form named include.
// Errors: as in parser.hpp, with the same limits.
// Use: message_translation.hpp converts this tree to a tree of GUF.
#pragma once

#include <string>
#include <string_view>

#include "config/guf/parser.hpp"

namespace yars::config {

inline constexpr const char* kBraces = "{";
inline constexpr const char* kInstance = ":=";

error::Expected<ParsedText> parse_messages(std::string_view text, const std::string& name);

// True if the text is in the message syntax. Only its beginning, after white space and comments, is examined. A text in
// the message syntax begins with #, or with a name before : or :=. Any other text counts as GUF.
bool is_in_messages(std::string_view text);

// The form ( lat-long N 37 30.5 ) for the text "N37@30.5". The form's slots have the location `state.token`. Throws
// ParseError with this location for an invalid number.
Form coordinate_of(std::string_view text, const ScanState& state);

// The name in the token "name :=" or "name :".
std::string first_name(std::string_view text);

// An unnamed slot with the form ( include "FILE" ) as its value.
Slot include_slot(const Location& where, const std::string& file);

}  // namespace yars::config
