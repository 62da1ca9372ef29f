#include "tools/recording/comparison.hpp"

#include <algorithm>

namespace yars::tools::recording {

namespace {
constexpr std::uint64_t kFnvPrime = 0x100000001b3ULL;
}  // namespace

void Comparison::made(const databuffer::Sweep& sweep) {
  settle(made_, recorded_, {sweep.epoch, sweep.number}, sweep.hash);
}

void Comparison::recorded(const SweepMark& mark) {
  for (int byte = 0; byte < 8; ++byte) run_hash_ = (run_hash_ ^ (mark.hash >> (8 * byte) & 0xffU)) * kFnvPrime;
  // A sweep over posts that were still loading is not a function of the ticks.
  if ((mark.flags & databuffer::kSweepNotReady) != 0U)
    ++not_ready_;
  else
    settle(recorded_, made_, {mark.epoch, mark.number}, mark.hash);
}

void Comparison::settle(Hashes& own, Hashes& other, Key sweep, std::uint64_t hash) {
  const auto [first, end] = other.equal_range(sweep);
  if (first == end) {
    own.emplace(sweep, hash);
    return;
  }
  const auto partner = std::find_if(first, end, [hash](const auto& candidate) { return candidate.second == hash; });
  ++(partner != end ? equal_ : different_);
  other.erase(partner != end ? partner : first);
}

}  // namespace yars::tools::recording
