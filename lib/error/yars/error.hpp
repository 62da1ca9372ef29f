// Error of a call, and the value that a call gives if there is none.
// Inputs: subject, what was expected, what was found, what the user can do.
// Outputs: a message of one line without control characters.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <tl/expected.hpp>

#include "yars/export.hpp"

namespace yars {

enum class ErrorCode : std::uint8_t {
  failed,     // a file, a folder or the system does not allow what was asked for
  argument,   // a value of the caller that is not valid
  range,      // a number of the caller beyond Error::low or Error::high
  limit,      // beyond the limits of the radar; PatchRequest::force and ScanRequest::force ignore most of them
  cancelled,  // Call::goes_on has ended the call
};

struct YARS_EXPORT Error {
  std::string subject;   // field of a request, option, record, or path of a file; may be empty
  std::string expected;  // description of a valid value
  std::string found;     // description of the actual value
  std::string action;    // what the user can do; may be empty
  ErrorCode code = ErrorCode::failed;
  std::optional<double> low{}, high{};  // limits of a number; both are valid values

  // True: a value of the caller is wrong, whatever radar and files are.
  bool bad_usage() const { return code == ErrorCode::argument || code == ErrorCode::range; }
  // "SUBJECT: expected EXPECTED, found FOUND; ACTION" on one line; control characters are escaped, and parts of more
  // than 500 bytes are cut. Without a subject or an action its part is left out.
  std::string message() const;
};

// A value or an Error.
template <class T>
using Expected = tl::expected<T, Error>;

}  // namespace yars
