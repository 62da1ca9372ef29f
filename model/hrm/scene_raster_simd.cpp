#include "model/hrm/scene_raster_simd.hpp"

#include <algorithm>
#include <utility>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "model/hrm/scene_raster_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// These headers need the target (instruction set) that highway.h defines.
#include "model/hrm/facet-inl.hpp"
#include "model/hrm/small_triangles-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace yars::model::hrm::simd::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr float kWideColumns = 12.0F;  // [columns] wider triangles are drawn one by one; affects only speed

// Draws one triangle, one column per lane. In each column the triangle is extended by `reach` rows at both ends. Grid
// points beyond an edge get the height at that edge. With a reach of half a row (kSurfaceReach), the grid points drawn
// in a column span on average the distance between the edges.
// `put(at, column, row, wanted)` draws the lanes `wanted` of a vector of grid points. `row` is clamped to the edges.
template <class Put>
HWY_INLINE void fill_wide(const Triangle& triangle, const Canvas& canvas, float reach, const Put& put) {
  const Tag d;
  const PolarGrid& grid = *canvas.grid;
  const float first = std::max(hn::GetLane(hn::Ceil(triangle.left.column)), canvas.limits.first_column);
  const float last = std::min(hn::GetLane(hn::Ceil(triangle.right.column)), canvas.limits.last_column);
  if (!(first < last)) return;
  const auto lanes = static_cast<int>(hn::Lanes(d));
  const auto iota = hn::Iota(d, 0.0F);
  const Edges rows_at(triangle, &Corner::row);
  for (int start = static_cast<int>(first) / lanes * lanes; start < static_cast<int>(last); start += lanes) {
    const auto column = hn::Add(iota, set(static_cast<float>(start)));
    const auto active = hn::And(hn::Ge(column, set(first)), hn::Lt(column, set(last)));
    const auto [on_long_edge, on_short_edge] = rows_at.at(column);
    const auto near = hn::Min(on_long_edge, on_short_edge);
    const auto far = hn::Max(on_long_edge, on_short_edge);
    const auto begin = hn::IfThenElse(active, hn::Max(hn::Ceil(hn::Sub(near, set(reach))), hn::Zero(d)),
                                      set(static_cast<float>(grid.rows)));
    const auto end =
        hn::IfThenElseZero(active, hn::Min(hn::Ceil(hn::Add(far, set(reach))), set(static_cast<float>(grid.rows))));
    const auto from = static_cast<int>(hn::GetLane(hn::MinOfLanes(d, begin)));
    const auto to = static_cast<int>(hn::GetLane(hn::MaxOfLanes(d, end)));
    for (int line = from; line < to; ++line) {
      const auto row = set(static_cast<float>(line));
      put(grid.at(start, line), column, hn::Min(hn::Max(row, near), far),
          hn::And(hn::Ge(row, begin), hn::Lt(row, end)));
    }
  }
}

// Sets the surface labels of 16 grid points, or of as many as a vector has lanes.
HWY_INLINE void set_labels(const Canvas& canvas, std::size_t at, Mask drawn, std::uint32_t label) {
  if (canvas.arrays.label == nullptr) return;
  const BitsTag db;
  hn::BlendedStore(hn::Set(db, label), hn::RebindMask(db, drawn), db, canvas.arrays.label + at);
}

HWY_INLINE void draw_wide_surface(const Triangle& triangle, const Facet& facet, Floats gamma, std::uint32_t label,
                                  const Canvas& canvas) {
  const Tag d;
  const auto negative = hn::Neg(gamma);
  fill_wide(triangle, canvas, kSurfaceReach, [&](std::size_t at, Floats column, Floats row, Mask wanted) HWY_ATTR {
    const auto base = hn::Add(facet.value, hn::Mul(facet.by_column, column));
    const auto height = without_negative_zero(triangle.within(hn::Add(base, hn::Mul(facet.by_row, row))));
    auto* const points = &canvas.arrays.surface[at].gamma;
    Floats old_gamma, old_height;
    hn::LoadInterleaved2(d, points, old_gamma, old_height);
    // Compared as unsigned integers, negated gammas ascend with gamma and exceed the gamma of the ground.
    const auto stronger =
        hn::RebindMask(d, hn::Gt(hn::BitCast(BitsTag(), negative), hn::BitCast(BitsTag(), old_gamma)));
    const auto best = hn::Or(hn::Gt(height, old_height), hn::And(hn::Eq(height, old_height), stronger));
    const auto drawn = hn::And(wanted, best);
    hn::StoreInterleaved2(hn::IfThenElse(drawn, negative, old_gamma), hn::IfThenElse(drawn, height, old_height), d,
                          points);
    set_labels(canvas, at, drawn, label);
  });
}

HWY_INLINE Corner corner_of(const GridVertices& vertices, std::size_t i) {
  return {set(vertices.column[i]), set(vertices.row[i]), set(vertices.height_m[i])};
}

HWY_INLINE std::array<std::size_t, 3> corners_of(const FoundTriangles& triangles, std::size_t i) {
  const auto corner = [&](std::size_t k) { return static_cast<std::size_t>(triangles.corner[k][i]); };
  return {corner(0), corner(1), corner(2)};
}

// Sorts the corners from left to right.
HWY_INLINE Triangle ordered(Corner a, Corner b, Corner c) {
  order(a, b);
  order(b, c);
  order(a, b);
  return {a, b, c};
}

void paint_ground(const FoundTriangles& triangles, const TileSurfaces& tile, const GridVertices& vertices,
                  const Canvas& canvas) {
  const Tag d;
  for (std::size_t i = 0; i < triangles.count; ++i) {
    const std::array<std::size_t, 3> corners = corners_of(triangles, i);
    const Corner a = corner_of(vertices, corners[0]);
    const Corner b = corner_of(vertices, corners[1]);
    const Corner c = corner_of(vertices, corners[2]);
    const Facet facet = facet_of(a, b, c, canvas.limits);
    if (!hn::AllTrue(d, hn::Gt(facet.area, hn::Zero(d)))) continue;
    auto gamma = set(tile.gamma[tile.kind[triangles.number[i]]]);
    const std::uint32_t label = tile.label(triangles.number[i]);
    if (corners[0] >= vertices.first_with_normal) {
      const auto facing = [&](int k) HWY_ATTR { return set(vertices.facing[corners[k] - vertices.first_with_normal]); };
      gamma = hn::Mul(gamma, shading(facing(0), facing(1), facing(2), facet));
    }
    fill_wide(ordered(a, b, c), canvas, 0.0F, [&](std::size_t at, Floats, Floats, Mask wanted) HWY_ATTR {
      auto* const points = &canvas.arrays.surface[at].gamma;
      Floats old, height;
      hn::LoadInterleaved2(d, points, old, height);
      const auto drawn = hn::And(wanted, hn::Ge(old, hn::Zero(d)));
      hn::StoreInterleaved2(hn::IfThenElse(drawn, gamma, old), height, d, points);
      set_labels(canvas, at, drawn, label);
    });
  }
}

// Vertex indices of the corners, for one vector of triangles.
struct CornerNumbers {
  hn::Vec<SignedTag> first, second, third;
};
HWY_INLINE CornerNumbers numbers_at(const FoundTriangles& triangles, std::size_t i) {
  const SignedTag di;
  return {hn::LoadU(di, &triangles.corner[0][i]), hn::LoadU(di, &triangles.corner[1][i]),
          hn::LoadU(di, &triangles.corner[2][i])};
}
HWY_INLINE Corner gather(const GridVertices& vertices, hn::Vec<SignedTag> i) {
  const Tag d;
  return {hn::GatherIndex(d, vertices.column, i), hn::GatherIndex(d, vertices.row, i),
          hn::GatherIndex(d, vertices.height_m, i)};
}

// Gamma, multiplied by the factor of shading() in the lanes whose triangles have vertex normals.
HWY_INLINE Floats shaded(Floats gamma, const GridVertices& vertices, const CornerNumbers& corners, const Facet& facet) {
  const Tag d;
  const SignedTag di;
  const auto first_with_normal = hn::Set(di, static_cast<std::int32_t>(vertices.first_with_normal));
  const auto with_normals = hn::Gt(corners.first, hn::Sub(first_with_normal, hn::Set(di, 1)));
  if (hn::AllFalse(di, with_normals)) return gamma;
  const auto facing = [&](hn::Vec<SignedTag> corner) HWY_ATTR {
    return hn::GatherIndex(d, vertices.facing, hn::Max(hn::Sub(corner, first_with_normal), hn::Zero(di)));
  };
  const auto factor = shading(facing(corners.first), facing(corners.second), facing(corners.third), facet);
  return hn::IfThenElse(hn::RebindMask(d, with_normals), hn::Mul(gamma, factor), gamma);
}

// Draws those triangles of one vector that are wide (mask `wide`), one by one.
void draw_wide(const FoundTriangles& triangles, std::size_t first, const float* gamma, const std::uint32_t* label,
               Mask wide, const GridVertices& vertices, const Canvas& canvas) {
  const Tag d;
  HWY_ALIGN float which[kStripColumns];
  hn::Store(hn::IfThenElseZero(wide, set(1.0F)), d, which);
  for (std::size_t lane = 0; lane < hn::Lanes(d); ++lane) {
    if (which[lane] == 0.0F) continue;
    const std::array<std::size_t, 3> corners = corners_of(triangles, first + lane);
    const Corner a = corner_of(vertices, corners[0]);
    const Corner b = corner_of(vertices, corners[1]);
    const Corner c = corner_of(vertices, corners[2]);
    draw_wide_surface(ordered(a, b, c), facet_of(a, b, c, canvas.limits), set(gamma[lane]), label[lane], canvas);
  }
}

void draw_standing(const FoundTriangles& triangles, const TileSurfaces& tile, const GridVertices& vertices,
                   const Canvas& canvas, Fragments& fragments) {
  const Tag d;
  SmallTriangles small(canvas, fragments);
  const bool labels = canvas.arrays.label != nullptr;
  HWY_ALIGN float gamma[kStripColumns] = {};
  HWY_ALIGN float cardinal[kStripColumns] = {};
  HWY_ALIGN std::uint32_t label[kStripColumns] = {};
  const std::size_t step = hn::Lanes(d);
  for (std::size_t i = 0; i < triangles.count; i += step) {
    const std::size_t count = std::min(step, triangles.count - i);
    for (std::size_t lane = 0; lane < count; ++lane) {
      const std::size_t kind = tile.kind[triangles.number[i + lane]];
      gamma[lane] = tile.gamma[kind];
      cardinal[lane] = tile.cardinal[kind];
      if (labels) label[lane] = tile.label(triangles.number[i + lane]);
    }
    // Lanes beyond the last triangle contain zeros or corners of other triangles. Both are valid vertex indices. These
    // lanes are masked out.
    const auto valid = hn::FirstN(d, count);
    const CornerNumbers corners = numbers_at(triangles, i);
    const Corner a = gather(vertices, corners.first);
    const Corner b = gather(vertices, corners.second);
    const Corner c = gather(vertices, corners.third);
    const Facet facet = facet_of(a, b, c, canvas.limits);
    const Triangle triangle = ordered(a, b, c);
    const auto wall = hn::And(valid, hn::And(facet.steep, hn::Gt(facet.towards, hn::Zero(d))));
    if (!hn::AllFalse(d, wall))
      small.draw_walls(triangle, wall_gamma(canvas.cardinal, facet, hn::Load(d, gamma), hn::Load(d, cardinal)), label,
                       wall);
    const auto above = hn::And(valid, hn::Gt(facet.area, hn::Zero(d)));
    if (hn::AllFalse(d, above)) continue;
    const auto shaded_gamma = shaded(hn::Load(d, gamma), vertices, corners, facet);
    const auto wide = hn::And(above, hn::Gt(hn::Sub(triangle.right.column, triangle.left.column), set(kWideColumns)));
    small.draw_surfaces(triangle, facet, shaded_gamma, label, hn::AndNot(wide, above));
    small.flush(false);
    if (hn::AllFalse(d, wide)) continue;
    HWY_ALIGN float gammas[kStripColumns];
    hn::Store(shaded_gamma, d, gammas);
    draw_wide(triangles, i, gammas, label, wide, vertices, canvas);
  }
  small.flush(true);
}

}  // namespace yars::model::hrm::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace yars::model::hrm::simd {

HWY_EXPORT(paint_ground);
HWY_EXPORT(draw_standing);

void paint_ground(const FoundTriangles& triangles, const TileSurfaces& tile, const GridVertices& vertices,
                  const Canvas& canvas) {
  HWY_DYNAMIC_DISPATCH(paint_ground)(triangles, tile, vertices, canvas);
}
void draw_standing(const FoundTriangles& triangles, const TileSurfaces& tile, const GridVertices& vertices,
                   const Canvas& canvas, Fragments& fragments) {
  HWY_DYNAMIC_DISPATCH(draw_standing)(triangles, tile, vertices, canvas, fragments);
}

}  // namespace yars::model::hrm::simd
#endif  // HWY_ONCE
