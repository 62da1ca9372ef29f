// Table of the records in records.idl with the name, offset, type, unit and range of each field. layout_json() writes
// the sizes of the records, and the names, offsets and sizes of their fields, for programs in other languages.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace yars::databuffer {

struct RecordField {
  std::string_view name;
  std::size_t offset;     // [bytes] from the beginning of the record
  std::size_t size;       // [bytes] of the whole field; of an array, all entries
  std::string_view type;  // "double", "uint8", "char[16]", "Mark[10]"
  std::string_view unit;  // "deg", "m/s"; empty: no unit
  double min, max;        // range, both ends valid; -infinity or +infinity: no limit on that side
};

struct RecordFields {
  std::string_view record;
  std::size_t size;  // [bytes]
  std::span<const RecordField> fields;
};

// All records of records.idl, with all fields except reserved ones.
std::span<const RecordFields> record_fields();

}  // namespace yars::databuffer
