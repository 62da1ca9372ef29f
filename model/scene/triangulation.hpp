// Polygons in space to triangles. A convex polygon becomes a fan, a concave one is cut by its ears in the plane of its
// Newell normal; the turning sense is kept. Corners that coincide or lie on a line give no triangle.
// Self-crossing polygons give triangles that cover them somehow, never more than corners - 2.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "model/scene/affine.hpp"

namespace yars::model::scene {

// Twice the vector area: its direction is the side from which the corners turn counter-clockwise.
Vector3 newell_normal(std::span<const Vector3> corners);

// Triangles as numbers of corners; `found` is cleared first.
void triangulate(std::span<const Vector3> corners, std::vector<std::array<std::uint32_t, 3>>& found);

}  // namespace yars::model::scene
