#include "model/scene/generator_parts.hpp"

namespace yars::model::scene {

namespace {

// A wing on one side (+1 left, -1 right), its outline turned so that its upper side looks up.
void wing(Sketch& sketch, double root_x, double root_chord, double tip_x, double tip_chord, double from_y, double to_y,
          double z, double thickness_m, double side) {
  std::vector<Vector3> outline{{root_x, side * from_y, z},
                               {tip_x, side * to_y, z},
                               {tip_x - tip_chord, side * to_y, z},
                               {root_x - root_chord, side * from_y, z}};
  if (side < 0) outline = {outline[3], outline[2], outline[1], outline[0]};
  sketch.plate(outline, thickness_m);
}

void fin(Sketch& sketch, double root_x, double root_chord, double tip_x, double tip_chord, double y, double from_z,
         double to_z) {
  sketch.plate({{root_x, y, from_z}, {tip_x, y, to_z}, {tip_x - tip_chord, y, to_z}, {root_x - root_chord, y, from_z}},
               0.25);
}

void wheels(Sketch& sketch, double first_x, double last_x, int axles, double half_track_m, double radius_m) {
  const SurfaceKind before = sketch.kind;
  sketch.kind = surface::kRoofing;
  for (int axle = 0; axle < axles; ++axle) {
    const double x = axles == 1 ? first_x : first_x + (last_x - first_x) * axle / (axles - 1);
    for (const double side : {-1.0, 1.0})
      sketch.turned({x, side * half_track_m - 0.15, radius_m}, {0, 1, 0}, {{0, radius_m}, {0.3, radius_m}}, 8);
  }
  sketch.kind = before;
}

}  // namespace

void draw_fighter(Sketch& sketch, int sides) {
  sketch.kind = surface::kMetal;
  sketch.turned({9.7, 0, 2.0}, {-1, 0, 0},
                {{0, 0}, {1.2, 0.35}, {3.0, 0.7}, {5.0, 0.9}, {8.0, 1.1}, {13.0, 1.1}, {17.0, 0.95}, {18.5, 0.8}},
                sides);
  for (const double side : {-1.0, 1.0}) {
    wing(sketch, 3.0, 8.0, -3.0, 2.2, 0.8, 6.5, 2.2, 0.25, side);
    wing(sketch, -4.5, 4.0, -7.5, 1.5, 0.8, 4.3, 2.0, 0.18, side);
    fin(sketch, -3.5, 4.5, -6.5, 1.8, side * 1.3, 2.6, 5.6);
    sketch.turned({3.5, side * 1.5, 2.0}, {-1, 0, 0}, {{0, 0.6}, {5.0, 0.75}, {11.0, 0.65}}, sides);
    sketch.bar({-1.0, side * 1.4, 0.0}, {-1.0, side * 1.4, 1.4}, 0.25);
  }
  sketch.bar({6.0, 0, 0.0}, {6.0, 0, 1.5}, 0.2);
  sketch.kind = surface::kGlass;
  sketch.turned({6.4, 0, 2.75}, {-1, 0, 0}, {{0, 0}, {0.8, 0.4}, {2.2, 0.5}, {4.0, 0}}, sides);
}

void draw_transport(Sketch& sketch, int sides) {
  sketch.kind = surface::kWhite;
  sketch.turned({18.0, 0, 3.6}, {-1, 0, 0},
                {{0, 0}, {1.0, 1.1}, {3.0, 1.9}, {6.0, 2.2}, {24.0, 2.2}, {31.0, 1.2}, {36.0, 0.4}}, 2 * sides);
  sketch.kind = surface::kMetal;
  for (const double side : {-1.0, 1.0}) {
    wing(sketch, 5.0, 6.5, -0.5, 2.0, 1.8, 17.5, 3.0, 0.5, side);
    wing(sketch, -12.5, 4.0, -15.5, 1.6, 0.6, 6.5, 4.4, 0.3, side);
    sketch.turned({4.6, side * 5.8, 2.2}, {-1, 0, 0}, {{0, 0.9}, {1.5, 1.05}, {4.5, 0.6}}, sides);
    sketch.bar({0.5, side * 2.8, 0.0}, {0.5, side * 2.6, 2.8}, 0.4);
  }
  sketch.bar({14.0, 0, 0.0}, {14.0, 0, 2.2}, 0.3);
  sketch.kind = surface::kBlue;
  fin(sketch, -11.0, 6.5, -15.5, 2.5, 0.0, 5.2, 11.8);
}

void draw_truck(Sketch& sketch, const SurfaceKind& body) {
  sketch.kind = body;
  sketch.box({2.6, 0, 0.7}, 1.8, 2.3, 1.9);
  sketch.box({-1.1, 0, 1.0}, 5.2, 2.4, 2.0);
  sketch.kind = surface::kDarkMetal;
  sketch.box({0.0, 0, 0.6}, 7.0, 0.9, 0.4);
  wheels(sketch, 2.6, -2.8, 3, 1.05, 0.5);
}

void draw_tanker(Sketch& sketch, int sides) {
  sketch.kind = surface::kOlive;
  sketch.box({3.4, 0, 0.7}, 1.9, 2.4, 2.0);
  sketch.turned({2.0, 0, 2.1}, {-1, 0, 0}, {{0, 0.6}, {0.3, 1.1}, {6.2, 1.1}, {6.5, 0.6}}, sides);
  sketch.kind = surface::kDarkMetal;
  sketch.box({-0.4, 0, 0.6}, 8.6, 0.9, 0.45);
  wheels(sketch, 3.4, -3.6, 4, 1.05, 0.5);
}

void draw_car(Sketch& sketch, const SurfaceKind& body) {
  sketch.kind = body;
  sketch.box({0, 0, 0.35}, 4.3, 1.75, 0.6);
  const std::vector<Vector3> foot{{-1.6, -0.8, 0.95}, {1.0, -0.8, 0.95}, {1.0, 0.8, 0.95}, {-1.6, 0.8, 0.95}};
  const std::vector<Vector3> roof{{-1.2, -0.65, 1.5}, {0.3, -0.65, 1.5}, {0.3, 0.65, 1.5}, {-1.2, 0.65, 1.5}};
  sketch.kind = surface::kGlass;
  for (std::size_t i = 0; i < 4; ++i) sketch.polygon({foot[i], foot[(i + 1) % 4], roof[(i + 1) % 4], roof[i]});
  sketch.kind = body;
  sketch.polygon(roof);
}

}  // namespace yars::model::scene
