// Where everything lies in the segment, for programs that cannot include the C++ records.
#pragma once

#include <string>

namespace yars::databuffer {

// A JSON object: version, size, hash, and the offset [bytes] of each part from the segment's begin.
std::string layout_json();

}  // namespace yars::databuffer
