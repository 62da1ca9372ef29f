#include "config/parser.hpp"

#include <new>

#include "config/scan_state.hpp"
#include "guf_lexer.hpp"
#include "guf_parser.hpp"

namespace yars::config {
namespace {

// Owns the scanner and its copy of the text.
class Scanner {
 public:
  Scanner(std::string_view text, ScanState& state) {
    if (guf_lex_init_extra(&state, &handle_) != 0) throw std::bad_alloc();
    guf__scan_bytes(text.data(), static_cast<int>(text.size()), handle_);
  }
  ~Scanner() { guf_lex_destroy(handle_); }
  Scanner(const Scanner&) = delete;
  Scanner& operator=(const Scanner&) = delete;
  void* handle() const { return handle_; }

 private:
  yyscan_t handle_ = nullptr;
};

}  // namespace

failure::Expected<ParsedText> parse_text(std::string_view text, const std::string& name) {
  if (const auto problem = oversize(text, name)) return tl::unexpected(*problem);
  ScanState state;
  state.next.file = std::make_shared<const std::string>(name);
  try {
    const Scanner scanner(without_mark(text), state);
    GufParser parser(scanner.handle(), state);
    parser.parse();
  } catch (const Rejection& rejection) {
    return tl::unexpected(rejection.error);
  }
  return std::move(state.result);
}

}  // namespace yars::config
