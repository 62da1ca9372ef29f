#include "worldgen/scene/scene_parts.hpp"

#include <array>

#include "lib/geo/frames.hpp"

namespace yars::worldgen {

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
