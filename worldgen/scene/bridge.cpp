#include <numbers>

#include "lib/geo/frames.hpp"
#include "worldgen/scene/scene_builder.hpp"

namespace yars::worldgen {

namespace {

// Bridge scene: five spans of metal trusses on stone piers, with stone arches and ramps at both ends. The road runs
// along x. The river runs along y below the centre of the bridge. z = 0 is the height of the water and of the banks.
constexpr double kSpan_m = 80, kDeck_m = 14, kDeckWidth_m = 13, kTruss_m = 10, kRamp_m = 260;
constexpr int kSpans = 5;
constexpr double kHalf_m = kSpan_m * kSpans / 2;

class BridgeScene {
 public:
  explicit BridgeScene(SceneBuilder& builder) : builder_(builder), mesh_(builder.mesh) {}

  void make() {
    builder_.half_side_m = 3000;
    builder_.turn(0.0);
    define();
    // The bridge is one object, so that it stays level over uneven ground.
    builder_.object("bridge", surface::kConcrete, [&](MeshBuilder& s) {
      deck(s);
      piers(s);
      for (const double y : {-kDeckWidth_m / 2, kDeckWidth_m / 2}) truss(s, y);
      portals(s);
      arches(s);
      traffic();
    });
    ramps();
    fill();
  }

 private:
  enum Definition : std::uint16_t { kTree = 1, kHouse };

  void define() {
    builder_.out.begin_group("definitions");
    tree_ =
        builder_.define_object(kTree, "tree", [&](MeshBuilder& s) { draw_leafy_tree(s, 10, builder_.sides(6, 14)); });
    house_ = builder_.define_object(kHouse, "house", [&](MeshBuilder& s) { draw_house(s, builder_.rng); });
    builder_.out.end();
  }

  static void deck(MeshBuilder& s) {
    const double x = kHalf_m, y = kDeckWidth_m / 2;
    s.plate({{-x, -y, kDeck_m}, {x, -y, kDeck_m}, {x, y, kDeck_m}, {-x, y, kDeck_m}}, 1.2);
  }

  void piers(MeshBuilder& s) const {
    s.kind = surface::kStone;
    const int sides = builder_.sides(10, 40);
    for (int pier = 0; pier <= kSpans; ++pier) {
      const double x = -kHalf_m + kSpan_m * pier;
      // The outline of a pier is pointed upstream and downstream. The piers extend 6 m below the water surface.
      s.prism({{x - 3, -8, -6}, {x, -13, -6}, {x + 3, -8, -6}, {x + 3, 8, -6}, {x, 13, -6}, {x - 3, 8, -6}}, 11);
      for (const double y : {-5.0, 5.0}) s.revolve({x, y, 5}, {0, 0, 1}, {{0, 1.6}, {kDeck_m - 5.6, 1.4}}, sides);
    }
  }

  // Truss at one side of the deck: chords (horizontal bars at its lower and upper edge), vertical bars and
  // diagonals.
  void truss(MeshBuilder& s, double y) const {
    s.kind = surface::kPartMetal;
    const int panels = builder_.sides(8, 40);
    const double low = kDeck_m + 0.6, high = low + kTruss_m;
    for (int span = 0; span < kSpans; ++span) {
      const double from = -kHalf_m + kSpan_m * span, step = kSpan_m / panels;
      s.bar({from, y, low}, {from + kSpan_m, y, low}, 0.7);
      s.bar({from + step, y, high}, {from + kSpan_m - step, y, high}, 0.7);
      for (int panel = 0; panel < panels; ++panel) {
        const double x = from + step * panel;
        const bool first = panel == 0, last = panel == panels - 1;
        if (!first) s.bar({x, y, low}, {x, y, high}, 0.4);
        if (last)
          s.bar({x, y, high}, {x + step, y, low}, 0.6);
        else
          s.bar({x, y, first || panel % 2 == 0 ? low : high}, {x + step, y, first || panel % 2 == 0 ? high : low}, 0.5);
      }
    }
  }

  // Cross bars between the upper chords of the two trusses.
  void portals(MeshBuilder& s) const {
    const int panels = builder_.sides(8, 40);
    const double high = kDeck_m + 0.6 + kTruss_m, half = kDeckWidth_m / 2;
    for (int span = 0; span < kSpans; ++span)
      for (int panel = 1; panel < panels; ++panel) {
        const double x = -kHalf_m + kSpan_m * (span + 1.0 * panel / panels);
        s.bar({x, -half, high}, {x, half, high}, 0.4);
      }
  }

  // Stone arches carry the road over both banks.
  void arches(MeshBuilder& s) const {
    s.kind = surface::kStone;
    const int parts = builder_.sides(8, 40);
    constexpr double kArch_m = 20, kFoot_m = 3;
    for (const double side : {-1.0, 1.0})
      for (int arch = 0; arch < 3; ++arch) {
        const double middle = side * (kHalf_m + kArch_m * (arch + 0.5)), r = kArch_m / 2 - kFoot_m / 2;
        for (const double y : {-6.0, 6.0}) {
          std::vector<Vector3> wall{{middle - kArch_m / 2, y, 0}, {middle - r, y, 0}};
          for (int i = 1; i < parts; ++i) {
            const double angle = std::numbers::pi * (1.0 - 1.0 * i / parts);
            wall.push_back({middle + r * std::cos(angle), y, r * std::sin(angle)});
          }
          for (const Vector3& corner : {Vector3{middle + r, y, 0},
                                        {middle + kArch_m / 2, y, 0},
                                        {middle + kArch_m / 2, y, kDeck_m},
                                        {middle - kArch_m / 2, y, kDeck_m}})
            wall.push_back(corner);
          if (y > 0) wall = {wall.rbegin(), wall.rend()};
          s.polygon(wall);
        }
        for (int i = 0; i < parts; ++i) {
          const auto at = [&](int step, double y) {
            const double angle = std::numbers::pi * (1.0 - 1.0 * step / parts);
            return Vector3{middle + r * std::cos(angle), y, r * std::sin(angle)};
          };
          s.polygon({at(i, -6), at(i, 6), at(i + 1, 6), at(i + 1, -6)});
        }
        const double w = middle - kArch_m / 2, e = middle + kArch_m / 2;
        s.polygon({{w, -6, kDeck_m}, {e, -6, kDeck_m}, {e, 6, kDeck_m}, {w, 6, kDeck_m}});
      }
  }

  void traffic() {
    for (int i = 0; i < 40; ++i) {
      const bool truck = builder_.rng.below(4) == 0;
      const double side = i % 2 == 0 ? -3.0 : 3.0;
      const Transform saved = mesh_.map;
      mesh_.map = saved * translation({0, 0, kDeck_m + 0.6}) * pose(-kHalf_m + 10 * i + 5, side, side < 0 ? 0 : 180);
      if (truck)
        draw_truck(mesh_, surface::kBlue);
      else
        draw_car(mesh_, surface::kRed);
      mesh_.map = saved;
    }
  }

  // Sloping embankments from the arches down to the ground, and a level road beyond each embankment.
  void ramps() {
    for (const double side : {-1.0, 1.0}) {
      const double from = kHalf_m + 60, to = from + kRamp_m;
      builder_.object("ramp", surface::kEarth, [&](MeshBuilder& s) {
        const double a = side * from, b = side * to;
        std::vector<Vector3> top{{a, -6, kDeck_m}, {b, -6, 0}, {b, 6, 0}, {a, 6, kDeck_m}};
        std::vector<Vector3> south{{a, -20, 0}, {b, -6, 0}, {a, -6, kDeck_m}};
        std::vector<Vector3> north{{a, 6, kDeck_m}, {b, 6, 0}, {a, 20, 0}};
        if (side < 0)
          for (auto* face : {&top, &south, &north}) *face = {face->rbegin(), face->rend()};
        s.polygon(south);
        s.polygon(north);
        s.kind = surface::kAsphalt;
        s.polygon(top);
      });
      builder_.object("road", surface::kAsphalt, [&](MeshBuilder& s) {
        const double west = side > 0 ? to : -to - 1200, east = west + 1200;
        s.polygon({{west, -5, 0.05}, {east, -5, 0.05}, {east, 5, 0.05}, {west, 5, 0.05}});
      });
    }
  }

  // Adds houses along the road, then trees on both sides of the river, up to the requested number of triangles.
  void fill() {
    for (int i = 0; i < 60 && !builder_.is_full(); ++i) {
      const double x = (i % 2 == 0 ? -1.0 : 1.0) * (kHalf_m + kRamp_m + 90 + 20 * std::floor(i / 4.0));
      const double y = i / 2 % 2 == 0 ? -22 : 22;
      builder_.add_instance(kHouse, house_, pose(x, y, y < 0 ? 0 : 180));
    }
    while (!builder_.is_full()) {
      const double side = builder_.rng.below(2) == 0 ? -1.0 : 1.0;
      const double x = side * builder_.rng.uniform(kHalf_m + 20, 1600);
      const double y = builder_.rng.uniform(-1800, 1800);
      if (std::abs(y) > 45) builder_.add_instance(kTree, tree_, pose(x, y, 0, builder_.rng.uniform(0.7, 1.4)));
    }
  }

  SceneBuilder& builder_;
  MeshBuilder& mesh_;
  std::uint64_t tree_ = 0, house_ = 0;
};

}  // namespace

void generate_bridge(SceneBuilder& builder) {
  BridgeScene(builder).make();
}

}  // namespace yars::worldgen
