// Layout of the segment as JSON, which `yars status --layout` prints for programs that cannot include the C++ records.
#pragma once

#include <string>

namespace yars::databuffer {

// One JSON object. All sizes, offsets and strides are in bytes.
//   version, size, hash (16 hexadecimal digits): values that the segment's header must have
//   lock_bytes: lock byte of presence in the session ("participation"), of each role, and of the first ownship lane,
//     input lane and entry of the process table
//   offsets: offset of each part from the beginning of the segment
//   containers: kind of each part, its number of elements, their stride, and the offsets inside an element
//   records: size of each record; [offset, size] of each field
std::string layout_json();

}  // namespace yars::databuffer
