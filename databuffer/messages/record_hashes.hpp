// Hashes of pictures, by which a reader recognizes equal, damaged and torn ones.
// Outputs: XXH3, 64 bits.
// Threads: pure functions.
// Source: xxHash, https://github.com/Cyan4973/xxHash, XXH3_64bits.
#pragma once

#include <cstdint>
#include <span>

#include "databuffer/messages/model_records.hpp"
#include "databuffer/messages/pictures.hpp"

namespace yars::databuffer {

// Hash of apex, altitude, edges, ground track, antenna elevation and range. It seeds the hash over the video samples in
// use, which is the result.
std::uint64_t sweep_hash(const Sweep& sweep);

// Hash of a patch map's pixels. The seed is the hash of the map's twelve geometry fields. Ids and ticks are not hashed,
// so equal maps have equal hashes.
std::uint64_t map_hash(const PatchMap& map, std::span<const std::uint8_t> pixels);

}  // namespace yars::databuffer
