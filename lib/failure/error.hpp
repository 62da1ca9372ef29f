// A failure of the world outside: a file, an option, a record. Its message says what was expected, what was
// found and what to do; that is one line for a person.
#pragma once

#include <string>
#include <tl/expected.hpp>

namespace yars::failure {

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

}  // namespace yars::failure
