// Translator from the message syntax of 1996 to GUF, from syntax tree to syntax tree (docs/configuration.md).
// Input: the tree that parse_messages() returns (messages.hpp).
// Output: the equivalent tree of GUF forms and slots, with the source locations of the input; warnings.
// Instance name of a radar (`name := Radar: { ... }`): becomes its slot `name`, unless that slot is given.
// Other instance names: ignored, with a warning except inside unknown forms.
// Errors: throws ParseError for messages without an equivalent in GUF. Examples: a value without a keyword in the same
// braces as a message, a keyword without a colon, a form that does not fit into its enclosing form.
#pragma once

#include "config/guf/parser.hpp"

namespace yars::config {

ParsedText guf_from_messages(ParsedText messages);

}  // namespace yars::config
