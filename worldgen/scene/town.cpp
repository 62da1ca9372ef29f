#include <algorithm>
#include <array>

#include "lib/geo/frames.hpp"
#include "worldgen/scene/scene_builder.hpp"

namespace yars::worldgen {

namespace {

// Town scene, made of quarters. A quarter is the rectangle between the centre lines of four streets.
// Streets are kStreet_m wide.
constexpr double kQuarterX_m = 120, kQuarterY_m = 76, kStreet_m = 11;
// Number of definitions of each kind of object. Below: the number of the first definition of each kind.
constexpr int kHouses = 24, kBlocks = 8, kTowers = 4, kTrees = 4, kCars = 4;
constexpr std::uint16_t kFirstHouse = 1, kFirstBlock = 101, kFirstTower = 201, kFirstTree = 301, kFirstCar = 401;

class TownScene {
 public:
  explicit TownScene(SceneBuilder& builder) : builder_(builder) {}

  void make() {
    builder_.turn(0.5);
    define();
    // Quarters are added ring by ring from the centre, up to the requested number of triangles.
    for (int ring = 0; !builder_.is_full(); ++ring) {
      for (int y = -ring; y <= ring && !builder_.is_full(); ++y)
        for (int x = -ring; x <= ring && !builder_.is_full(); ++x)
          if (std::max(std::abs(x), std::abs(y)) == ring) quarter(x, y, ring);
      builder_.half_side_m = (ring + 1) * kQuarterX_m * 1.5;
    }
  }

 private:
  // Draws `count` definitions with the numbers from `first` on.
  template <class Draw>
  void define_each(std::uint16_t first, int count, const std::string& name, const Draw& draw) {
    for (int i = 0; i < count; ++i) {
      const auto number = static_cast<std::uint16_t>(first + i);
      sizes_.resize(std::max<std::size_t>(sizes_.size(), number + std::size_t{1}));
      sizes_[number] = builder_.define(number, [&](MeshBuilder& definition) {
        builder_.out.begin_object(name + std::to_string(i));
        draw(definition, i);
        builder_.out.end();
      });
    }
  }

  void define() {
    builder_.out.begin_group("definitions");
    define_each(kFirstHouse, kHouses, "house", [&](MeshBuilder& s, int) { draw_house(s, builder_.rng); });
    define_each(kFirstBlock, kBlocks, "flats", [&](MeshBuilder& s, int) { draw_block(s, builder_.rng); });
    define_each(kFirstTower, kTowers, "tower", [&](MeshBuilder& s, int) { draw_tower(s, builder_.rng); });
    define_each(kFirstTree, kTrees, "tree", [&](MeshBuilder& s, int i) {
      const int sides = 5 + i;
      if (i % 2 == 0)
        draw_conifer(s, 9.0 + i, sides);
      else
        draw_leafy_tree(s, 8.0 + i, sides);
    });
    define_each(kFirstCar, kCars, "car", [&](MeshBuilder& s, int i) {
      static constexpr std::array<SurfaceKind, kCars> kPaints{surface::kRed, surface::kBlue, surface::kWhite,
                                                              surface::kDarkMetal};
      draw_car(s, kPaints[static_cast<std::size_t>(i)]);
    });
    builder_.out.end();
  }

  void add_random_instance(std::uint16_t first, int count, double x, double y, double turn_deg) {
    const auto number = static_cast<std::uint16_t>(first + builder_.rng.below(count));
    // Random scales make the instances of one definition differ.
    const Vector3 by{builder_.rng.uniform(0.9, 1.1), builder_.rng.uniform(0.9, 1.1), builder_.rng.uniform(0.85, 1.15)};
    builder_.add_instance(number, sizes_[number], pose(x, y, turn_deg) * scaling(by));
  }

  void quarter(int column, int row, int ring) {
    const double x = column * kQuarterX_m, y = row * kQuarterY_m;
    builder_.out.begin_group("quarter");
    streets(x, y);
    const double from_centre_m = std::hypot(x, y);
    const int percent = builder_.rng.below(100);  // random number that selects the kind of quarter
    if (ring > 1 && percent < 6)
      park(x, y);
    else if (from_centre_m < 300 && percent < 60)
      add_random_instance(kFirstTower, kTowers, x, y, 90.0 * builder_.rng.below(4));
    else if (from_centre_m < 900 && percent < 45)
      flats(x, y);
    else
      houses(x, y);
    cars(x, y);
    builder_.out.end();
  }

  // The western and the southern street of a quarter.
  void streets(double x, double y) {
    const double w = x - kQuarterX_m / 2, s = y - kQuarterY_m / 2, half = kStreet_m / 2;
    builder_.object("street", surface::kAsphalt, [&](MeshBuilder& mesh) {
      const auto strip = [&mesh](double x0, double x1, double y0, double y1) {
        mesh.polygon({{x0, y0, kPaved_m}, {x1, y0, kPaved_m}, {x1, y1, kPaved_m}, {x0, y1, kPaved_m}});
      };
      strip(w - half, w + half, s - half, s + kQuarterY_m - half);
      strip(w + half, w + kQuarterX_m - half, s - half, s + half);
    });
  }

  void houses(double x, double y) {
    for (int row = 0; row < 2; ++row)
      for (int lot = 0; lot < 5; ++lot) {
        const double side = row == 0 ? -1.0 : 1.0;
        const double at_x = x + (lot - 2) * 21.0 + builder_.rng.uniform(-1.5, 1.5);
        const double at_y = y + side * builder_.rng.uniform(15.0, 18.0);
        add_random_instance(kFirstHouse, kHouses, at_x, at_y, (row == 0 ? 0.0 : 180.0) + builder_.rng.uniform(-4, 4));
        if (builder_.rng.below(2) != 0) continue;
        const double behind_m = builder_.rng.uniform(3, 8), beside_m = builder_.rng.uniform(-8, 8);
        add_random_instance(kFirstTree, kTrees, at_x + beside_m, y + side * behind_m, 0);
      }
  }

  void flats(double x, double y) {
    for (const double side : {-1.0, 1.0})
      for (const double along : {-1.0, 1.0})
        add_random_instance(kFirstBlock, kBlocks, x + along * 27, y + side * 18, side < 0 ? 0 : 180);
    for (int tree = 0; tree < 4; ++tree) add_random_instance(kFirstTree, kTrees, x - 40 + 25 * tree, y, 0);
  }

  void park(double x, double y) {
    for (int tree = 0; tree < 30; ++tree) {
      const double along_y_m = builder_.rng.uniform(-28, 28), along_x_m = builder_.rng.uniform(-50, 50);
      add_random_instance(kFirstTree, kTrees, x + along_x_m, y + along_y_m, 0);
    }
  }

  void cars(double x, double y) {
    const double s = y - kQuarterY_m / 2;
    for (int lot = 0; lot < 12; ++lot)
      if (builder_.rng.below(3) == 0)
        add_random_instance(kFirstCar, kCars, x - 50 + 8.0 * lot, s + (builder_.rng.below(2) == 0 ? 4.2 : -4.2), 0);
  }

  SceneBuilder& builder_;
  std::vector<std::uint64_t> sizes_;  // number of triangles of each definition
};

}  // namespace

void generate_town(SceneBuilder& builder) {
  TownScene(builder).make();
}

}  // namespace yars::worldgen
