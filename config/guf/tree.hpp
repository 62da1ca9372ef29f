// Syntax tree of a GUF text: values with their locations. config/schema gives the forms a meaning.
// Inputs: values that the parser makes.
// Outputs: descriptions for errors; the tree as GUF text, which parses to an equal tree.
// Errors: reject() throws ParseError inside config/. Public functions of config/ catch it and return Expected<T>.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
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

}  // namespace yars::config
