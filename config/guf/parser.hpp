// Syntax tree of a GUF text, and the parser that makes it, with limits for hostile texts. config/schema gives the forms
// a meaning. Inputs: a text of at most 1 MiB, and a name (a path) for it in errors.
// Outputs: the tree: values with their locations, and the top-level arguments; warnings for spellings of 1996;
// descriptions for errors; the tree as GUF text, which parses to an equal tree.
// Errors: FILE:LINE:COLUMN, what the grammar allows there, what was found. A text beyond a limit is an error. reject()
// throws ParseError inside config/. Public functions of config/ catch it and return Expected<T>.
// Threads: no shared state.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "lib/error/error.hpp"

namespace yars::config {

// Location of the first character of a token. Line and column count from 1. A column is one character (UTF-8); a tab
// counts as one.
struct Location {
  std::shared_ptr<const std::string> file;
  int line = 1;
  int column = 1;
};

// "FILE:LINE:COLUMN". Errors and warnings about a token begin with this text.
std::string text_of(const Location& where);

struct Identifier {
  std::string name;
};

struct Slot;
struct Value;

struct List {
  std::vector<Value> items;
};

// Form, written ( name slots ). The spelling ( guf 1 2 3 ) is a List, not a Form.
struct Form {
  std::string name;
  std::vector<Slot> slots;
};

struct Value {
  Location where;
  std::variant<double, bool, std::string, Identifier, List, Form> data;
};

// Argument of a form, with its value. It is given by name (`:red 0.5`), by position (`:1 0.5`), or by order (`0.5`).
struct Slot {
  std::string name;  // empty: not given by name; "is=": the base form in a def-form
  int position = 0;  // counted from 1; 0: not given by position
  Location where;
  Value value;
};

// Description of a value for errors: "the number 12", "the form Window", "a list of 3".
std::string description(const Value& value);

// Decimal text that reads back as the same double, without superfluous digits. Zero, and numbers with a magnitude
// in [1e-4, 1e16), have no exponent.
std::string number_text(double value);

// The text as a GUF string, with quotes and escapes.
std::string quoted_text(const std::string& text);

// What is wrong at a place of a text. fault_text() and reject() write all texts of faults.
struct Fault {
  enum class Kind : std::uint8_t { value, unknown_form, unknown_slot };
  Kind kind = Kind::value;
  Location where{};
  std::string form{};     // the unknown form, or the form that has no such slot
  std::string slot{};     // the unknown slot, or the slot of a value; empty: of none
  std::string nearest{};  // valid name that an unknown one most likely means; empty: none is near
  std::string owner{};    // form that has a slot of this name; empty: none has
  error::Error error{};   // of a value: expected, without the slot's name, found, action, limits
};

// The fault of an unknown form or slot as a warning, without its location.
std::string fault_text(const Fault& fault);

// Exception for an invalid text. Public functions of config/ catch it and return its error.
struct ParseError {
  error::Error error;
  Fault fault{};
};

// Throws a ParseError for the fault of a value. Its subject is the location.
[[noreturn]] void reject(Fault fault);
[[noreturn]] void reject(const Location& where, std::string expected, std::string found, std::string action = {});

// The tree as GUF text in the modern spelling. It parses to an equal tree. A slot takes one line if it has at most 100
// bytes, indentation not counted. A longer form or list takes several lines, indented by two spaces per open bracket.
std::string tree_text(const std::vector<Slot>& arguments);

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
