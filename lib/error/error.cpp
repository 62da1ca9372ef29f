#include "lib/error/error.hpp"

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <system_error>
#include <utility>

#include "lib/text/plain_text.hpp"

namespace yars {

std::string Error::message() const {
  std::string text = (subject.empty() ? "" : text::shortened(subject) + ": ") + "expected " + expected + ", found " +
                     text::shortened(found);
  if (!action.empty()) text += "; " + text::shortened(action);
  return text::printable(text);
}

}  // namespace yars

namespace yars::error {

Error usage_error(Error error) {
  error.code = ErrorCode::argument;
  return error;
}

Error usage_error(std::string subject, std::string expected, std::string found, std::string action) {
  return {std::move(subject), std::move(expected), std::move(found), std::move(action), ErrorCode::argument};
}

std::string reason_of(int code, std::string_view absent) {
  return code == ENOENT ? std::string(absent) : std::generic_category().message(code);
}

void requirement_broken(std::string_view expression, std::string_view values, const char* file, int line) {
  std::fprintf(stderr, "%s:%d: requirement broken: %.*s (values: %.*s)\n", file, line,
               static_cast<int>(expression.size()), expression.data(), static_cast<int>(values.size()), values.data());
  std::abort();
}

}  // namespace yars::error
