#include "config/tree_text.hpp"

#include <optional>

namespace yars::config {
namespace {

constexpr std::size_t kLineLength = 100;  // [characters] what is longer is broken at its brackets

std::string atom_text(const Value& value) {
  if (const auto* number = std::get_if<double>(&value.data)) return number_text(*number);
  if (const auto* flag = std::get_if<bool>(&value.data)) return *flag ? "true" : "false";
  if (const auto* text = std::get_if<std::string>(&value.data)) return quoted_text(*text);
  return std::get<Identifier>(value.data).name;
}

// What stands before the value of a slot.
std::string label(const Slot& slot) {
  if (slot.name == "is=") return "is= ";
  if (!slot.name.empty()) return ":" + slot.name + " ";
  return slot.position == 0 ? std::string() : std::string(":").append(std::to_string(slot.position)) + " ";
}

// Writes a value on one line; gives up where the line would become too long.
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
    const auto whole = LineWriter().line_of(slot);
    if (whole || (form == nullptr && list == nullptr)) {
      line(depth, whole ? *whole : label(slot) + atom_text(slot.value));
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
