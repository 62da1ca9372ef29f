#include "model/hrm/scene_vertices_simd.hpp"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "model/hrm/scene_vertices_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace yars::model::hrm::simd::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t kMaxLanes = 16;
using Tag = hn::CappedTag<float, kMaxLanes>;
using SignedTag = hn::RebindToSigned<Tag>;
using BitsTag = hn::RebindToUnsigned<Tag>;
using Floats = hn::Vec<Tag>;

// a x + b y, without a fused multiply-add, so that all targets give equal bits.
HWY_INLINE Floats sum_of(float a, Floats x, float b, Floats y) {
  const Tag d;
  return hn::Add(hn::Mul(hn::Set(d, a), x), hn::Mul(hn::Set(d, b), y));
}

// Transforms one vector of vertices. The last vector overlaps the previous one and ends at the tile's last vertex.
HWY_INLINE void transform_vector(std::size_t at, const TileVertices& tile, const VertexMap& map,
                                 const GridVertices& grid) {
  const Tag d;
  const auto east = hn::LoadU(d, tile.east_m + at);
  const auto north = hn::LoadU(d, tile.north_m + at);
  const auto centre = hn::Set(d, map.centre_m);
  const auto right = hn::Add(hn::Set(d, map.right_m), sum_of(map.right_east, east, map.right_north, north));
  // Vertices less than 1 m ahead of the aircraft are moved to 1 m ahead, which keeps right / ahead finite.
  const auto up = hn::Max(hn::Add(hn::Set(d, map.up_m), sum_of(map.up_east, east, map.up_north, north)),
                          hn::Sub(hn::Set(d, 1.0F), centre));
  const auto ahead = hn::Add(centre, up);
  const auto right2 = hn::Mul(right, right);
  const auto distance = hn::Sqrt(hn::Add(right2, hn::Mul(ahead, ahead)));
  // Distance minus the centre's distance, in a form without cancellation.
  const auto beyond = hn::Div(hn::Add(hn::Mul(up, hn::Add(centre, ahead)), right2), hn::Add(distance, centre));
  const auto columns = hn::Mul(hn::Div(right, ahead), hn::Set(d, map.columns_per_tangent));
  hn::StoreU(hn::Add(hn::Set(d, map.middle_column), columns), d, grid.column + at);
  const auto rows = hn::Mul(beyond, hn::Set(d, map.rows_per_metre));
  hn::StoreU(hn::Add(hn::Set(d, map.middle_row), rows), d, grid.row + at);
  hn::StoreU(hn::Add(hn::LoadU(d, tile.up_m + at), hn::Set(d, map.lift_m)), d, grid.height_m + at);
}

// Facing of one vector of vertices: cosine between the normal and the direction to the radar.
HWY_INLINE void face_vector(std::size_t at, const TileVertices& tile, const VertexMap& map, const GridVertices& grid) {
  const Tag d;
  const auto level = sum_of(map.toward_east, hn::LoadU(d, tile.normal_east + at), map.toward_north,
                            hn::LoadU(d, tile.normal_north + at));
  const auto raised = hn::Mul(hn::Set(d, map.toward_up), hn::LoadU(d, tile.normal_up + at));
  hn::StoreU(hn::Add(level, raised), d, grid.facing + at);
}

// Transforms fewer vertices than a vector has lanes, in padded arrays.
void transform_few(std::size_t count, const TileVertices& tile, const VertexMap& map, const GridVertices& grid) {
  float in[3][kMaxLanes] = {};
  float out[3][kMaxLanes] = {};
  std::copy_n(tile.east_m, count, in[0]);
  std::copy_n(tile.north_m, count, in[1]);
  std::copy_n(tile.up_m, count, in[2]);
  transform_vector(0, {in[0], in[1], in[2], nullptr, nullptr, nullptr}, map, {out[0], out[1], out[2], nullptr, 0});
  std::copy_n(out[0], count, grid.column);
  std::copy_n(out[1], count, grid.row);
  std::copy_n(out[2], count, grid.height_m);
}
void face_few(std::size_t count, const TileVertices& tile, const VertexMap& map, const GridVertices& grid) {
  float in[3][kMaxLanes] = {};
  float out[kMaxLanes] = {};
  std::copy_n(tile.normal_east, count, in[0]);
  std::copy_n(tile.normal_north, count, in[1]);
  std::copy_n(tile.normal_up, count, in[2]);
  face_vector(0, {nullptr, nullptr, nullptr, in[0], in[1], in[2]}, map, {nullptr, nullptr, nullptr, out, 0});
  std::copy_n(out, count, grid.facing);
}

void transform_vertices(std::size_t count, const TileVertices& tile, const VertexMap& map, const GridVertices& grid) {
  const Tag d;
  const std::size_t step = hn::Lanes(d);
  if (count < step)
    transform_few(count, tile, map, grid);
  else
    for (std::size_t at = 0; at < count; at += step) transform_vector(std::min(at, count - step), tile, map, grid);
  const std::size_t with_normals = count - grid.first_with_normal;
  if (with_normals < step)
    face_few(with_normals, tile, map, grid);
  else
    for (std::size_t at = 0; at < with_normals; at += step)
      face_vector(std::min(at, with_normals - step), tile, map, grid);
}

// One coordinate of the three corners of a triangle.
struct ThreeCorners {
  Floats first, second, third;
  HWY_INLINE Floats min() const { return hn::Min(hn::Min(first, second), third); }
  HWY_INLINE Floats max() const { return hn::Max(hn::Max(first, second), third); }
};

template <class Indices>
HWY_INLINE ThreeCorners gather(const float* numbers, Indices first, Indices second, Indices third) {
  const Tag d;
  return {hn::GatherIndex(d, numbers, first), hn::GatherIndex(d, numbers, second), hn::GatherIndex(d, numbers, third)};
}

// True if a triangle faces up, or is a wall that faces the radar. Uses the formulas of facet_of() (facet-inl.hpp).
HWY_INLINE hn::Mask<Tag> faces(const ThreeCorners& column, const ThreeCorners& row, const ThreeCorners& height,
                               const GridLimits& limits) {
  const Tag d;
  const auto c1 = hn::Sub(column.second, column.first);
  const auto c2 = hn::Sub(column.third, column.first);
  const auto r1 = hn::Sub(row.second, row.first);
  const auto r2 = hn::Sub(row.third, row.first);
  const auto z1 = hn::Sub(height.second, height.first);
  const auto z2 = hn::Sub(height.third, height.first);
  const auto width = hn::Set(d, limits.column_width_m);
  const auto depth = hn::Set(d, limits.row_spacing_m);
  const auto area = hn::Sub(hn::Mul(c1, r2), hn::Mul(r1, c2));
  const auto upward = hn::Mul(hn::Mul(width, depth), area);
  const auto across = hn::Mul(depth, hn::Sub(hn::Mul(r1, z2), hn::Mul(z1, r2)));
  const auto ahead = hn::Mul(width, hn::Sub(hn::Mul(z1, c2), hn::Mul(c1, z2)));
  const auto level2 = hn::Add(hn::Mul(across, across), hn::Mul(ahead, ahead));
  const auto steep = hn::Lt(hn::Mul(upward, upward), hn::Mul(hn::Set(d, limits.wall_normal2), level2));
  const auto towards = hn::Sub(hn::Mul(upward, hn::Set(d, limits.sine)), hn::Mul(ahead, hn::Set(d, limits.cosine)));
  return hn::Or(hn::Gt(area, hn::Zero(d)), hn::And(steep, hn::Gt(towards, hn::Zero(d))));
}

// Loads one vector of vertex indices, at most `count`. Lanes from `count` on are 0.
HWY_INLINE hn::Vec<SignedTag> corners_at(const std::uint16_t* vertices, std::size_t count) {
  const SignedTag di;
  const hn::Rebind<std::uint16_t, SignedTag> narrow;
  if (count >= hn::Lanes(di)) return hn::PromoteTo(di, hn::LoadU(narrow, vertices));
  HWY_ALIGN std::uint16_t few[kMaxLanes] = {};
  std::copy_n(vertices, count, few);
  return hn::PromoteTo(di, hn::Load(narrow, few));
}

void select_triangles(std::size_t begin, std::size_t end, const Corners& corners, const GridVertices& grid,
                      const GridLimits& limits, FoundTriangles& found) {
  const Tag d;
  const SignedTag di;
  const BitsTag db;
  found.reserve(end - begin);
  found.count = 0;
  for (std::size_t t = begin; t < end; t += hn::Lanes(d)) {
    const auto first = corners_at(corners[0] + t, end - t);
    const auto second = corners_at(corners[1] + t, end - t);
    const auto third = corners_at(corners[2] + t, end - t);
    const ThreeCorners column = gather(grid.column, first, second, third);
    const auto min = column.min();
    const auto max = column.max();
    auto selected = hn::And(hn::Ge(max, hn::Set(d, limits.first_column)), hn::Lt(min, hn::Set(d, limits.last_column)));
    // Rejects triangles too narrow to contain the centre of a column. In a fine scene these are the majority.
    selected = hn::And(selected, hn::Lt(hn::Ceil(min), hn::Ceil(max)));
    if (hn::AllFalse(d, selected)) continue;
    const ThreeCorners row = gather(grid.row, first, second, third);
    selected = hn::And(selected, hn::And(hn::Ge(row.max(), hn::Set(d, limits.first_row)),
                                         hn::Lt(row.min(), hn::Set(d, limits.last_row))));
    selected = hn::And(selected, faces(column, row, gather(grid.height_m, first, second, third), limits));
    const auto numbers = hn::Iota(db, static_cast<std::uint32_t>(t));
    selected = hn::And(selected, hn::FirstN(d, end - t));
    const auto selected_lanes = hn::RebindMask(di, selected);
    hn::StoreU(hn::Compress(first, selected_lanes), di, &found.corner[0][found.count]);
    hn::StoreU(hn::Compress(second, selected_lanes), di, &found.corner[1][found.count]);
    hn::StoreU(hn::Compress(third, selected_lanes), di, &found.corner[2][found.count]);
    hn::StoreU(hn::Compress(numbers, hn::RebindMask(db, selected)), db, &found.number[found.count]);
    found.count += hn::CountTrue(d, selected);
  }
}

}  // namespace yars::model::hrm::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace yars::model::hrm::simd {

HWY_EXPORT(transform_vertices);
HWY_EXPORT(select_triangles);

void transform_vertices(std::size_t count, const TileVertices& tile, const VertexMap& map, const GridVertices& grid) {
  HWY_DYNAMIC_DISPATCH(transform_vertices)(count, tile, map, grid);
}
void select_triangles(std::size_t begin, std::size_t end, const Corners& corners, const GridVertices& grid,
                      const GridLimits& limits, FoundTriangles& found) {
  HWY_DYNAMIC_DISPATCH(select_triangles)(begin, end, corners, grid, limits, found);
}

}  // namespace yars::model::hrm::simd
#endif  // HWY_ONCE
