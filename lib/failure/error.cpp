#include "lib/failure/error.hpp"

namespace yars::failure {

std::string Error::message() const {
  std::string text = subject + ": expected " + expected + ", found " + found;
  if (!action.empty()) text += "; " + action;
  return text;
}

}  // namespace yars::failure
