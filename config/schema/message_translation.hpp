// The tree of messages (messages.hpp) as the tree of GUF that says the same; every part keeps its place in the
// text. The name of an instance becomes the radar's `name`; other instances' names change nothing and are warned of.
// Errors, thrown as ParseError: messages and values mixed in one pair of braces, a form where it cannot belong, values
// for a form.
#pragma once

#include "config/guf/parser.hpp"

namespace yars::config {

ParsedText guf_from_messages(ParsedText messages);

}  // namespace yars::config
