// Tree of a GUF text: values with their places, rejection of a wrong one, the tree as text again.
#pragma once

#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "lib/error/error.hpp"

namespace yars::config {

// The tree that a GUF text stands for: values, each with the place it was written at. No meaning yet: schema.hpp
// says what a form is for.

// Where a token begins. Line and column count from 1; a column is one character (UTF-8), a tab counts as one.
struct Location {
  std::shared_ptr<const std::string> file;
  int line = 1;
  int column = 1;
};

// "file:line:column", the subject of every message.
std::string text_of(const Location& where);

struct Identifier {
  std::string name;
};

struct Slot;
struct Value;

struct List {
  std::vector<Value> items;
};

// ( name slots ). Lists of the spelling ( guf 1 2 3 ) are List, not Form.
struct Form {
  std::string name;
  std::vector<Slot> slots;
};

struct Value {
  Location where;
  std::variant<double, bool, std::string, Identifier, List, Form> data;
};

// One argument: by name (`:red 0.5`); else the name is empty, and `:1 0.5` gives a position from 1, a bare `0.5` the
// one of its place among the arguments (0 here).
struct Slot {
  std::string name;
  int position = 0;
  Location where;
  Value value;
};

// What a value is, for messages: "the number 12", "the form Window", "a list of 3".
std::string description(const Value& value);

// The shortest decimal that reads back as the same double.
std::string number_text(double value);

// A GUF string with its quotes and escapes.
std::string quoted_text(const std::string& text);

// How the parts of config/ leave a text that is wrong: thrown inside, caught where a public function returns Expected.
struct ParseError {
  error::Error error;
};

[[noreturn]] inline void reject(const Location& where, std::string expected, std::string found,
                                std::string action = {}) {
  throw ParseError{error::fail(text_of(where), std::move(expected), std::move(found), std::move(action)).value()};
}

// A tree as GUF text in the modern spelling: what fits stands on one line, everything else on lines of its own,
// indented by two spaces a bracket. Reads back as an equal tree; comments are no part of a tree.
std::string tree_text(const std::vector<Slot>& arguments);

}  // namespace yars::config
