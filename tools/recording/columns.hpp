// Records of one size as columns: what hardly changes from record to record becomes zeros, and zeros pack to nothing.
// Each 8-byte word of a record is a column. The first record stands whole; of each later word stands what a straight
// line, or a curve of second order, through the words before misses (integers that wrap: nothing is lost, whatever the
// bytes mean), cut into planes of bytes of equal weight; planes of zeros are left out.
// Form: the first record; for each word a byte with the order of its differences (1..3) and a byte with its planes (bit
// n: bytes of weight 256^n); then the planes, each of one byte for each later record.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace yars::tools::recording {

// `records`: whole ones of `record_bytes`, one behind the other. Appends to `coded`.
void encode_columns(std::span<const std::byte> records, std::size_t record_bytes, std::vector<std::byte>& coded);

// Appends `count` records to `records`; false, and nothing is appended, when `coded` is not what this many records
// encode to.
bool decode_columns(std::span<const std::byte> coded, std::size_t count, std::size_t record_bytes,
                    std::vector<std::byte>& records);

}  // namespace yars::tools::recording
