// The hash of a patch map: equal maps, equal hashes, whoever made them.
#pragma once

#include <cstdint>
#include <span>

#include "databuffer/records/patch_map.hpp"

namespace yars::model::kernel {

// XXH3 64 over the record's fields before `hash` but for id and ticks, then, seeded with that, over the pixels.
std::uint64_t map_hash(const databuffer::PatchMap& map, std::span<const std::uint8_t> pixels);

}  // namespace yars::model::kernel
