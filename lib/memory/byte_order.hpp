// Reader of numbers in a datagram, big-endian or little-endian.
// Inputs: the bytes, an offset [bytes], the byte order of the sender. T is an integer or a floating point type.
// Outputs: the number in the byte order of this machine. The offset need not be aligned.
// Errors: the caller has checked the length; an offset beyond the end is a bug and asserts.
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

// The number of type T that begins at `offset`.
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
