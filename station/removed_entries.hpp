// Entries of the world that an instructor's page has removed, so that it can bring them back.
// Inputs: the world before and after each change. Outputs: a world with a removed entry as it was.
// Errors: an entry that was not removed, or no longer remembered; those of world::restore().
// Threads: one. Source: docs/station.md#commands.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>

#include "lib/error/error.hpp"
#include "world/world_edit.hpp"

namespace yars::station {

class RemovedEntries {
 public:
  static constexpr std::size_t kMaxEntries = 512;  // of all lists; a world has at most 400

  // Remembers the entries of `before` that `after` lacks.
  void note(const databuffer::WorldState& before, const databuffer::WorldState& after);
  // Adds a removed entry to the world, with its id and all its values. A mover has gone on meanwhile.
  error::Expected<void> restore(databuffer::WorldState& world, world::WorldList list, std::uint32_t id) const;

 private:
  std::deque<world::WorldEntry> entries_;  // the newest first
};

}  // namespace yars::station
