#include "config/guf/messages.hpp"

#include <cctype>
#include <new>

#include "message_lexer.hpp"
#include "message_parser.hpp"

namespace yars::config {

namespace {

constexpr std::string_view kBlank = " \t";
constexpr std::string_view kSpace = " \t\r\n\f";

// Owner of the flex scanner and its copy of the text.
class MessageScanner {
 public:
  MessageScanner(std::string_view text, ScanState& state) {
    if (message_lex_init_extra(&state, &handle_) != 0) throw std::bad_alloc();
    message__scan_bytes(text.data(), static_cast<int>(text.size()), handle_);
  }
  ~MessageScanner() { message_lex_destroy(handle_); }
  MessageScanner(const MessageScanner&) = delete;
  MessageScanner& operator=(const MessageScanner&) = delete;
  void* handle() const { return handle_; }

 private:
  yyscan_t handle_ = nullptr;
};

// The text after the first occurrence of `end`; empty if `end` does not occur.
std::string_view text_after(std::string_view text, std::string_view end) {
  const std::size_t position = text.find(end);
  return position == std::string_view::npos ? std::string_view() : text.substr(position + end.size());
}

// The text without the white space and comments at its beginning. Comments of GUF and of messages are skipped, because
// the syntax of the text is not known yet.
std::string_view from_first_word(std::string_view text) {
  while (!text.empty()) {
    if (kSpace.find(text.front()) != std::string_view::npos) {
      text.remove_prefix(1);
    } else if (text.front() == ';' || text.starts_with("//")) {
      text = text_after(text, "\n");
    } else if (text.starts_with("/*")) {
      text = text_after(text.substr(2), "*/");
    } else {
      break;
    }
  }
  return text;
}

bool is_in_name(char letter) {
  return std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '_' || letter == '.' || letter == '-';
}

}  // namespace

error::Expected<ParsedText> parse_messages(std::string_view text, const std::string& name) {
  if (const auto problem = oversize(text, name)) return tl::unexpected(*problem);
  ScanState state;
  state.next.file = std::make_shared<const std::string>(name);
  try {
    const MessageScanner scanner(without_byte_order_mark(text), state);
    MessageParser parser(scanner.handle(), state);
    parser.parse();
  } catch (const ParseError& parse_error) {
    return tl::unexpected(parse_error.error);
  }
  return std::move(state.result);
}

bool is_in_messages(std::string_view text) {
  text = from_first_word(without_byte_order_mark(text));
  if (text.starts_with('#')) return true;
  if (text.empty() || std::isdigit(static_cast<unsigned char>(text.front())) != 0) return false;
  std::size_t length = 0;
  while (length < text.size() && is_in_name(text[length])) ++length;
  if (length == 0) return false;
  const std::size_t next = text.find_first_not_of(kBlank, length);
  return next != std::string_view::npos && text[next] == ':';
}

Form coordinate_of(std::string_view text, const ScanState& state) {
  const std::size_t at = text.find('@');
  const auto part = [&](auto value) { return Slot{"", 0, state.token, Value{state.token, value}}; };
  return {"lat-long",
          {part(Identifier{std::string(text.substr(0, 1))}), part(number_of(text.substr(1, at - 1), state)),
           part(number_of(text.substr(at + 1), state))}};
}

std::string first_name(std::string_view text) {
  return std::string(text.substr(0, text.find_first_of(" \t:")));
}

Slot include_slot(const Location& where, const std::string& file) {
  return {"", 0, where, Value{where, Form{"include", {Slot{"", 0, where, Value{where, file}}}}}};
}

}  // namespace yars::config
