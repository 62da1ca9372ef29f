// A condition that must hold in every build. A broken one ends the process and prints both values.
// assert() is for our own bugs in debug builds; Expected<T> is for the world outside.
#pragma once

#include <sstream>
#include <string>
#include <string_view>

namespace yars::failure {

[[noreturn]] void requirement_broken(std::string_view expression, std::string_view values, const char* file, int line);

template <class Left, class Right>
std::string both_values(const Left& left, const Right& right) {
  std::ostringstream text;
  text << left << " and " << right;
  return text.str();
}

}  // namespace yars::failure

// YARS_REQUIRE(left, op, right): aborts with both values unless `left op right`.
#define YARS_REQUIRE(left, op, right)                                                                          \
  do {                                                                                                         \
    if (!((left)op(right)))                                                                                    \
      ::yars::failure::requirement_broken(#left " " #op " " #right, ::yars::failure::both_values(left, right), \
                                          __FILE__, __LINE__);                                                 \
  } while (false)
