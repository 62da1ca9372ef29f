// Where everything lies in the segment, for programs that cannot include the C++ records: `yars status --layout`.
#pragma once

#include <string>

namespace yars::databuffer {

// A JSON object. `version`, `size` [bytes], `hash` (16 hexadecimal digits): what the header must say. `lock_bytes`: the
// file's bytes that claims lock. `offsets`: of each part from the segment's begin [bytes]. `containers`: of each part
// the kind, how many lie side by side and how far apart, and the offsets inside. `records`: size, and each field's
// [offset, bytes].
std::string layout_json();

}  // namespace yars::databuffer
