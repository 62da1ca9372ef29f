#include <array>

#include "lib/geo/frames.hpp"
#include "worldgen/scene/scene_builder.hpp"

namespace yars::worldgen {

namespace {

// Harbour scene. The edge of the quay is at y = 0. The water lies north of the quay, with its surface at z = 0. Two
// piers extend 100 m into the water. The paved container yard lies south of the quay.
constexpr double kQuayLength_m = 900, kQuayWidth_m = 36, kQuayTop_m = 3.0, kYardSouth_m = -420;
constexpr SurfaceKind kRock{8, 130, 0x77716A};  // material code, feature id, colour; see scene_builder.hpp

class HarbourScene {
 public:
  explicit HarbourScene(SceneBuilder& builder) : builder_(builder), mesh_(builder.mesh) {}

  void make() {
    builder_.half_side_m = 3000;
    builder_.turn(0.0);
    define();
    builder_.out.begin_group("quays");
    quays();
    breakwater();
    builder_.out.end();
    builder_.out.begin_group("ships");
    ship("freighter", -250, 25, 0, 180, 26, 14);
    ship("tanker", 260, 28, 180, 220, 34, 11);
    ship("coaster", 760, -70, 90, 84, 13, 6);
    ship("patrol_boat", -760, -40, 90, 48, 8, 4);
    builder_.out.end();
    builder_.out.begin_group("yard");
    for (int crane = 0; crane < 5; ++crane) builder_.add_instance(kCrane, crane_, pose(-360 + 180 * crane, -16, 0));
    sheds();
    tanks();
    fill();
    builder_.out.end();
  }

 private:
  enum Definition : std::uint16_t { kRedBox = 1, kBlueBox, kGreenBox, kTruck, kCrane, kTree };

  void define() {
    builder_.out.begin_group("definitions");
    static constexpr std::array<SurfaceKind, 3> kPaints{surface::kRed, surface::kBlue, surface::kGreen};
    for (std::size_t i = 0; i < kPaints.size(); ++i)
      box_ = builder_.define_object(static_cast<std::uint16_t>(kRedBox + i), "container", [&](MeshBuilder& s) {
        s.kind = kPaints[i];
        s.box({0, 0, 0}, 12.2, 2.44, 2.6);
      });
    truck_ = builder_.define_object(kTruck, "truck", [](MeshBuilder& s) { draw_truck(s, surface::kBlue); });
    crane_ = builder_.define_object(kCrane, "crane", [&](MeshBuilder& s) { draw_crane(s); });
    tree_ =
        builder_.define_object(kTree, "tree", [&](MeshBuilder& s) { draw_leafy_tree(s, 10, builder_.sides(6, 14)); });
    builder_.out.end();
  }

  // Gantry crane on four legs with a lattice boom over the water (+y).
  void draw_crane(MeshBuilder& s) {
    s.kind = surface::kPartMetal;
    const int panels = builder_.sides(6, 16);
    for (const double x : {-9.0, 9.0}) {
      for (const double y : {-10.0, 10.0}) s.bar({x, y, kQuayTop_m}, {x, y, 42}, 1.2);
      s.bar({x, -10, 18}, {x, 10, 18}, 0.9);
      s.bar({x, -10, 42}, {x, 10, 42}, 0.9);
      s.bar({x, -10, 18}, {x, 10, 42}, 0.6);
    }
    for (const double z : {18.0, 42.0})
      for (const double y : {-10.0, 10.0}) s.bar({-9, y, z}, {9, y, z}, 0.9);
    const double from = -24, to = 46, step = (to - from) / panels;
    for (const double x : {-2.5, 2.5})
      for (const double z : {43.0, 46.0}) s.bar({x, from, z}, {x, to, z}, 0.5);
    for (int panel = 0; panel < panels; ++panel) {
      const double y = from + step * panel;
      for (const double x : {-2.5, 2.5}) {
        s.bar({x, y, 43}, {x, y, 46}, 0.3);
        s.bar({x, y, 43}, {x, y + step, 46}, 0.3);
      }
      s.bar({-2.5, y, 43}, {2.5, y + step, 43}, 0.3);
    }
    s.bar({0, 10, 42}, {0, 4, 62}, 0.9);
    s.bar({0, 4, 62}, {0, 40, 46}, 0.35);
    s.bar({0, 4, 62}, {0, -22, 46}, 0.35);
    s.kind = surface::kMetal;
    s.box({0, -14, 46}, 6, 9, 4.5);
  }

  void quays() {
    builder_.object("quay", surface::kStone,
                    [](MeshBuilder& s) { s.box({0, -kQuayWidth_m / 2, 0}, kQuayLength_m, kQuayWidth_m, kQuayTop_m); });
    for (const double x : {-700.0, 700.0})
      builder_.object("pier", surface::kConcrete, [x](MeshBuilder& s) { s.box({x, -60, 0}, 24, 320, kQuayTop_m); });
    builder_.object("yard", surface::kAsphalt, [](MeshBuilder& s) {
      s.polygon({{-450, kYardSouth_m, kPaved_m},
                 {450, kYardSouth_m, kPaved_m},
                 {450, -kQuayWidth_m, kPaved_m},
                 {-450, -kQuayWidth_m, kPaved_m}});
    });
    builder_.object("bollards", surface::kDarkMetal, [&](MeshBuilder& s) {
      for (int i = 0; i < 30; ++i) s.cylinder({-435 + 30.0 * i, -1.2, kQuayTop_m}, 0.35, 0.8, builder_.sides(6, 12));
    });
  }

  // Rubble breakwater in a bent line in front of the harbour, with a lighthouse at its eastern end.
  void breakwater() {
    const std::array<Vector3, 5> line{
        Vector3{-900, 240, 0}, {-650, 420, 0}, {-250, 520, 0}, {200, 540, 0}, {560, 480, 0}};
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
      builder_.object("breakwater", kRock, [&](MeshBuilder& s) { s.bank(line[i], line[i + 1], 30, 7, 5); });
    builder_.object("light", surface::kStone, [&](MeshBuilder& s) {
      const int sides = builder_.sides(8, 24);
      s.revolve(line.back(), {0, 0, 1}, {{0, 4}, {14, 2.4}, {14.2, 3.2}, {15, 3.2}, {17.5, 1.8}, {18.5, 0}}, sides);
    });
  }

  // Ship at x, y. The bow is toward +x before the ship is turned by turn_deg, counter-clockwise seen from above. The
  // hull connects the outline at the waterline with the outline of the deck. On the deck are hatches and, near the
  // stern, a bridge with a funnel and a mast.
  void ship(const std::string& name, double x, double y, double turn_deg, double length_m, double beam_m,
            double freeboard_m) {
    const Transform saved = mesh_.map;
    mesh_.map = saved * pose(x, y, turn_deg);
    builder_.object(name, surface::kRed, [&](MeshBuilder& s) {
      const int parts = builder_.sides(3, 10);
      std::vector<Vector3> water, deck;
      const auto add = [&](double along, double width_fraction) {
        const double half = beam_m / 2 * width_fraction;
        water.push_back({along * length_m / 2 * 0.96, half * 0.88, 0});
        deck.push_back({along * length_m / 2, half, freeboard_m});
      };
      // From the starboard side of the stern around the bow to the port side. No corner lies on a straight side: the
      // deck would have triangles without area.
      add(-1.0, -1.0);
      add(0.4, -1.0);
      for (int i = 1; i < parts; ++i) add(0.4 + 0.6 * i / parts, -std::sqrt(1.0 - 1.0 * i * i / (parts * parts)));
      add(1.0, 0.0);
      const std::size_t bow = deck.size() - 1;
      for (std::size_t i = bow; i-- > 0;) {
        water.push_back({water[i].x, -water[i].y, 0});
        deck.push_back({deck[i].x, -deck[i].y, freeboard_m});
      }
      for (std::size_t i = 0; i < deck.size(); ++i) {
        const std::size_t next = (i + 1) % deck.size();
        s.polygon({water[i], water[next], deck[next], deck[i]});
      }
      s.kind = surface::kPartMetal;
      s.polygon(deck);
      s.kind = surface::kDarkMetal;
      const int hatches = static_cast<int>(length_m / 26);
      for (int hatch = 0; hatch < hatches; ++hatch)
        s.box({length_m * (-0.18 + 0.52 * hatch / hatches), 0, freeboard_m}, length_m * 0.36 / hatches, beam_m * 0.6,
              2.0);
      s.kind = surface::kWhite;
      for (int storey = 0; storey < 4; ++storey)
        s.box({-0.38 * length_m, 0, freeboard_m + 3.0 * storey}, 0.11 * length_m - storey,
              beam_m * (0.85 - 0.1 * storey), 3.0);
      s.kind = surface::kMetal;
      s.revolve({-0.42 * length_m, 0, freeboard_m + 12}, {0, 0, 1}, {{0, 0.08 * beam_m}, {6, 0.07 * beam_m}}, 12);
      s.cylinder({-0.35 * length_m, 0, freeboard_m + 12}, 0.25, 10, 6);
    });
    mesh_.map = saved;
  }

  void sheds() {
    for (int shed = 0; shed < 4; ++shed)
      builder_.object("shed" + std::to_string(shed + 1), surface::kPartMetal, [&](MeshBuilder& s) {
        const Vector3 foot{-330 + 220.0 * shed, kYardSouth_m - 45, 0};
        s.box(foot, 150, 48, 9);
        s.gable(foot + Vector3{0, 0, 9.0}, 150, 48, 6, 1.0);
      });
  }

  void tanks() {
    for (int tank = 0; tank < 6; ++tank)
      builder_.object("tank" + std::to_string(tank + 1), surface::kWhite, [&](MeshBuilder& s) {
        const Vector3 foot{560 + 60.0 * (tank % 3), -300 - 60.0 * std::floor(tank / 3.0), 0};
        s.revolve(foot, {0, 0, 1}, {{0, 22}, {15, 22}, {16.5, 12}, {17, 0}}, builder_.sides(12, 64));
      });
  }

  // Adds containers layer by layer, then trucks along the quay, then trees inland, up to the requested number of
  // triangles.
  void fill() {
    for (int height = 0; height < 4; ++height)
      for (int row = 0; row < 64; ++row)
        for (int column = 0; column < 60 && !builder_.is_full(); ++column) {
          const bool lane = row % 8 > 5 || column % 15 == 14;
          if (lane || builder_.rng.uniform() < 0.15 + 0.18 * height) continue;
          Transform at = pose(-430 + 14.2 * column, -70 - 5.2 * row, 0);
          at[3].z = 2.6 * height;
          builder_.add_instance(static_cast<std::uint16_t>(kRedBox + builder_.rng.below(3)), box_, at);
        }
    for (int i = 0; i < 60 && !builder_.is_full(); ++i)
      builder_.add_instance(kTruck, truck_, pose(-420 + 14 * i, -48, 180.0 * builder_.rng.below(2)));
    while (!builder_.is_full()) {
      const double scale = builder_.rng.uniform(0.7, 1.4);
      const double y_m = builder_.rng.uniform(-2000, -560), x_m = builder_.rng.uniform(-2000, 2000);
      builder_.add_instance(kTree, tree_, pose(x_m, y_m, 0, scale));
    }
  }

  SceneBuilder& builder_;
  MeshBuilder& mesh_;
  std::uint64_t box_ = 0, truck_ = 0, crane_ = 0, tree_ = 0;
};

}  // namespace

void generate_harbour(SceneBuilder& builder) {
  HarbourScene(builder).make();
}

}  // namespace yars::worldgen
