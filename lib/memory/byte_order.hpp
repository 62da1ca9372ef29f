// Numbers at fixed places of a datagram, in the byte order of its sender. The caller has checked the length: a place
// beyond the end is a bug of ours and asserts.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>

namespace yars::memory {

using Bytes = std::span<const std::byte>;

// T: an integer or a floating point number.
template <class T>
T read_as(Bytes bytes, std::size_t offset, std::endian order) {
  assert(offset <= bytes.size() && sizeof(T) <= bytes.size() - offset);
  std::array<std::byte, sizeof(T)> raw{};
  std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(offset), sizeof(T), raw.begin());
  if (order != std::endian::native) std::reverse(raw.begin(), raw.end());
  return std::bit_cast<T>(raw);
}

template <class T>
T big_endian(Bytes bytes, std::size_t offset) {
  return read_as<T>(bytes, offset, std::endian::big);
}

template <class T>
T little_endian(Bytes bytes, std::size_t offset) {
  return read_as<T>(bytes, offset, std::endian::little);
}

}  // namespace yars::memory
