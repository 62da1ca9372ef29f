// Records of an OpenFlight file, one after another: big-endian, u16 opcode, u16 length of the whole record.
// Continuation records (23) are joined to the one before. A field past the end of a shorter record is absent: older
// revisions are shorter. Nothing is read outside the bytes. Errors: a length below 4, a record past the end, a joined
// record too long.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "lib/failure/error.hpp"

namespace yars::model::scene {

template <class Number>
Number big_endian(const std::byte* bytes) {
  std::array<std::byte, sizeof(Number)> reversed;
  for (std::size_t i = 0; i < sizeof(Number); ++i) reversed[i] = bytes[sizeof(Number) - 1 - i];
  return std::bit_cast<Number>(reversed);
}

// One record; offsets count from its opcode, as format descriptions do.
class Record {
 public:
  Record() = default;
  Record(std::size_t start, std::uint16_t opcode, std::span<const std::byte> bytes)
      : start_(start), opcode_(opcode), bytes_(bytes) {}

  std::size_t start() const { return start_; }  // of the opcode, in the file
  std::uint16_t opcode() const { return opcode_; }
  std::size_t size() const { return bytes_.size(); }
  bool has(std::size_t offset, std::size_t bytes) const {
    return offset <= bytes_.size() && bytes <= bytes_.size() - offset;
  }

  template <class Number>
  std::optional<Number> number(std::size_t offset) const {
    static_assert(std::is_arithmetic_v<Number>);
    if (!has(offset, sizeof(Number))) return std::nullopt;
    return big_endian<Number>(bytes_.data() + offset);
  }
  template <class Number>
  Number number_or(std::size_t offset, Number absent) const {
    return has(offset, sizeof(Number)) ? big_endian<Number>(bytes_.data() + offset) : absent;
  }
  // Up to a zero or `most` characters, whichever comes first; what is not printable ASCII becomes '?'.
  std::string text(std::size_t offset, std::size_t most) const;

 private:
  std::size_t start_ = 0;
  std::uint16_t opcode_ = 0;
  std::span<const std::byte> bytes_;
};

class RecordStream {
 public:
  RecordStream(std::span<const std::byte> bytes, std::string subject) : bytes_(bytes), subject_(std::move(subject)) {}

  // The next record, valid until the next call; nothing at the end of the file.
  failure::Expected<std::optional<Record>> next();

 private:
  failure::Expected<std::optional<Record>> single();

  std::span<const std::byte> bytes_;
  std::string subject_;
  std::size_t at_ = 0;
  std::vector<std::byte> joined_;
};

// The record that begins at `start`, nothing when none fits there.
std::optional<Record> record_at(std::span<const std::byte> bytes, std::size_t start);

}  // namespace yars::model::scene
