#include "model/scene/triangulation.hpp"

#include <cmath>

namespace yars::model::scene {

namespace {

struct Flat {
  double u = 0.0, v = 0.0;
};

double turn(Flat a, Flat b, Flat c) {
  return (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u);
}

// Along the axis that the normal is nearest to, with the turning sense kept.
std::vector<Flat> flattened(std::span<const Vector3> corners, Vector3 normal) {
  std::vector<Flat> flat;
  flat.reserve(corners.size());
  const double x = std::abs(normal.x), y = std::abs(normal.y), z = std::abs(normal.z);
  for (const Vector3& corner : corners) {
    if (z >= x && z >= y)
      flat.push_back(normal.z > 0 ? Flat{corner.x, corner.y} : Flat{corner.y, corner.x});
    else if (x >= y)
      flat.push_back(normal.x > 0 ? Flat{corner.y, corner.z} : Flat{corner.z, corner.y});
    else
      flat.push_back(normal.y > 0 ? Flat{corner.z, corner.x} : Flat{corner.x, corner.z});
  }
  return flat;
}

bool is_convex(const std::vector<Flat>& flat) {
  const std::size_t n = flat.size();
  for (std::size_t i = 0; i < n; ++i)
    if (turn(flat[i], flat[(i + 1) % n], flat[(i + 2) % n]) < 0.0) return false;
  return true;
}

bool inside(Flat p, Flat a, Flat b, Flat c) {
  return turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0;
}

bool same(Flat a, Flat b) {
  return a.u == b.u && a.v == b.v;
}

// The corner in the middle of (a, b, c) can be cut off: it turns left and no other corner lies in the cut.
bool is_ear(const std::vector<Flat>& flat, const std::vector<std::uint32_t>& ring, std::size_t at) {
  const std::size_t n = ring.size();
  const Flat a = flat[ring[(at + n - 1) % n]], b = flat[ring[at]], c = flat[ring[(at + 1) % n]];
  if (turn(a, b, c) <= 0.0) return false;
  for (const std::uint32_t other : ring) {
    const Flat p = flat[other];
    if (same(p, a) || same(p, b) || same(p, c)) continue;
    if (inside(p, a, b, c)) return false;
  }
  return true;
}

void clip_ears(const std::vector<Flat>& flat, std::vector<std::array<std::uint32_t, 3>>& found) {
  std::vector<std::uint32_t> ring(flat.size());
  for (std::size_t i = 0; i < ring.size(); ++i) ring[i] = static_cast<std::uint32_t>(i);
  std::size_t at = 0;
  std::size_t refused = 0;  // corners in a row that are no ears
  while (ring.size() > 3) {
    const std::size_t n = ring.size();
    at %= n;
    // A ring without ears crosses itself; any corner is as good as another then.
    if (refused < n && !is_ear(flat, ring, at)) {
      ++refused;
      ++at;
      continue;
    }
    found.push_back({ring[(at + n - 1) % n], ring[at], ring[(at + 1) % n]});
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(at));
    at = at == 0 ? 0 : at - 1;
    refused = 0;
  }
  found.push_back({ring[0], ring[1], ring[2]});
}

}  // namespace

Vector3 newell_normal(std::span<const Vector3> corners) {
  // About the first corner: far from the origin the products would lose what counts.
  Vector3 sum;
  for (std::size_t i = 2; i < corners.size(); ++i)
    sum = sum + cross(corners[i - 1] - corners[0], corners[i] - corners[0]);
  return sum;
}

void triangulate(std::span<const Vector3> corners, std::vector<std::array<std::uint32_t, 3>>& found) {
  found.clear();
  // Cutting ears takes time with the square of the corners (and more); a longer outline is damage, and a fan does.
  constexpr std::size_t kMostEars = 512;
  if (corners.size() < 3) return;
  if (corners.size() == 3) {
    found.push_back({0, 1, 2});
    return;
  }
  const Vector3 normal = newell_normal(corners);
  if (dot(normal, normal) == 0.0) return;
  const std::vector<Flat> flat = flattened(corners, normal);
  if (corners.size() > kMostEars || is_convex(flat)) {
    for (std::uint32_t i = 2; i < corners.size(); ++i) found.push_back({0, i - 1, i});
    return;
  }
  clip_ears(flat, found);
}

}  // namespace yars::model::scene
