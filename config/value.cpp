#include "config/value.hpp"

#include <array>
#include <charconv>
#include <cmath>

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

std::string description(const Value& value) {
  return std::visit(Describer{}, value.data);
}

std::string number_text(double value) {
  const double size = std::abs(value);
  const bool plain = size == 0.0 || (size >= 1e-4 && size < 1e16);  // 100000 instead of 1e+05
  std::array<char, 32> digits{};
  char* const begin = digits.data();
  const auto end = plain ? std::to_chars(begin, begin + digits.size(), value, std::chars_format::fixed)
                         : std::to_chars(begin, begin + digits.size(), value);
  return {begin, end.ptr};
}

std::string quoted_text(const std::string& text) {
  std::string quoted = "\"";
  for (const char letter : text) {
    if (letter == '\n') {
      quoted += "\\n";
    } else if (letter == '\t') {
      quoted += "\\t";
    } else {
      if (letter == '"' || letter == '\\') quoted += '\\';
      quoted += letter;
    }
  }
  return quoted + "\"";
}

}  // namespace yars::config
