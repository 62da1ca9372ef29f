#include "config/guf/tree.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>

#include "lib/text/plain_text.hpp"

namespace yars::config {

namespace {

struct Describer {
  std::string operator()(double number) const { return "the number " + number_text(number); }
  std::string operator()(bool flag) const { return flag ? "true" : "false"; }
  std::string operator()(const std::string& text) const { return "the string " + quoted_text(text.substr(0, 40)); }
  std::string operator()(const Identifier& identifier) const { return "the identifier " + identifier.name; }
  std::string operator()(const List& list) const { return "a list of " + std::to_string(list.items.size()); }
  std::string operator()(const Form& form) const { return "the form " + form.name; }
};

}  // namespace

std::string text_of(const Location& where) {
  const std::string file = where.file ? *where.file : std::string("text");
  return file + ":" + std::to_string(where.line) + ":" + std::to_string(where.column);
}

std::string fault_text(const Fault& fault) {
  if (fault.kind == Fault::Kind::unknown_form)
    return "the form " + fault.form + " is unknown and ignored" +
           (fault.nearest.empty() ? "" : "; nearest name: " + fault.nearest);
  std::string advice;
  if (!fault.owner.empty()) {
    advice = "; the form " + fault.owner + " has it";
  } else if (!fault.nearest.empty()) {
    advice = "; nearest name: :" + fault.nearest;
  }
  return "the form " + fault.form + " has no slot :" + fault.slot + "; the slot is ignored" + advice;
}

void reject(Fault fault) {
  error::Error error = fault.error;
  error.subject = text_of(fault.where);
  if (!fault.slot.empty()) error.expected += " for :" + fault.slot;
  throw ParseError{std::move(error), std::move(fault)};
}

void reject(const Location& where, std::string expected, std::string found, std::string action) {
  reject({.where = where, .error = {{}, std::move(expected), std::move(found), std::move(action)}});
}

std::string description(const Value& value) {
  return std::visit(Describer{}, value.data);
}

std::string number_text(double value) {
  const double magnitude = std::abs(value);
  const bool fixed = magnitude == 0.0 || (magnitude >= 1e-4 && magnitude < 1e16);  // 100000 instead of 1e+05
  std::array<char, 32> digits{};
  char* const begin = digits.data();
  const auto end = fixed ? std::to_chars(begin, begin + digits.size(), value, std::chars_format::fixed)
                         : std::to_chars(begin, begin + digits.size(), value);
  return {begin, end.ptr};
}

std::string quoted_text(const std::string& text) {
  std::string quoted = "\"";
  for (const char letter : text) {
    if (letter == '"' || letter == '\\') quoted += '\\';
    quoted += letter;
  }
  return text::printable(quoted) + "\"";
}

namespace {

constexpr std::size_t kLineLength = 100;  // [bytes] a longer slot is split at its brackets

std::string atom_text(const Value& value) {
  if (const auto* number = std::get_if<double>(&value.data)) return number_text(*number);
  if (const auto* flag = std::get_if<bool>(&value.data)) return *flag ? "true" : "false";
  if (const auto* text = std::get_if<std::string>(&value.data)) return quoted_text(*text);
  return std::get<Identifier>(value.data).name;
}

// The text before the value of a slot: its name, its position, or nothing.
std::string label(const Slot& slot) {
  if (slot.name == "is=") return "is= ";
  if (!slot.name.empty()) return ":" + slot.name + " ";
  return slot.position == 0 ? std::string() : std::string(":").append(std::to_string(slot.position)) + " ";
}

// Writes a slot on one line. nullopt: the text exceeds kLineLength.
class LineWriter {
 public:
  std::optional<std::string> line_of(const Slot& slot) {
    add(slot);
    return full() ? std::nullopt : std::optional(std::move(text_));
  }

 private:
  bool full() const { return text_.size() > kLineLength; }

  void add(const Slot& slot) {
    text_ += label(slot);
    add(slot.value);
  }

  void add(const Value& value) {
    if (const auto* form = std::get_if<Form>(&value.data)) {
      text_ += "( " + form->name + " ";
      for (const Slot& slot : form->slots) {
        if (full()) return;
        add(slot);
        text_ += " ";
      }
      text_ += ")";
    } else if (const auto* list = std::get_if<List>(&value.data)) {
      text_ += "`( ";
      for (const Value& item : list->items) {
        if (full()) return;
        add(item);
        text_ += " ";
      }
      text_ += ")";
    } else {
      text_ += atom_text(value);
    }
  }

  std::string text_;
};

// Writes slots. A slot takes one line if it fits, else several lines.
class TreeWriter {
 public:
  std::string text_of(const std::vector<Slot>& arguments) {
    for (const Slot& argument : arguments) write(argument, 0);
    return std::move(text_);
  }

 private:
  void line(std::size_t depth, const std::string& text) { text_ += std::string(depth * 2, ' ') + text + "\n"; }

  void write(const Slot& slot, std::size_t depth) {
    const auto* form = std::get_if<Form>(&slot.value.data);
    const auto* list = std::get_if<List>(&slot.value.data);
    const auto single_line = LineWriter().line_of(slot);
    if (single_line || (form == nullptr && list == nullptr)) {
      line(depth, single_line ? *single_line : label(slot) + atom_text(slot.value));
      return;
    }
    line(depth, label(slot) + (form != nullptr ? "( " + form->name : "`("));
    if (form != nullptr) {
      for (const Slot& inner : form->slots) write(inner, depth + 1);
    } else {
      for (const Value& item : list->items) write({"", 0, item.where, item}, depth + 1);
    }
    line(depth, ")");
  }

  std::string text_;
};

}  // namespace

std::string tree_text(const std::vector<Slot>& arguments) {
  return TreeWriter().text_of(arguments);
}

}  // namespace yars::config
