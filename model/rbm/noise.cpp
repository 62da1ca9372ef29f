#include "model/rbm/noise.hpp"

namespace yars::model::rbm {

namespace {
// One step of splitmix64 (Steele, Lea, Flood 2014).
std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27U)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31U);
}
}  // namespace

NoiseState make_noise_state(const NoiseKey& key) {
  const std::uint64_t place = (static_cast<std::uint64_t>(key.scan) << 32U) | key.sweep;
  const std::uint64_t bits = mixed(mixed(key.seed) ^ place);
  return {static_cast<std::uint32_t>(bits), static_cast<std::uint32_t>(bits >> 32U)};
}

}  // namespace yars::model::rbm
