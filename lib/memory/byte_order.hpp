// Reading and writing of numbers in files and datagrams, in a given byte order. T: any integer or floating point type.
// Requirement: the caller has checked that sizeof(T) bytes exist at the position.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

namespace yars::memory {

using Bytes = std::span<const std::byte>;

// The number of type T that is stored at `bytes` in the byte order `order`.
template <class T>
T read_as(const std::byte* bytes, std::endian order) {
  std::array<std::byte, sizeof(T)> raw;
  std::copy_n(bytes, sizeof(T), raw.begin());
  if (order != std::endian::native) std::reverse(raw.begin(), raw.end());
  return std::bit_cast<T>(raw);
}

template <class T>
T big_endian(const std::byte* bytes) {
  return read_as<T>(bytes, std::endian::big);
}

// The number at `offset` in `bytes`. In debug builds assert() fails if the number extends beyond the end.
template <class T>
T big_endian(Bytes bytes, std::size_t offset) {
  assert(offset <= bytes.size() && sizeof(T) <= bytes.size() - offset);
  return read_as<T>(bytes.data() + offset, std::endian::big);
}

// Copies big-endian numbers of 16 bits from `bytes`. Requires 2 * numbers.size() bytes.
inline void copy_big_endian(const std::byte* bytes, std::span<std::int16_t> numbers) {
  std::memcpy(numbers.data(), bytes, numbers.size_bytes());
  if constexpr (std::endian::native == std::endian::little)
    for (std::int16_t& number : numbers)
      number = static_cast<std::int16_t>(std::rotl(static_cast<std::uint16_t>(number), 8));
}

template <class T>
T little_endian(Bytes bytes, std::size_t offset) {
  assert(offset <= bytes.size() && sizeof(T) <= bytes.size() - offset);
  return read_as<T>(bytes.data() + offset, std::endian::little);
}

// The bytes of a number in the byte order `order`.
template <class T>
std::array<std::byte, sizeof(T)> bytes_of(T value, std::endian order) {
  auto raw = std::bit_cast<std::array<std::byte, sizeof(T)>>(value);
  if (order != std::endian::native) std::reverse(raw.begin(), raw.end());
  return raw;
}

template <class T>
void append_big_endian(T value, std::vector<std::byte>& bytes) {
  const auto raw = bytes_of(value, std::endian::big);
  bytes.insert(bytes.end(), raw.begin(), raw.end());
}

}  // namespace yars::memory
