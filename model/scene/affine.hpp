// Affine maps of space as OpenFlight writes them: row vectors, so that p * a * b applies a first.
#pragma once

#include <cmath>

#include "lib/geo/vector.hpp"

namespace yars::model::scene {

using geo::Vector3;

struct Affine {
  Vector3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};  // where the axes go
  Vector3 offset{};

  Vector3 apply(Vector3 p) const { return p.x * x + p.y * y + p.z * z + offset; }
  Vector3 turn(Vector3 v) const { return v.x * x + v.y * y + v.z * z; }
  double determinant() const { return dot(cross(x, y), z); }
  // Normals go by the cofactors: at right angles to the surface whatever the scales; not of unit length; a mirror keeps
  // them on the same side of the surface.
  Vector3 turn_normal(Vector3 n) const {
    const double side = determinant() < 0.0 ? -1.0 : 1.0;
    return side * (n.x * cross(y, z) + n.y * cross(z, x) + n.z * cross(x, y));
  }

  static Affine translation(Vector3 by) { return {.offset = by}; }
  // About the vertical axis, counter-clockwise seen from above.
  static Affine turn_about_up(double radians) {
    const double c = std::cos(radians);
    const double s = std::sin(radians);
    return {.x = {c, s, 0}, .y = {-s, c, 0}};
  }
  static Affine scale(Vector3 by) { return {.x = {by.x, 0, 0}, .y = {0, by.y, 0}, .z = {0, 0, by.z}}; }
};

// First a, then b.
inline Affine operator*(const Affine& a, const Affine& b) {
  return {b.turn(a.x), b.turn(a.y), b.turn(a.z), b.apply(a.offset)};
}

}  // namespace yars::model::scene
