// Posts of a grid in blocks (cell.hpp), gathered by vectors. Included once for each target.
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
namespace yars::model::terrain::post_lanes::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using FloatLanes = hn::CappedTag<float, kRunSlack>;
using WholeLanes = hn::RebindToSigned<FloatLanes>;
using Floats = hn::Vec<FloatLanes>;
using Wholes = hn::Vec<WholeLanes>;

constexpr std::int32_t kVoid = -32768;

// Quotient of a small non-negative whole number by the step of the blocks: times 65536 / step, rounded up, is exact
// below 13000.
template <int kStep>
HWY_INLINE Wholes divided(Wholes number) {
  constexpr std::uint16_t kInverse = (65536 + kStep - 1) / kStep;
#if HWY_TARGET == HWY_SCALAR
  return hn::ShiftRight<16>(hn::Mul(number, hn::Set(WholeLanes(), std::int32_t{kInverse})));
#else
  const hn::Repartition<std::uint16_t, WholeLanes> d16;
  return hn::BitCast(WholeLanes(), hn::MulHigh(hn::BitCast(d16, number), hn::Set(d16, kInverse)));
#endif
}

// Where posts lie in the blocks of a grid.
class BlockLanes {
 public:
  HWY_INLINE explicit BlockLanes(const PostBlocks& posts)
      : row_of_blocks_(hn::Set(WholeLanes(),
                               kPost * (posts.block_columns() * kBlock - PostBlocks::kRowStep * PostBlocks::kColumns))),
        column_of_blocks_(hn::Set(WholeLanes(), kPost * (kBlock - PostBlocks::kColumnStep))) {}

  // [bytes] from the first post to this one; neither the last row nor the last column.
  HWY_INLINE Wholes offset(Wholes row, Wholes column) const {
    // A post is a row or a column on within its block; a block further, the posts of the one before are taken back.
    const auto blocks = hn::Add(hn::Mul(divided<PostBlocks::kRowStep>(row), row_of_blocks_),
                                hn::Mul(divided<PostBlocks::kColumnStep>(column), column_of_blocks_));
    return hn::Add(blocks, hn::Add(hn::ShiftLeft<4>(row), hn::ShiftLeft<1>(column)));
  }

 private:
  static constexpr auto kPost = static_cast<std::int32_t>(sizeof(std::int16_t));
  static constexpr auto kBlock = static_cast<std::int32_t>(PostBlocks::kPosts);
  static_assert(kPost == 2 && PostBlocks::kColumns == 8);
  Wholes row_of_blocks_, column_of_blocks_;
};

// Two posts side by side, the western one in the lower half, at offsets [bytes] from `posts`.
HWY_INLINE Wholes gather_word(const std::int16_t* posts, Wholes offset) {
#if HWY_TARGET == HWY_SCALAR
  // Highway would load a word where none is aligned.
  std::int32_t both = 0;
  std::memcpy(&both, reinterpret_cast<const char*>(posts) + hn::GetLane(offset), sizeof both);
  return hn::Set(WholeLanes(), both);
#else
  return hn::GatherOffset(WholeLanes(), reinterpret_cast<const std::int32_t*>(posts), offset);
#endif
}
// The two about a place and the two north of them.
struct Words {
  Wholes south, north;
};
HWY_INLINE Words gather(const std::int16_t* posts, Wholes offset) {
  return {gather_word(posts, offset), gather_word(posts + PostBlocks::kColumns, offset)};
}
HWY_INLINE Wholes western(Wholes word) {
  return hn::ShiftRight<16>(hn::ShiftLeft<16>(word));
}
HWY_INLINE Wholes eastern(Wholes word) {
  return hn::ShiftRight<16>(word);
}

}  // namespace yars::model::terrain::post_lanes::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per target
