// Sweeps made again against sweeps recorded, by epoch and number of the sweep. Of one number there are two sweeps
// where a model was killed between a sweep and its status.
#pragma once

#include <cstdint>
#include <map>
#include <utility>

#include "databuffer/records/model_records.hpp"
#include "tools/recording/recorded_kinds.hpp"

namespace yars::tools::recording {

class Comparison {
 public:
  void made(const databuffer::Sweep& sweep);
  void recorded(const SweepMark& mark);

  std::uint64_t equal() const { return equal_; }
  std::uint64_t different() const { return different_; }
  std::uint64_t not_ready() const { return not_ready_; }      // recorded over posts that were still loading
  std::uint64_t missing() const { return recorded_.size(); }  // recorded, not made again
  std::uint64_t extra() const { return made_.size(); }        // the other way round
  std::uint64_t run_hash() const { return run_hash_; }        // FNV-1a 64 over the recorded hashes in order

 private:
  using Key = std::pair<std::uint32_t, std::uint32_t>;
  using Hashes = std::multimap<Key, std::uint64_t>;
  void settle(Hashes& own, Hashes& other, Key sweep, std::uint64_t hash);

  Hashes made_, recorded_;  // those without a partner yet
  std::uint64_t equal_ = 0, different_ = 0, not_ready_ = 0;
  std::uint64_t run_hash_ = 0xcbf29ce484222325ULL;
};

}  // namespace yars::tools::recording
