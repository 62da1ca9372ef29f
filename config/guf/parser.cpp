#include "config/guf/parser.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <new>
#include <optional>
#include <utility>

#include "guf_lexer.hpp"
#include "guf_parser.hpp"
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

namespace {

// Owner of the flex scanner and its copy of the text.
class GufScanner {
 public:
  GufScanner(std::string_view text, ScanState& state) {
    if (guf_lex_init_extra(&state, &handle_) != 0) throw std::bad_alloc();
    guf__scan_bytes(text.data(), static_cast<int>(text.size()), handle_);
  }
  ~GufScanner() { guf_lex_destroy(handle_); }
  GufScanner(const GufScanner&) = delete;
  GufScanner& operator=(const GufScanner&) = delete;
  void* handle() const { return handle_; }

 private:
  yyscan_t handle_ = nullptr;
};

}  // namespace

ParsedText parse(std::string_view text, const std::string& name) {
  if (const auto problem = oversize(text, name)) throw ParseError{*problem};
  ScanState state;
  state.next.file = std::make_shared<const std::string>(name);
  const GufScanner scanner(without_byte_order_mark(text), state);
  GufParser parser(scanner.handle(), state);
  parser.parse();
  return std::move(state.result);
}

error::Expected<ParsedText> parse_text(std::string_view text, const std::string& name) {
  try {
    return parse(text, name);
  } catch (const ParseError& parse_error) {
    return tl::unexpected(parse_error.error);
  }
}

namespace {

// UTF-8: the first byte of a character is not of the form 10xxxxxx; all other bytes are.
bool begins_character(char byte) {
  return (static_cast<unsigned char>(byte) & 0xC0U) != 0x80U;
}

std::string value_text(const Value& value) {
  if (const auto* number = std::get_if<double>(&value.data)) return number_text(*number);
  if (const auto* text = std::get_if<std::string>(&value.data)) return quoted_text(*text);
  return "...";
}

}  // namespace

void ScanState::advance(std::string_view text) {
  token = next;
  spelled = printable(text);
  for (const char byte : text) {
    if (byte == '\n') {
      ++next.line;
      next.column = 1;
    } else if (begins_character(byte)) {
      ++next.column;
    }
  }
}

void ScanState::open_bracket() {
  if (++depth > kMaxDepth) {
    reject(token, "at most " + std::to_string(kMaxDepth) + " brackets open at once", "one more",
           "close a form before this one");
  }
}

void ScanState::close_bracket() {
  --depth;
}

void ScanState::warn_comma(const Location& where) {
  if (!std::exchange(comma_seen, true)) warn_old_spelling(where, "a comma", "a space");
}

void ScanState::warn_old_spelling(const Location& where, const std::string& old_form, const std::string& modern) {
  if (result.warnings.size() >= kMaxWarnings) return;
  result.warnings.push_back(text_of(where) + ": " + old_form + " is the spelling of 1996; write " + modern);
}

std::optional<error::Error> oversize(std::string_view text, const std::string& name) {
  if (text.size() <= kMaxTextBytes) return std::nullopt;
  return error::fail(name, "at most " + std::to_string(kMaxTextBytes) + " bytes in a file", std::to_string(text.size()),
                     "split the file")
      .value();
}

std::string_view without_byte_order_mark(std::string_view text) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  return text.starts_with(kByteOrderMark) ? text.substr(kByteOrderMark.size()) : text;
}

void count_token(ScanState& state) {
  if (++state.result.tokens > kMaxTokens) {
    reject(state.next, "at most " + std::to_string(kMaxTokens) + " words in a file", "more", "split the file");
  }
}

double number_of(std::string_view text, const ScanState& state) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0.0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (problem != std::errc{}) {
    reject(state.token, "a number between 2.3e-308 and 1.7e308 in magnitude, or 0", state.spelled);
  }
  return value;
}

int position_of(std::string_view text, const ScanState& state) {
  int position = 0;
  const auto [end, problem] = std::from_chars(text.data() + 1, text.data() + text.size(), position);
  if (problem != std::errc{} || position < 1) {
    reject(state.token, "a slot position of 1 or more", state.spelled);
  }
  return position;
}

std::string string_of(std::string_view text, const ScanState& state) {
  std::string value;
  value.reserve(text.size());
  for (std::size_t i = 1; i + 1 < text.size(); ++i) {
    if (text[i] != '\\') {
      value += text[i];
      continue;
    }
    const char escaped = text[++i];
    if (escaped == 'n') {
      value += '\n';
    } else if (escaped == 't') {
      value += '\t';
    } else if (escaped == '"' || escaped == '\\') {
      value += escaped;
    } else if (const auto byte =
                   escaped == 'x' ? text::whole_number<std::uint8_t>(text.substr(i + 1, 2), 16) : std::nullopt;
               byte && i + 3 < text.size()) {
      value += static_cast<char>(*byte);
      i += 2;
    } else {
      reject(state.token, R"(one of \" \\ \n \t \xHH after a backslash)",
             std::string("\\").append(printable({&escaped, 1})));
    }
  }
  return value;
}

std::string printable(std::string_view text) {
  constexpr std::size_t kMaxShown = 40;  // [bytes] enough to recognize a token, short enough for one line
  static constexpr char kHex[] = "0123456789ABCDEF";
  std::string shown;
  for (const char letter : text.substr(0, kMaxShown)) {
    const auto byte = static_cast<unsigned char>(letter);
    if (byte >= 0x20 && byte < 0x7F) {
      shown += letter;
    } else {
      shown += std::string("<0x") + kHex[byte >> 4U] + kHex[byte & 0xFU] + ">";
    }
  }
  return text.size() > kMaxShown ? shown + "..." : shown;
}

Value list_value(const Location& where, std::vector<Slot> arguments) {
  List list;
  list.items.reserve(arguments.size());
  for (Slot& argument : arguments) {
    const int position = static_cast<int>(list.items.size()) + 1;
    if (!argument.name.empty()) {
      reject(argument.where, "values by position in a list", "the slot :" + argument.name);
    }
    if (argument.position != 0 && argument.position != position) {
      reject(argument.where, "position :" + std::to_string(position) + " here in the list",
             std::string(":").append(std::to_string(argument.position)));
    }
    list.items.push_back(std::move(argument.value));
  }
  return {where, std::move(list)};
}

Value form_value(const Location& where, const std::string& name, std::vector<Slot> arguments) {
  if (name == "guf") return list_value(where, std::move(arguments));
  return {where, Form{name, std::move(arguments)}};
}

void warn_braces(ScanState& state, const Value& list) {
  constexpr std::size_t kShown = 8;  // maximum number of items in the warning; an ellipsis replaces further ones
  std::string items;
  const auto& values = std::get<List>(list.data).items;
  for (std::size_t i = 0; i < values.size() && i < kShown; ++i) items += value_text(values[i]) + " ";
  if (values.size() > kShown) items += "... ";
  state.warn_old_spelling(list.where, "{ }", "`( " + items + ")");
}

}  // namespace yars::config
