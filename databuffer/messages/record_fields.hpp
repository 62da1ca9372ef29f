// The fields of the records that travel, by name: for people and programs that read the segment without C++.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace yars::databuffer {

struct RecordField {
  std::string_view name;
  std::size_t offset;     // [bytes] from the record's begin
  std::size_t size;       // [bytes]
  std::string_view type;  // "double", "uint8", "char[16]", "Mark[10]"
  std::string_view unit;  // "deg", "m/s"; empty: none
  double least, most;     // of its range, both ends included; without a limit -infinity, +infinity
};

struct RecordFields {
  std::string_view record;
  std::size_t size;  // [bytes]
  std::span<const RecordField> fields;
};

// All records of records.idl, with every field but the reserved ones.
std::span<const RecordFields> record_fields();

}  // namespace yars::databuffer
