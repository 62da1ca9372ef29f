#include "lib/error/error.hpp"

#include <cstdio>
#include <cstdlib>

#include "lib/text/plain_text.hpp"

namespace yars::failure {

std::string Error::message() const {
  std::string text = subject + ": expected " + expected + ", found " + found;
  if (!action.empty()) text += "; " + action;
  return printable(text);
}

void requirement_broken(std::string_view expression, std::string_view values, const char* file, int line) {
  std::fprintf(stderr, "%s:%d: requirement broken: %.*s (values: %.*s)\n", file, line,
               static_cast<int>(expression.size()), expression.data(), static_cast<int>(values.size()), values.data());
  std::abort();
}

}  // namespace yars::failure
