// Seed of a property test. YARS_SEED repeats a failed run; the seed is logged with each failure.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <random>

namespace yars::gateway::testing {

inline std::uint64_t random_seed() {
  const char* given = std::getenv("YARS_SEED");
  return given != nullptr ? std::strtoull(given, nullptr, 10) : std::random_device{}();
}

}  // namespace yars::gateway::testing
