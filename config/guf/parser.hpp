// Parser of GUF: text to syntax tree, with limits for hostile texts.
// Inputs: a text of at most 1 MiB, and a name (a path) for it in errors.
// Outputs: the top-level arguments (Slot in tree.hpp); warnings for spellings of 1996.
// Errors: FILE:LINE:COLUMN, what the grammar allows there, what was found. A text beyond a limit is an error.
// Threads: no shared state.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/guf/tree.hpp"
#include "lib/error/error.hpp"

namespace yars::config {

// Limits that bound memory and stack for a hostile text. Files that people write are far below them.
inline constexpr std::size_t kMaxTextBytes = 1 << 20;  // [bytes] one file
inline constexpr int kMaxTokens =
    200'000;                          // tokens of one text with its includes; a token takes about 200 bytes of tree
inline constexpr int kMaxDepth = 64;  // nested brackets
// Maximum number of the parser's warnings about one file. config/schema appends its warnings to those of all files, but
// only while the list has fewer than kMaxWarnings.
inline constexpr std::size_t kMaxWarnings = 200;

struct ParsedText {
  std::vector<Slot> arguments;        // top-level arguments: those outside all parentheses, in order
  int tokens = 0;                     // number of tokens, without comments
  std::vector<std::string> warnings;  // old spellings, each with its location and the modern spelling
};

// The tree of a GUF text. Includes remain forms named `include`; load.cpp replaces them.
error::Expected<ParsedText> parse_text(std::string_view text, const std::string& name);
ParsedText parse(std::string_view text, const std::string& name);  // throws ParseError

// State that scanner and parser of one text share.
struct ScanState {
  Location next;            // location of the next character
  Location token;           // location of the newest token
  std::string spelled;      // text of the newest token, shortened, for errors
  int depth = 0;            // open brackets
  bool comma_seen = false;  // only the first comma of a text causes a warning
  ParsedText result;

  // Makes `text` the newest token; counts lines and characters.
  void advance(std::string_view text);
  void open_bracket();  // throws ParseError beyond kMaxDepth
  void close_bracket();
  void warn_comma(const Location& where);
  void warn_old_spelling(const Location& where, const std::string& old_form, const std::string& modern);
};

// Error if the text exceeds kMaxTextBytes, else nullopt.
std::optional<error::Error> oversize(std::string_view text, const std::string& name);
// The text without the byte order mark (UTF-8) at its beginning.
std::string_view without_byte_order_mark(std::string_view text);
// Counts one token; throws ParseError beyond kMaxTokens.
void count_token(ScanState& state);

// Value of a token, from the text of the token. Throws ParseError with `state.token` as the location.
double number_of(std::string_view text, const ScanState& state);
int position_of(std::string_view text, const ScanState& state);        // `text`: such as ":12"
std::string string_of(std::string_view text, const ScanState& state);  // `text`: with its quotes and escapes

// The text for errors: its first 40 bytes, and "..." in place of more. A byte outside printable ASCII becomes its code,
// such as <0x07>.
std::string printable(std::string_view text);

// The value of ( name arguments ): a form, or a list for the name `guf`.
Value form_value(const Location& where, const std::string& name, std::vector<Slot> arguments);
// The list of the arguments. Throws ParseError for a named argument, or a position out of order.
Value list_value(const Location& where, std::vector<Slot> arguments);
// Warns about a list in braces, such as `{ 100, 50 }`, and shows its modern spelling.
void warn_braces(ScanState& state, const Value& list);

}  // namespace yars::config
