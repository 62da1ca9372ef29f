#include "worldgen/scene/scene_builder.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "lib/geo/frames.hpp"
#include "model/scene/openflight/model.hpp"
#include "model/scene/placement/plan_geometry.hpp"

namespace yars::worldgen {

namespace {

Vector3 unit(Vector3 v) {
  const double size = length(v);
  return size > 0.0 ? (1.0 / size) * v : v;
}

// Two unit vectors perpendicular to the unit vector `axis`. First, second and `axis`, in this order, form a
// right-handed frame.
std::pair<Vector3, Vector3> across(Vector3 axis) {
  const Vector3 helper = std::abs(axis.z) < 0.9 ? Vector3{0, 0, 1} : Vector3{1, 0, 0};
  const Vector3 first = unit(cross(helper, axis));
  return {first, cross(axis, first)};
}

}  // namespace

void MeshBuilder::emit(const std::vector<WriterVertex>& corners, bool two_sided) {
  std::vector<WriterVertex> placed;
  placed.reserve(corners.size());
  for (const WriterVertex& corner : corners)
    placed.push_back({transformed_point(map, corner.position), unit(transformed_normal(map, corner.normal))});
  out_.face(placed, kind, two_sided);
  triangles_ += (corners.size() - 2) * (two_sided ? 2 : 1);
}

void MeshBuilder::polygon(const std::vector<Vector3>& corners, bool two_sided) {
  const Vector3 normal = unit(model::scene::newell_normal(corners));
  std::vector<WriterVertex> vertices;
  vertices.reserve(corners.size());
  for (const Vector3& corner : corners) vertices.push_back({corner, normal});
  emit(vertices, two_sided);
}

void MeshBuilder::box(Vector3 base, double east_m, double north_m, double height_m) {
  const double x = east_m / 2, y = north_m / 2;
  prism({base + Vector3{-x, -y, 0}, base + Vector3{x, -y, 0}, base + Vector3{x, y, 0}, base + Vector3{-x, y, 0}},
        height_m);
}

void MeshBuilder::prism(const std::vector<Vector3>& outline, double height_m) {
  const Vector3 up{0, 0, height_m};
  std::vector<Vector3> top;
  top.reserve(outline.size());
  for (const Vector3& corner : outline) top.push_back(corner + up);
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const std::size_t next = (i + 1) % outline.size();
    polygon({outline[i], outline[next], top[next], top[i]});
  }
  polygon(top);
}

void MeshBuilder::gable(Vector3 eaves, double east_m, double north_m, double rise_m, double overhang_m) {
  const double x = east_m / 2 + overhang_m, y = north_m / 2 + overhang_m, wall = north_m / 2;
  const double drop = rise_m * overhang_m / wall;  // the slope continues below the top of the wall
  const Vector3 west_ridge = eaves + Vector3{-x, 0, rise_m}, east_ridge = eaves + Vector3{x, 0, rise_m};
  polygon({eaves + Vector3{-x, -y, -drop}, eaves + Vector3{x, -y, -drop}, east_ridge, west_ridge});
  polygon({eaves + Vector3{x, y, -drop}, eaves + Vector3{-x, y, -drop}, west_ridge, east_ridge});
  const double end = east_m / 2;
  polygon({eaves + Vector3{end, -wall, 0}, eaves + Vector3{end, wall, 0}, eaves + Vector3{end, 0, rise_m}});
  polygon({eaves + Vector3{-end, wall, 0}, eaves + Vector3{-end, -wall, 0}, eaves + Vector3{-end, 0, rise_m}});
}

void MeshBuilder::revolve(Vector3 from, Vector3 axis, const std::vector<ProfilePoint>& profile, int sides) {
  const std::pair<Vector3, Vector3> sideways = across(axis);
  const auto around = [&](int side) {
    const double angle = 2 * std::numbers::pi * (side % sides) / sides;
    return std::cos(angle) * sideways.first + std::sin(angle) * sideways.second;
  };
  const auto at = [&](ProfilePoint point, int side) {
    return from + point.along_m * axis + point.radius_m * around(side);
  };
  for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
    const ProfilePoint a = profile[i], b = profile[i + 1];
    const auto normal = [&](int side) {
      return unit((b.along_m - a.along_m) * around(side) + (a.radius_m - b.radius_m) * axis);
    };
    for (int side = 0; side < sides; ++side) {
      std::vector<WriterVertex> corners{{at(a, side), normal(side)}};
      if (a.radius_m > 0.0) corners.push_back({at(a, side + 1), normal(side + 1)});
      if (b.radius_m > 0.0) corners.push_back({at(b, side + 1), normal(side + 1)});
      corners.push_back({at(b, side), normal(side)});
      if (corners.size() >= 3) emit(corners, false);
    }
  }
  std::vector<Vector3> front, back;
  for (int side = 0; side < sides; ++side) {
    front.push_back(at(profile.front(), sides - side));
    back.push_back(at(profile.back(), side));
  }
  if (profile.front().radius_m > 0.0) polygon(front);
  if (profile.back().radius_m > 0.0) polygon(back);
}

void MeshBuilder::cylinder(Vector3 base, double radius_m, double height_m, int sides) {
  revolve(base, {0, 0, 1}, {{0, radius_m}, {height_m, radius_m}}, sides);
}

void MeshBuilder::bar(Vector3 from, Vector3 to, double side_m) {
  const auto [u, v] = across(unit(to - from));
  const Vector3 a = (side_m / 2) * u, b = (side_m / 2) * v;
  const std::vector<Vector3> ring{-1.0 * a - b, a - b, a + b, b - a};
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t next = (i + 1) % 4;
    polygon({from + ring[i], from + ring[next], to + ring[next], to + ring[i]});
  }
}

void MeshBuilder::plate(const std::vector<Vector3>& outline, double thickness_m) {
  const Vector3 half = (thickness_m / 2) * unit(model::scene::newell_normal(outline));
  std::vector<Vector3> top, bottom;
  top.reserve(outline.size());
  bottom.reserve(outline.size());
  for (const Vector3& corner : outline) top.push_back(corner + half);
  for (auto corner = outline.rbegin(); corner != outline.rend(); ++corner) bottom.push_back(*corner - half);
  polygon(top);
  polygon(bottom);
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vector3 &a = outline[i], &b = outline[(i + 1) % outline.size()];
    polygon({a - half, b - half, b + half, a + half});
  }
}

void MeshBuilder::bank(Vector3 from, Vector3 to, double foot_m, double top_m, double height_m) {
  const Vector3 along = unit(to - from);
  const Vector3 left{-along.y, along.x, 0};
  const Vector3 up{0, 0, height_m};
  const Vector3 foot = (foot_m / 2) * left, top = (top_m / 2) * left;
  polygon({from - foot, to - foot, to - top + up, from - top + up});
  polygon({to + foot, from + foot, from + top + up, to + top + up});
  polygon({from - top + up, to - top + up, to + top + up, from + top + up});
  polygon({from + foot, from - foot, from - top + up, from + top + up});
  polygon({to - foot, to + foot, to + top + up, to - top + up});
}

GeneratedScene generate_scene(const SceneRequest& request, const GenerationProgress& progress) {
  SceneBuilder builder(request, progress);
  // In the order of GeneratedKind.
  constexpr std::array kGenerate{generate_airfield, generate_harbour, generate_bridge, generate_town};
  kGenerate[static_cast<std::size_t>(request.kind)](builder);
  const geo::AzimuthalEquidistant plane(request.origin);
  builder.out.set_corners(plane.geodetic_from_plane({-builder.half_side_m, -builder.half_side_m}),
                          plane.geodetic_from_plane({builder.half_side_m, builder.half_side_m}));
  return {builder.out.take(), builder.triangles()};
}

}  // namespace yars::worldgen
