// Translator of the message syntax of 1996: its tree (messages.hpp) to the equivalent tree of GUF.
// Inputs: the tree of messages.
// Outputs: the tree of GUF, with the locations of the original; warnings. The instance name of a radar becomes its slot
// `name`. Other instance names are ignored, with a warning except inside unknown forms.
// Errors: ParseError for messages mixed with values in one pair of braces, for a form that its owner does not accept,
// and for values instead of a form.
#pragma once

#include "config/guf/parser.hpp"

namespace yars::config {

ParsedText guf_from_messages(ParsedText messages);

}  // namespace yars::config
