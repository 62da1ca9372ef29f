// SIMD gather of posts from the blocks of a grid (PostBlocks in cell.hpp). Included once per Highway target.
#if defined(YARS_MODEL_TERRAIN_SAMPLING_POST_SIMD_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef YARS_MODEL_TERRAIN_SAMPLING_POST_SIMD_INL
#undef YARS_MODEL_TERRAIN_SAMPLING_POST_SIMD_INL
#else
#define YARS_MODEL_TERRAIN_SAMPLING_POST_SIMD_INL
#endif

#include <hwy/highway.h>

#include <cstdint>
#include <cstring>

#include "model/terrain/formats/cell.hpp"
#include "model/terrain/sampling/terrain_view.hpp"

HWY_BEFORE_NAMESPACE();
namespace yars::model::terrain::post_simd::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using FloatLanes = hn::CappedTag<float, kRunSlack>;
using IntLanes = hn::RebindToSigned<FloatLanes>;
using Floats = hn::Vec<FloatLanes>;
using Ints = hn::Vec<IntLanes>;

constexpr std::int32_t kVoid = -32768;

// Quotient number / kStep, rounded down. The number is multiplied by kInverse, which is 65536 / kStep rounded up. The
// lower 16 bits of the product are dropped.
// Exact for 0 <= number < 13000 and a kStep of 3 or 7.
template <int kStep>
HWY_INLINE Ints divided(Ints number) {
  constexpr std::uint16_t kInverse = (65536 + kStep - 1) / kStep;
#if HWY_TARGET == HWY_SCALAR
  return hn::ShiftRight<16>(hn::Mul(number, hn::Set(IntLanes(), std::int32_t{kInverse})));
#else
  const hn::Repartition<std::uint16_t, IntLanes> d16;
  return hn::BitCast(IntLanes(), hn::MulHigh(hn::BitCast(d16, number), hn::Set(d16, kInverse)));
#endif
}

// Whole numbers from 0 to 2^23 as integers.
HWY_INLINE Ints integer(Floats number) {
  constexpr float kIntegerBias = 8388608.0F;  // 2^23: the sum has the integer in its lowest mantissa bits
  const IntLanes di;
  return hn::Sub(hn::BitCast(di, hn::Add(number, hn::Set(FloatLanes(), kIntegerBias))), hn::Set(di, 0x4b000000));
}

// Byte offsets of heights in the blocks of a grid; half of them are the offsets of its codes.
class BlockLanes {
 public:
  template <class Post>
  HWY_INLINE explicit BlockLanes(const Blocks<Post>& posts)
      : row_of_blocks_(hn::Set(IntLanes(),
                               kPost * (posts.block_columns() * kBlock - PostBlocks::kRowStep * PostBlocks::kColumns))),
        column_of_blocks_(hn::Set(IntLanes(), kPost * (kBlock - PostBlocks::kColumnStep))) {}

  // [bytes] Offset of post (row, column) from the first post. Requires 0 <= row < rows - 1; column likewise.
  HWY_INLINE Ints offset(Ints row, Ints column) const {
    // Offset = 16 row + 2 column + row / 3 * (64 block_columns - 48) + column / 7 * (64 - 14), with whole quotients.
    const auto blocks = hn::Add(hn::Mul(divided<PostBlocks::kRowStep>(row), row_of_blocks_),
                                hn::Mul(divided<PostBlocks::kColumnStep>(column), column_of_blocks_));
    return hn::Add(blocks, hn::Add(hn::ShiftLeft<4>(row), hn::ShiftLeft<1>(column)));
  }

 private:
  static constexpr auto kPost = static_cast<std::int32_t>(sizeof(std::int16_t));
  static constexpr auto kBlock = static_cast<std::int32_t>(PostBlocks::kPosts);
  static_assert(kPost == 2 && PostBlocks::kColumns == 8);
  Ints row_of_blocks_, column_of_blocks_;
};

// Two adjacent posts of a row in each lane. The western post begins `offset` bytes after `posts`. It is in the lower 16
// bits.
HWY_INLINE Ints gather_word(const std::int16_t* posts, Ints offset) {
#if HWY_TARGET == HWY_SCALAR
  // Highway's scalar gather requires aligned words.
  std::int32_t both = 0;
  std::memcpy(&both, reinterpret_cast<const char*>(posts) + hn::GetLane(offset), sizeof both);
  return hn::Set(IntLanes(), both);
#else
  return hn::GatherOffset(IntLanes(), reinterpret_cast<const std::int32_t*>(posts), offset);
#endif
}
// Material codes at `entry` of the blocks.
HWY_INLINE Ints gather_code(const CodeBlocks& codes, Ints entry) {
#if HWY_TARGET == HWY_SCALAR
  return hn::Set(IntLanes(), std::int32_t{codes.data()[hn::GetLane(entry)]});
#else
  // Four bytes, of which the lowest is the code. The spare block after the last one keeps this within the blocks.
  const auto words = hn::GatherOffset(IntLanes(), reinterpret_cast<const std::int32_t*>(codes.data()), entry);
  return hn::And(words, hn::Set(IntLanes(), 0xff));
#endif
}

// The four posts around a position: the southern pair and the northern pair, each as a word of gather_word().
struct Words {
  Ints south, north;
};
HWY_INLINE Words gather(const std::int16_t* posts, Ints offset) {
  return {gather_word(posts, offset), gather_word(posts + PostBlocks::kColumns, offset)};
}
// The western and the eastern post of each word. The arithmetic shift preserves their signs.
HWY_INLINE Ints western(Ints word) {
  return hn::ShiftRight<16>(hn::ShiftLeft<16>(word));
}
HWY_INLINE Ints eastern(Ints word) {
  return hn::ShiftRight<16>(word);
}

}  // namespace yars::model::terrain::post_simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per target
