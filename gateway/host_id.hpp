// Number of a host in samples: FNV-1a (64 bits) of its name.
// Source: G. Fowler, L. Noll, K. Vo, "FNV hash", parameters for 64 bits.
#pragma once

#include <cstdint>
#include <string_view>

namespace yars::gateway {

constexpr std::uint64_t host_id(std::string_view name) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char letter : name) hash = (hash ^ static_cast<unsigned char>(letter)) * 0x100000001b3U;
  return hash;
}

}  // namespace yars::gateway
