// Records whose words are computed from a number, so that a torn copy is detected.
#pragma once

#include <cstddef>
#include <cstdint>

namespace yars::shm::testing {

constexpr std::uint64_t word_of(std::uint64_t number, std::size_t position) {
  const std::uint64_t mixed = (number + 1) * 0x9e3779b97f4a7c15U + position * 0xbf58476d1ce4e5b9U;
  return mixed ^ (mixed >> 29);
}

template <std::size_t Words>
struct NumberedRecord {
  std::uint64_t number;
  std::uint64_t words[Words];

  static NumberedRecord make(std::uint64_t number) {
    NumberedRecord record;
    record.number = number;
    for (std::size_t i = 0; i < Words; ++i) record.words[i] = word_of(number, i);
    return record;
  }
  bool is_whole() const {
    for (std::size_t i = 0; i < Words; ++i)
      if (words[i] != word_of(number, i)) return false;
    return true;
  }
};

// Numbered record with a length that depends on the number. Containers copy only the used words.
struct VaryingRecord {
  static constexpr std::size_t kMaxWords = 12;
  std::uint64_t number;
  std::uint64_t used;  // [words] length
  std::uint64_t words[kMaxWords];

  static VaryingRecord make(std::uint64_t number) {
    VaryingRecord record{number, number % (kMaxWords + 1), {}};
    for (std::size_t i = 0; i < record.used; ++i) record.words[i] = word_of(number, i);
    return record;
  }
  bool is_whole() const {
    if (used != number % (kMaxWords + 1)) return false;
    for (std::size_t i = 0; i < used; ++i)
      if (words[i] != word_of(number, i)) return false;
    return true;
  }
};
// Customization point of shm/words.hpp: `number`, `used` and the used words.
inline std::size_t used_bytes(const VaryingRecord& record) {
  return 16 + 8 * record.used;
}

}  // namespace yars::shm::testing
