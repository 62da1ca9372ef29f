#include "config/guf/parser.hpp"

#include <charconv>
#include <cstdint>
#include <new>
#include <utility>

#include "guf_lexer.hpp"
#include "guf_parser.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::config {

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
