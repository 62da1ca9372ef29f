// Errors as values (`Expected<T>`) and conditions that are checked in every build (`YARS_REQUIRE`).
// Inputs: subject, what was expected, what was found, what the user can do.
// Outputs: a message of one line without control characters.
// Use: Expected<T> for faults of files, options and records. YARS_REQUIRE for faults of the caller; it aborts in every
// build. assert() for faults of the caller that only debug builds check.
#pragma once

#include <sstream>
#include <string>
#include <string_view>

#include "yars/error.hpp"

namespace yars::error {

using yars::Error;
using yars::ErrorCode;
using yars::Expected;

// Makes an Error, which converts to every Expected<T>. If the error ends the program, the exit code is 1.
inline tl::unexpected<Error> fail(std::string subject, std::string expected, std::string found,
                                  std::string action = {}) {
  return tl::unexpected<Error>(Error{std::move(subject), std::move(expected), std::move(found), std::move(action)});
}

// Marks an error as a usage error (wrong command line), or makes one. If it ends the program, the exit code is 2.
Error usage_error(Error error);
Error usage_error(std::string subject, std::string expected, std::string found, std::string action = {});

// What was found in place of a file or folder, for Error::found: `absent` if there is none, else the system's text for
// `code`, such as "Permission denied". `code`: errno, or the value of a std::error_code.
std::string reason_of(int code, std::string_view absent = "none");

// Prints the failed condition and its values on standard error and aborts. Called by YARS_REQUIRE.
[[noreturn]] void requirement_broken(std::string_view expression, std::string_view values, const char* file, int line);

// "LEFT and RIGHT", for the message of YARS_REQUIRE.
template <class Left, class Right>
std::string both_values(const Left& left, const Right& right) {
  std::ostringstream text;
  text << left << " and " << right;
  return text.str();
}

}  // namespace yars::error

// YARS_REQUIRE(left, op, right): prints both values and aborts unless `left op right` is true.
#define YARS_REQUIRE(left, op, right)                                                                                \
  do {                                                                                                               \
    if (!((left)op(right)))                                                                                          \
      ::yars::error::requirement_broken(#left " " #op " " #right, ::yars::error::both_values(left, right), __FILE__, \
                                        __LINE__);                                                                   \
  } while (false)
