#include "worldgen/scene/scene_builder.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "lib/geo/frames.hpp"
#include "model/scene/openflight/model.hpp"
#include "model/scene/placement/geometry.hpp"

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

namespace {

// Row of `count` windows on each long wall of a box around the z axis. Each window is a polygon 5 cm in front of the
// wall. `sill_m`: z of its lower edge.
void windows(MeshBuilder& mesh, double length_m, double depth_m, double sill_m, double height_m, int count) {
  const SurfaceKind saved = mesh.kind;
  mesh.kind = surface::kGlass;
  const double pitch = length_m / count;
  for (int i = 0; i < count; ++i) {
    const double x = -length_m / 2 + pitch * (i + 0.5), half = 0.32 * pitch, y = depth_m / 2 + 0.05;
    mesh.polygon({{x - half, -y, sill_m},
                  {x + half, -y, sill_m},
                  {x + half, -y, sill_m + height_m},
                  {x - half, -y, sill_m + height_m}});
    mesh.polygon({{x + half, y, sill_m},
                  {x - half, y, sill_m},
                  {x - half, y, sill_m + height_m},
                  {x + half, y, sill_m + height_m}});
  }
  mesh.kind = saved;
}

// Low wall around the edge of a flat roof at height `z`.
void parapet(MeshBuilder& mesh, double length_m, double depth_m, double z) {
  constexpr double kThickness_m = 0.4, kHeight_m = 1.0;
  for (const double side : {-1.0, 1.0}) {
    mesh.box({0, side * (depth_m - kThickness_m) / 2, z}, length_m, kThickness_m, kHeight_m);
    mesh.box({side * (length_m - kThickness_m) / 2, 0, z}, kThickness_m, depth_m - 2 * kThickness_m, kHeight_m);
  }
}

const SurfaceKind& random_wall(random::CounterRng& rng) {
  static constexpr std::array<SurfaceKind, 4> kWalls{surface::kStone, surface::kBrick, surface::kComposition,
                                                     surface::kBrick};
  return kWalls[static_cast<std::size_t>(rng.below(4))];
}

}  // namespace

void draw_conifer(MeshBuilder& mesh, double height_m, int sides) {
  mesh.kind = surface::kTrunk;
  mesh.revolve({0, 0, 0}, {0, 0, 1}, {{0, 0.25}, {0.15 * height_m, 0.22}}, 5);
  mesh.kind = surface::kNeedles;
  for (int tier = 0; tier < 3; ++tier) {
    const double foot = (0.12 + 0.25 * tier) * height_m, radius = (0.24 - 0.05 * tier) * height_m;
    mesh.revolve({0, 0, foot}, {0, 0, 1}, {{0, radius}, {tier == 2 ? height_m - foot : 0.42 * height_m, 0}}, sides);
  }
}

void draw_leafy_tree(MeshBuilder& mesh, double height_m, int sides) {
  mesh.kind = surface::kTrunk;
  mesh.revolve({0, 0, 0}, {0, 0, 1}, {{0, 0.3}, {0.3 * height_m, 0.25}}, 5);
  mesh.kind = surface::kLeaves;
  const double r = 0.32 * height_m;
  mesh.revolve({0, 0, 0.25 * height_m}, {0, 0, 1},
               {{0, 0}, {0.3 * r, 0.8 * r}, {r, r}, {1.8 * r, 0.7 * r}, {0.75 * height_m, 0}}, sides);
}

void draw_house(MeshBuilder& mesh, random::CounterRng& rng) {
  const double length = rng.uniform(9, 15), depth = rng.uniform(7, 10);
  const int storeys = 1 + rng.below(2);
  const double wall = 2.8 * storeys, rise = rng.uniform(2.2, 4.0);
  mesh.kind = random_wall(rng);
  mesh.box({0, 0, 0}, length, depth, wall);
  for (int storey = 0; storey < storeys; ++storey)
    windows(mesh, length, depth, 0.9 + 2.8 * storey, 1.3, 3 + rng.below(2));
  mesh.kind = rng.below(3) == 0 ? surface::kRoofing : surface::kTiles;
  mesh.gable({0, 0, wall}, length, depth, rise, 0.5);
  mesh.kind = surface::kBrick;
  mesh.box({length * 0.3, depth * 0.12, wall}, 0.8, 0.8, rise + 1.0);
  if (rng.below(2) == 0) {
    mesh.kind = surface::kTiles;
    const double x = -length * 0.2;
    mesh.box({x, -depth * 0.28, wall}, 1.8, depth * 0.3, 0.6 * rise);
  }
  if (rng.below(3) != 0) {
    mesh.kind = surface::kComposition;
    const double side = length / 2 + 1.8;
    mesh.box({side, 0, 0}, 3.6, 6.0, 2.6);
  }
}

void draw_block(MeshBuilder& mesh, random::CounterRng& rng) {
  const double length = rng.uniform(28, 60), depth = rng.uniform(11, 15);
  const int storeys = 4 + rng.below(6);
  const double height = 3.0 * storeys;
  mesh.kind = random_wall(rng);
  mesh.box({0, 0, 0}, length, depth, height);
  for (int storey = 0; storey < storeys; ++storey)
    windows(mesh, length, depth, 1.0 + 3.0 * storey, 1.4, static_cast<int>(length / 4.0));
  parapet(mesh, length, depth, height);
  mesh.kind = surface::kPartMetal;
  for (int head = 0; head < 3; ++head) mesh.box({length * (head - 1) / 3.2, 0, height}, 4.0, 3.5, 2.6);
}

void draw_tower(MeshBuilder& mesh, random::CounterRng& rng) {
  double length = rng.uniform(26, 40), depth = rng.uniform(24, 34), foot = 0;
  mesh.kind = surface::kStone;
  mesh.box({0, 0, 0}, length + 16, depth + 14, 7.0);
  foot = 7.0;
  mesh.kind = rng.below(2) == 0 ? surface::kPartMetal : surface::kComposition;
  for (int step = 0; step < 3; ++step) {
    const int storeys = 7 + rng.below(8);
    mesh.box({0, 0, foot}, length, depth, 3.6 * storeys);
    for (int storey = 0; storey < storeys; ++storey)
      windows(mesh, length, depth, foot + 3.6 * storey + 0.8, 2.2, static_cast<int>(length / 3.0));
    foot += 3.6 * storeys;
    parapet(mesh, length, depth, foot);
    length *= 0.78;
    depth *= 0.78;
  }
  mesh.kind = surface::kMetal;
  mesh.box({0, 0, foot}, 0.5 * length, 0.5 * depth, 5.0);
  mesh.cylinder({0, 0, foot + 5.0}, 0.4, 18.0, 8);
}

namespace {

// Half of a wing or of a tailplane. `side`: +1 left, -1 right. `root_x`, `tip_x`: x of the leading edge.
// Chord: distance from the leading to the trailing edge. The outline runs counter-clockwise seen from above.
void wing(MeshBuilder& mesh, double root_x, double root_chord, double tip_x, double tip_chord, double from_y,
          double to_y, double z, double thickness_m, double side) {
  std::vector<Vector3> outline{{root_x, side * from_y, z},
                               {tip_x, side * to_y, z},
                               {tip_x - tip_chord, side * to_y, z},
                               {root_x - root_chord, side * from_y, z}};
  if (side < 0) outline = {outline[3], outline[2], outline[1], outline[0]};
  mesh.plate(outline, thickness_m);
}

// Vertical tail fin from height `from_z` to `to_z`. `root_x`, `tip_x`: x of the leading edge.
void fin(MeshBuilder& mesh, double root_x, double root_chord, double tip_x, double tip_chord, double y, double from_z,
         double to_z) {
  mesh.plate({{root_x, y, from_z}, {tip_x, y, to_z}, {tip_x - tip_chord, y, to_z}, {root_x - root_chord, y, from_z}},
             0.25);
}

void wheels(MeshBuilder& mesh, double first_x, double last_x, int axles, double half_track_m, double radius_m) {
  const SurfaceKind saved = mesh.kind;
  mesh.kind = surface::kRoofing;
  for (int axle = 0; axle < axles; ++axle) {
    const double x = axles == 1 ? first_x : first_x + (last_x - first_x) * axle / (axles - 1);
    for (const double side : {-1.0, 1.0})
      mesh.revolve({x, side * half_track_m - 0.15, radius_m}, {0, 1, 0}, {{0, radius_m}, {0.3, radius_m}}, 8);
  }
  mesh.kind = saved;
}

}  // namespace

void draw_fighter(MeshBuilder& mesh, int sides) {
  mesh.kind = surface::kMetal;
  mesh.revolve({9.7, 0, 2.0}, {-1, 0, 0},
               {{0, 0}, {1.2, 0.35}, {3.0, 0.7}, {5.0, 0.9}, {8.0, 1.1}, {13.0, 1.1}, {17.0, 0.95}, {18.5, 0.8}},
               sides);
  for (const double side : {-1.0, 1.0}) {
    wing(mesh, 3.0, 8.0, -3.0, 2.2, 0.8, 6.5, 2.2, 0.25, side);
    wing(mesh, -4.5, 4.0, -7.5, 1.5, 0.8, 4.3, 2.0, 0.18, side);
    fin(mesh, -3.5, 4.5, -6.5, 1.8, side * 1.3, 2.6, 5.6);
    mesh.revolve({3.5, side * 1.5, 2.0}, {-1, 0, 0}, {{0, 0.6}, {5.0, 0.75}, {11.0, 0.65}}, sides);
    mesh.bar({-1.0, side * 1.4, 0.0}, {-1.0, side * 1.4, 1.4}, 0.25);
  }
  mesh.bar({6.0, 0, 0.0}, {6.0, 0, 1.5}, 0.2);
  mesh.kind = surface::kGlass;
  mesh.revolve({6.4, 0, 2.75}, {-1, 0, 0}, {{0, 0}, {0.8, 0.4}, {2.2, 0.5}, {4.0, 0}}, sides);
}

void draw_transport(MeshBuilder& mesh, int sides) {
  mesh.kind = surface::kWhite;
  mesh.revolve({18.0, 0, 3.6}, {-1, 0, 0},
               {{0, 0}, {1.0, 1.1}, {3.0, 1.9}, {6.0, 2.2}, {24.0, 2.2}, {31.0, 1.2}, {36.0, 0.4}}, 2 * sides);
  mesh.kind = surface::kMetal;
  for (const double side : {-1.0, 1.0}) {
    wing(mesh, 5.0, 6.5, -0.5, 2.0, 1.8, 17.5, 3.0, 0.5, side);
    wing(mesh, -12.5, 4.0, -15.5, 1.6, 0.6, 6.5, 4.4, 0.3, side);
    mesh.revolve({4.6, side * 5.8, 2.2}, {-1, 0, 0}, {{0, 0.9}, {1.5, 1.05}, {4.5, 0.6}}, sides);
    mesh.bar({0.5, side * 2.8, 0.0}, {0.5, side * 2.6, 2.8}, 0.4);
  }
  mesh.bar({14.0, 0, 0.0}, {14.0, 0, 2.2}, 0.3);
  mesh.kind = surface::kBlue;
  fin(mesh, -11.0, 6.5, -15.5, 2.5, 0.0, 5.2, 11.8);
}

void draw_truck(MeshBuilder& mesh, const SurfaceKind& body) {
  mesh.kind = body;
  mesh.box({2.6, 0, 0.7}, 1.8, 2.3, 1.9);
  mesh.box({-1.1, 0, 1.0}, 5.2, 2.4, 2.0);
  mesh.kind = surface::kDarkMetal;
  mesh.box({0.0, 0, 0.6}, 7.0, 0.9, 0.4);
  wheels(mesh, 2.6, -2.8, 3, 1.05, 0.5);
}

void draw_tanker(MeshBuilder& mesh, int sides) {
  mesh.kind = surface::kOlive;
  mesh.box({3.4, 0, 0.7}, 1.9, 2.4, 2.0);
  mesh.revolve({2.0, 0, 2.1}, {-1, 0, 0}, {{0, 0.6}, {0.3, 1.1}, {6.2, 1.1}, {6.5, 0.6}}, sides);
  mesh.kind = surface::kDarkMetal;
  mesh.box({-0.4, 0, 0.6}, 8.6, 0.9, 0.45);
  wheels(mesh, 3.4, -3.6, 4, 1.05, 0.5);
}

void draw_car(MeshBuilder& mesh, const SurfaceKind& body) {
  mesh.kind = body;
  mesh.box({0, 0, 0.35}, 4.3, 1.75, 0.6);
  const std::vector<Vector3> foot{{-1.6, -0.8, 0.95}, {1.0, -0.8, 0.95}, {1.0, 0.8, 0.95}, {-1.6, 0.8, 0.95}};
  const std::vector<Vector3> roof{{-1.2, -0.65, 1.5}, {0.3, -0.65, 1.5}, {0.3, 0.65, 1.5}, {-1.2, 0.65, 1.5}};
  mesh.kind = surface::kGlass;
  for (std::size_t i = 0; i < 4; ++i) mesh.polygon({foot[i], foot[(i + 1) % 4], roof[(i + 1) % 4], roof[i]});
  mesh.kind = body;
  mesh.polygon(roof);
}

}  // namespace yars::worldgen
