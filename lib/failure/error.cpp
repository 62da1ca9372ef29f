#include "lib/failure/error.hpp"

#include "lib/failure/printable.hpp"

namespace yars::failure {

std::string Error::message() const {
  std::string text = subject + ": expected " + expected + ", found " + found;
  if (!action.empty()) text += "; " + action;
  return printable(text);
}

}  // namespace yars::failure
