// GUF text to its tree: limits, what scanner and grammar share, the parser.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/guf/tree.hpp"
#include "lib/error/error.hpp"

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

// GUF text to its tree. Includes are still forms named `include`; load.cpp replaces them. `name` stands for the text in
// messages: a path. Errors: file:line:column, what the grammar allows there, what was found. Never reads beyond the
// limits above.
error::Expected<ParsedText> parse_text(std::string_view text, const std::string& name);

// What scanner and parser share while one text is read: the place, the limits, the result.
struct ScanState {
  Location next;        // where the next character stands
  Location token;       // where the newest token begins
  std::string spelled;  // the newest token's text, shortened, for messages
  int depth = 0;
  bool comma_seen = false;  // one warning a file is enough for commas
  ParsedText result;

  // Takes `text` as the newest token; counts lines and characters.
  void advance(std::string_view text);
  void open_bracket();
  void close_bracket();
  void warn_comma(const Location& where);
  void warn_old_spelling(const Location& where, const std::string& old_form, const std::string& modern);
};

// What is wrong with the size of a text, if anything.
std::optional<error::Error> oversize(std::string_view text, const std::string& name);
// A text behind its byte order mark.
std::string_view without_mark(std::string_view text);
// One word more of the text; throws beyond kMaxTokens.
void count_token(ScanState& state);

// Text of a token to its value; `state.token` is the place of a violation.
double number_of(std::string_view text, const ScanState& state);
int position_of(std::string_view text, const ScanState& state);        // ":12"
std::string string_of(std::string_view text, const ScanState& state);  // with quotes and escapes

// A control or non-ASCII character as <0x07>, a long text shortened.
std::string printable(std::string_view text);

// The value of ( name arguments ): a list for `guf`.
Value form_value(const Location& where, const std::string& name, std::vector<Slot> arguments);
Value list_value(const Location& where, std::vector<Slot> arguments);
// `{ 100, 50 }` and commas are read; the warning shows the list as it is written today.
void warn_braces(ScanState& state, const Value& list);

}  // namespace yars::config
