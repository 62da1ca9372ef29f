// Makes damaged OpenFlight files: copies of an undamaged file with one to four changes, so that readers get past the
// header. Changes: random bytes, extreme values of record fields, removed bytes, copied bytes, changed record types and
// lengths, a truncated file.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "model/scene/openflight/records.hpp"
#include "worldgen/scene/scene_builder.hpp"

namespace yars::model::scene {

class Mutation {
 public:
  explicit Mutation(std::span<const std::byte> original) : original_(original.begin(), original.end()) {
    std::size_t at = 0;
    while (const auto record = record_at(original_, at)) {
      records_.push_back(at);
      at += record->size();
    }
  }

  std::vector<std::byte> made(random::CounterRng& rng) const {
    std::vector<std::byte> bytes = original_;
    const int changes = 1 + rng.below(4);
    for (int change = 0; change < changes && bytes.size() > 64; ++change) alter(bytes, rng);
    return bytes;
  }

 private:
  static std::size_t pick(std::size_t count, random::CounterRng& rng) {
    return static_cast<std::size_t>(rng.word() % std::max<std::size_t>(count, 1));
  }

  void put(std::vector<std::byte>& bytes, std::size_t at, std::uint64_t value, std::size_t width) const {
    for (std::size_t i = 0; i < width && at + i < bytes.size(); ++i)
      bytes[at + i] = static_cast<std::byte>(value >> 8 * (width - 1 - i));
  }

  void alter(std::vector<std::byte>& bytes, random::CounterRng& rng) const {
    static constexpr std::array<std::uint64_t, 12> kExtremeValues{
        0, 1, 2, 3, 4, 0x7F, 0x8000, 0xFFFF, 0x7FFFFFFF, 0xFFFFFFFF, 0x7FF00000, 0x7FC00000};
    static constexpr std::array<std::uint64_t, 24> kOpcodes{1,  2,  4,  5,  10, 11, 19, 20, 21, 22, 23, 32,
                                                            49, 60, 61, 62, 63, 67, 72, 73, 84, 85, 86, 96};
    // With probability 1/3 one of the first 40 records, which a choice from all records would rarely hit.
    const std::size_t record =
        records_[pick(rng.below(3) == 0 ? std::min<std::size_t>(records_.size(), 40) : records_.size(), rng)];
    const std::size_t offset = 4 + 2 * pick(40, rng);
    switch (rng.below(14)) {
      case 0:
        put(bytes, pick(bytes.size(), rng), rng.word(), 1);
        break;
      case 1:
        put(bytes, record + offset, kExtremeValues[pick(kExtremeValues.size(), rng)], 2);
        break;
      case 2:
        put(bytes, record + offset, kExtremeValues[pick(kExtremeValues.size(), rng)], 4);
        break;
      case 3:
        put(bytes, record + offset, rng.word(), 8);
        break;
      case 9:
      case 10:
        put(bytes, record + offset, rng.word(), 2);
        break;
      case 11:
      case 12:
        put(bytes, record + offset, pick(300, rng), 2);
        break;
      case 4:
        put(bytes, record, kOpcodes[pick(kOpcodes.size(), rng)], 2);
        break;
      case 5:
        put(bytes, record + 2, 4 + pick(256, rng), 2);
        break;
      case 6:
        bytes.resize(bytes.size() - pick(bytes.size() / 8, rng));
        break;
      case 7: {
        const std::size_t from = std::min(record, bytes.size() - 1),
                          size = std::min(pick(300, rng), bytes.size() - from);
        bytes.erase(bytes.begin() + static_cast<std::ptrdiff_t>(from),
                    bytes.begin() + static_cast<std::ptrdiff_t>(from + size));
        break;
      }
      default: {
        const std::size_t from = std::min(record, bytes.size() - 1),
                          size = std::min(pick(300, rng), bytes.size() - from);
        const std::size_t to = std::min(records_[pick(records_.size(), rng)], bytes.size());
        const std::vector<std::byte> part(bytes.begin() + static_cast<std::ptrdiff_t>(from),
                                          bytes.begin() + static_cast<std::ptrdiff_t>(from + size));
        bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(to), part.begin(), part.end());
      }
    }
  }

  std::vector<std::byte> original_;
  std::vector<std::size_t> records_;  // offsets of the records
};

}  // namespace yars::model::scene
