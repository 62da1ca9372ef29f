// Bytes of big-endian records, one behind the other.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace yars::model::scene {

class RecordBuilder {
 public:
  // A record of this length, zeros; what follows is put into it by offsets from its opcode.
  void begin(std::uint16_t opcode, std::size_t bytes) {
    start_ = bytes_.size();
    bytes_.resize(start_ + bytes);
    put<std::uint16_t>(0, opcode);
    put<std::uint16_t>(2, static_cast<std::uint16_t>(bytes));
  }

  template <class Number>
  void put(std::size_t offset, Number value) {
    const auto raw = std::bit_cast<std::array<std::byte, sizeof(Number)>>(value);
    std::reverse_copy(raw.begin(), raw.end(), bytes_.begin() + static_cast<std::ptrdiff_t>(start_ + offset));
  }

  void put_text(std::size_t offset, const std::string& text, std::size_t most) {
    for (std::size_t i = 0; i < std::min(text.size(), most); ++i)
      bytes_[start_ + offset + i] = static_cast<std::byte>(text[i]);
  }

  void append(const RecordBuilder& other) { bytes_.insert(bytes_.end(), other.bytes_.begin(), other.bytes_.end()); }
  std::size_t size() const { return bytes_.size(); }
  std::vector<std::byte>& bytes() { return bytes_; }

 private:
  std::vector<std::byte> bytes_;
  std::size_t start_ = 0;
};

}  // namespace yars::model::scene
