// Errors of the world outside as values, and conditions that must hold in every build.
#pragma once

#include <sstream>
#include <string>
#include <string_view>
#include <tl/expected.hpp>

namespace yars::error {

// A failure of the world outside: a file, an option, a record. Its message says what was expected, what was
// found and what to do; that is one line for a person.
struct Error {
  std::string subject;     // what it is about: a path, an option, a record
  std::string expected;    // what would have been right
  std::string found;       // what was there
  std::string action;      // what the reader can do; may be empty
  bool bad_usage = false;  // the command line caused it: exit code 2 instead of 1

  std::string message() const;  // one line without control characters, whatever a file is called
};

template <class T>
using Expected = tl::expected<T, Error>;

inline tl::unexpected<Error> fail(std::string subject, std::string expected, std::string found,
                                  std::string action = {}) {
  return tl::unexpected<Error>(
      Error{std::move(subject), std::move(expected), std::move(found), std::move(action), false});
}

// An error that the user's command line caused: exit code 2 instead of 1.
Error usage_error(Error error);
Error usage_error(std::string subject, std::string expected, std::string found, std::string action = {});

// A condition that must hold in every build. A broken one ends the process and prints both values.
// assert() is for our own bugs in debug builds; Expected<T> is for the world outside.
[[noreturn]] void requirement_broken(std::string_view expression, std::string_view values, const char* file, int line);

template <class Left, class Right>
std::string both_values(const Left& left, const Right& right) {
  std::ostringstream text;
  text << left << " and " << right;
  return text.str();
}

}  // namespace yars::error

// YARS_REQUIRE(left, op, right): aborts with both values unless `left op right`.
#define YARS_REQUIRE(left, op, right)                                                                                \
  do {                                                                                                               \
    if (!((left)op(right)))                                                                                          \
      ::yars::error::requirement_broken(#left " " #op " " #right, ::yars::error::both_values(left, right), __FILE__, \
                                        __LINE__);                                                                   \
  } while (false)
