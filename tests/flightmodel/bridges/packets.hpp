// Packets of external programs as bytes, from the files of tests/flightmodel/bridges/packets, and as decoded entities.
// with() changes one field, for packets with other or invalid values.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <fstream>
#include <iterator>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "flightmodel/bridges/dis.hpp"
#include "lib/geo/quantity.hpp"

namespace yars::flightmodel::bridges {

using PacketBytes = std::vector<std::byte>;

inline PacketBytes bytes_of(std::string_view text) {
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

// `name`: path below tests/flightmodel/bridges/packets.
inline std::string text_of_packet(const std::string& name) {
  std::ifstream file(YARS_SOURCE_DIR "/tests/flightmodel/bridges/packets/" + name, std::ios::binary);
  if (!file) throw std::runtime_error("no packet " + name);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline PacketBytes packet_of(const std::string& name) {
  return bytes_of(text_of_packet(name));
}

// Heights above the ellipsoid are then taken as altitudes.
inline geo::Geoid no_geoid() {
  return geo::Geoid("/nowhere");
}

// The entity that a DIS packet reports.
inline EntityState state_of(const std::string& name) {
  return decode_entity_state(packet_of(name), no_geoid()).value();
}

inline geo::Duration seconds(double value) {
  return geo::Duration::seconds(value);
}

// Writes a number at a byte offset of a packet, in the byte order `order`.
template <class T>
void put(PacketBytes& packet, std::size_t offset, T value, std::endian order) {
  auto raw = std::bit_cast<std::array<std::byte, sizeof(T)>>(value);
  if (order != std::endian::native) std::reverse(raw.begin(), raw.end());
  std::copy(raw.begin(), raw.end(), packet.begin() + static_cast<std::ptrdiff_t>(offset));
}

// Copy of a packet with one number changed.
template <class T>
PacketBytes with(PacketBytes packet, std::size_t offset, T value, std::endian order = std::endian::big) {
  put(packet, offset, value, order);
  return packet;
}

}  // namespace yars::flightmodel::bridges
