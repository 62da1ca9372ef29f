// The begin of a recording: magic and version, the kinds of records with their sizes, what the model ran with, and a
// checksum. A recording whose records differ from this build's is refused, not misread.
#pragma once

#include <cstddef>
#include <istream>
#include <string>
#include <vector>

#include "lib/failure/error.hpp"

namespace yars::tools::recording {

// With what the model ran; replay needs the same.
struct RecordingHeader {
  std::string configuration;  // path of the GUF file; empty = built-in
  std::string terrain;        // directory; empty = the configuration's
};

inline constexpr std::size_t kMostHeaderText = std::size_t{1} << 16;  // [bytes] of a path

std::vector<std::byte> bytes_of(const RecordingHeader& header);

// Reads it and leaves `file` behind it. Errors name `file_name`: another kind of file, another version, a record of
// another size or meaning, a header that is damaged or not whole.
failure::Expected<RecordingHeader> read_header(std::istream& file, const std::string& file_name);

}  // namespace yars::tools::recording
