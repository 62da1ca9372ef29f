// The 32-bit hash lowbias32 of counter_rng.hpp for a vector of counts (counter values). Each lane (vector element) gets
// the bits of the scalar hash.
// Included once for each target (instruction set) of the library Highway.
#if defined(YARS_LIB_RANDOM_COUNTER_RNG_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef YARS_LIB_RANDOM_COUNTER_RNG_INL
#undef YARS_LIB_RANDOM_COUNTER_RNG_INL
#else
#define YARS_LIB_RANDOM_COUNTER_RNG_INL
#endif

#include <hwy/highway.h>

#include "lib/random/counter_rng.hpp"

HWY_BEFORE_NAMESPACE();
namespace yars::random::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// lowbias32 without the last shift. The upper 16 bits of the result are well mixed. V: vector of std::uint32_t.
template <class V>
HWY_INLINE V lowbias32_rounds(V bits) {
  const hn::DFromV<V> d;
  bits = hn::Mul(hn::Xor(bits, hn::ShiftRight<16>(bits)), hn::Set(d, kLowbias32First));
  return hn::Mul(hn::Xor(bits, hn::ShiftRight<15>(bits)), hn::Set(d, kLowbias32Second));
}

// 32 random bits for each count.
template <class V>
HWY_INLINE V lowbias32(V count) {
  const V bits = lowbias32_rounds(count);
  return hn::Xor(bits, hn::ShiftRight<16>(bits));
}

}  // namespace yars::random::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
