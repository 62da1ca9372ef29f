// What the keywords of the messages of 1996 are called in GUF. Most have kept their names; the rest stands here.
// Source: the report's sample in section 4.3.1; the forms behind it are those of its tables 4 to 26.
#pragma once

#include <string_view>

namespace yars::config {

// The form that `keyword: { ... }` makes inside the form `owner` (empty: outside all braces): `Display` is the Window
// of the radar, and the RbmDisplay of its real beam map. Empty: the keyword names no form that GUF has.
std::string_view form_of_keyword(std::string_view keyword, std::string_view owner);

// The slot of `owner` that a keyword sets; the keyword itself where GUF has kept it.
std::string_view slot_of_keyword(std::string_view keyword, std::string_view owner);

// Some keywords of a form are slots of another form inside it: scanBars of RealBeamMode belongs to its RbmAntenna.
struct InnerForm {
  std::string_view slot;  // of the owner; empty: the keyword is its own
  std::string_view form;  // in that slot
};
InnerForm inner_form_of_keyword(std::string_view keyword, std::string_view owner);

}  // namespace yars::config
