#include <array>
#include <numbers>

#include "lib/geo/frames.hpp"
#include "worldgen/scene/scene_builder.hpp"

namespace yars::worldgen {

namespace {

// Airfield scene. The runway lies along x, centred on the origin. The flight line (apron, hangars, parked aircraft) is
// south of the runway.
constexpr double kRunway_m = 2500, kRunwayWidth_m = 45, kTaxiway_m = 23, kTaxiwayY_m = -220;
constexpr double kApronSouth_m = -430, kFenceX_m = 1400, kFenceY_m = 620;

class AirfieldScene {
 public:
  explicit AirfieldScene(SceneBuilder& builder) : builder_(builder), mesh_(builder.mesh) {}

  void make() {
    builder_.half_side_m = 3200;
    builder_.turn(0.6);
    define();
    builder_.out.begin_group("paved");
    pave();
    builder_.out.end();
    builder_.out.begin_group("flight_line");
    hangars();
    tower();
    fuel();
    park();
    builder_.out.end();
    builder_.out.begin_group("edge");
    fences();
    embankments();
    builder_.out.end();
    builder_.out.begin_group("around");
    fill();
    builder_.out.end();
  }

 private:
  enum Definition : std::uint16_t { kFighter = 1, kTransport, kTruck, kTanker, kConifer, kLeafy, kHouse };

  void define() {
    const int sides = builder_.sides(8, 40);
    builder_.out.begin_group("definitions");
    fighter_ = define_aircraft(kFighter, "fighter", 12, [&](MeshBuilder& s) { draw_fighter(s, sides); });
    transport_ = define_aircraft(kTransport, "transport", 24, [&](MeshBuilder& s) { draw_transport(s, sides); });
    truck_ = builder_.define_object(kTruck, "truck", [](MeshBuilder& s) { draw_truck(s, surface::kOlive); });
    tanker_ = builder_.define_object(kTanker, "tanker", [&](MeshBuilder& s) { draw_tanker(s, sides); });
    conifer_ = builder_.define_object(kConifer, "conifer",
                                      [&](MeshBuilder& s) { draw_conifer(s, 14, builder_.sides(6, 16)); });
    leafy_ =
        builder_.define_object(kLeafy, "tree", [&](MeshBuilder& s) { draw_leafy_tree(s, 11, builder_.sides(6, 16)); });
    house_ = builder_.define_object(kHouse, "quarters", [&](MeshBuilder& s) { draw_house(s, builder_.rng); });
    builder_.out.end();
  }

  // Defines an aircraft with two levels of detail: complete up to 1500 m from the viewer, two boxes from there to
  // 100 km. Returns the number of triangles of the complete model.
  template <class Draw>
  std::uint64_t define_aircraft(std::uint16_t number, const std::string& name, double length_m, const Draw& draw) {
    constexpr double kNear_m = 1500, kFar_m = 100'000;
    std::uint64_t fine = 0;
    builder_.define(number, [&](MeshBuilder& definition) {
      builder_.out.begin_level_of_detail("fine", kNear_m, 0, {0, 0, 2});
      builder_.out.begin_object(name);
      draw(definition);
      fine = definition.triangles();
      builder_.out.end();
      builder_.out.end();
      builder_.out.begin_level_of_detail("coarse", kFar_m, kNear_m, {0, 0, 2});
      builder_.out.begin_object(name + "_far");
      definition.box({0, 0, 0.8}, length_m, 2.2, 2.4);
      definition.box({-1, 0, 1.8}, 5, length_m, 0.4);
      builder_.out.end();
      builder_.out.end();
    });
    return fine;
  }

  void slab(const std::string& name, const SurfaceKind& kind, double x0, double x1, double y0, double y1,
            double z = kPaved_m) {
    builder_.object(name, kind,
                    [&](MeshBuilder& s) { s.polygon({{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}}); });
  }

  void pave() {
    const double half = kRunway_m / 2, side = kRunwayWidth_m / 2;
    builder_.object("runway", surface::kConcrete, [&](MeshBuilder& s) {
      s.polygon({{-half, -side, kPaved_m}, {half, -side, kPaved_m}, {half, side, kPaved_m}, {-half, side, kPaved_m}});
      builder_.out.begin_subfaces();
      s.kind = surface::kPaint;
      for (int dash = 0; dash < 39; ++dash) mark(s, 60.0 * dash - half + 100, 60.0 * dash - half + 130, -0.45, 0.45);
      for (const double end : {-half + 6, half - 36})
        for (int stripe = -4; stripe < 4; ++stripe) mark(s, end, end + 30, 4.5 * stripe + 1.3, 4.5 * stripe + 3.2);
      builder_.out.end_subfaces();
    });
    slab("taxiway", surface::kAsphalt, -half, half, kTaxiwayY_m - kTaxiway_m / 2, kTaxiwayY_m + kTaxiway_m / 2);
    for (int link = 0; link < 5; ++link) {
      const double x = (link - 2) * (half - 15) / 2;
      slab("link" + std::to_string(link), surface::kAsphalt, x - kTaxiway_m / 2, x + kTaxiway_m / 2,
           kTaxiwayY_m + kTaxiway_m / 2, -side);
    }
    slab("apron", surface::kConcrete, -350, 350, kApronSouth_m, kTaxiwayY_m - kTaxiway_m / 2);
    slab("road", surface::kAsphalt, -4, 4, -kFenceY_m, kApronSouth_m - 90);
  }

  // Painted rectangle on the runway.
  static void mark(MeshBuilder& s, double x0, double x1, double y0, double y1) {
    s.polygon({{x0, y0, kPaved_m}, {x1, y0, kPaved_m}, {x1, y1, kPaved_m}, {x0, y1, kPaved_m}});
  }

  // Sheet-metal hangars with arched roofs. Their doors face the apron.
  void hangars() {
    const int arches = builder_.sides(8, 32);
    for (int hangar = 0; hangar < 4; ++hangar) {
      const double x = -270 + 180 * hangar, y = kApronSouth_m - 40, half = 32, depth = 50, wall = 9, rise = 9;
      builder_.object("hangar" + std::to_string(hangar + 1), surface::kMetal, [&](MeshBuilder& s) {
        std::vector<Vector3> end;
        for (int i = 0; i <= arches; ++i) {
          const double angle = std::numbers::pi * i / arches;
          end.push_back({x + half * std::cos(angle), y + depth / 2, wall + rise * std::sin(angle)});
        }
        const Vector3 back{0, -depth, 0};
        for (int i = 0; i < arches; ++i) {
          const auto at = static_cast<std::size_t>(i);
          s.polygon({end[at], end[at + 1], end[at + 1] + back, end[at] + back});
        }
        std::vector<Vector3> front{{x + half, y + depth / 2, 0}, {x - half, y + depth / 2, 0}};
        front.insert(front.end(), end.rbegin(), end.rend());
        s.polygon(front);
        std::vector<Vector3> rear{{x - half, y - depth / 2, 0}, {x + half, y - depth / 2, 0}};
        for (const Vector3& corner : end) rear.push_back(corner + back);
        s.polygon(rear);
        for (const double side : {-1.0, 1.0}) {
          const double at = x + side * half, first = side * depth / 2;
          s.polygon({{at, y - first, 0}, {at, y + first, 0}, {at, y + first, wall}, {at, y - first, wall}});
        }
        s.kind = surface::kDarkMetal;
        s.polygon({{x + 22, y + depth / 2 + 0.1, 0},
                   {x - 22, y + depth / 2 + 0.1, 0},
                   {x - 22, y + depth / 2 + 0.1, 11},
                   {x + 22, y + depth / 2 + 0.1, 11}});
      });
    }
  }

  void tower() {
    const Vector3 foot{430, kApronSouth_m + 40, 0};
    builder_.object("tower", surface::kStone, [&](MeshBuilder& s) {
      const int sides = builder_.sides(8, 32);
      s.box(foot, 26, 16, 6);
      s.cylinder(foot, 4.0, 28, sides);
      s.kind = surface::kGlass;
      s.revolve(foot + Vector3{0, 0, 28}, {0, 0, 1}, {{0, 5.0}, {4.5, 6.4}}, 8);
      s.kind = surface::kMetal;
      s.revolve(foot + Vector3{0, 0, 32.5}, {0, 0, 1}, {{0, 6.8}, {0.8, 6.8}, {1.6, 0}}, 8);
      s.cylinder(foot + Vector3{0, 0, 34}, 0.2, 9, 6);
    });
  }

  // Four fuel tanks with domed roofs inside a square of low earth banks (a bund).
  void fuel() {
    const int sides = builder_.sides(12, 64);
    for (int tank = 0; tank < 4; ++tank) {
      const Vector3 foot{-480 - 40.0 * (tank % 2), kApronSouth_m + 20 - 40.0 * std::floor(tank / 2.0), 0};
      builder_.object("tank" + std::to_string(tank + 1), surface::kWhite, [&](MeshBuilder& s) {
        s.revolve(foot, {0, 0, 1}, {{0, 12}, {11, 12}, {12.5, 9}, {13.5, 4.5}, {13.8, 0}}, sides);
      });
    }
    builder_.object("bund", surface::kEarth, [&](MeshBuilder& s) {
      const double w = -545, e = -455, n = kApronSouth_m + 45, b = kApronSouth_m - 45;
      const std::array<Vector3, 4> ring{Vector3{w, b, 0}, {e, b, 0}, {e, n, 0}, {w, n, 0}};
      for (std::size_t i = 0; i < 4; ++i) s.bank(ring[i], ring[(i + 1) % 4], 6, 1.5, 2.0);
    });
  }

  // Earth banks on three sides of a stand with a parked fighter.
  void revetment(double x, double y, double turn_deg) {
    const Transform saved = mesh_.map;
    mesh_.map = saved * pose(x, y, turn_deg);
    builder_.object("revetment", surface::kEarth, [](MeshBuilder& s) {
      s.bank({12, 13, 0}, {-14, 13, 0}, 7, 1.5, 4.5);
      s.bank({-14, 15, 0}, {-14, -15, 0}, 7, 1.5, 4.5);
      s.bank({-14, -13, 0}, {12, -13, 0}, 7, 1.5, 4.5);
    });
    builder_.object("stand", surface::kConcrete, [](MeshBuilder& s) {
      s.polygon({{-12, -9, kPaved_m}, {20, -9, kPaved_m}, {20, 9, kPaved_m}, {-12, 9, kPaved_m}});
    });
    mesh_.map = saved;
    builder_.add_instance(kFighter, fighter_, pose(x, y, turn_deg));
  }

  void park() {
    for (int i = 0; i < 6; ++i) builder_.add_instance(kFighter, fighter_, pose(-320 + 30 * i, kApronSouth_m + 60, 80));
    for (int i = 0; i < 4; ++i)
      builder_.add_instance(kTransport, transport_, pose(-80 + 55 * i, kApronSouth_m + 70, 90));
    for (int i = 0; i < 5; ++i) builder_.add_instance(kTruck, truck_, pose(180 + 14 * i, kApronSouth_m + 25, 95));
    for (int i = 0; i < 3; ++i) builder_.add_instance(kTanker, tanker_, pose(-430, kApronSouth_m + 30 - 16 * i, 10));
    for (int i = 0; i < 8; ++i) revetment(-1150 + 90 * i, kTaxiwayY_m - 70, builder_.rng.uniform(75, 105));
    for (int i = 0; i < 8; ++i) revetment(520 + 90 * i, kTaxiwayY_m - 70, builder_.rng.uniform(75, 105));
  }

  void fences() {
    constexpr double kPart_m = 50;  // minimum length of one fence object
    const std::array<Vector3, 4> ring{
        Vector3{-kFenceX_m, -kFenceY_m, 0}, {kFenceX_m, -kFenceY_m, 0}, {kFenceX_m, 300, 0}, {-kFenceX_m, 300, 0}};
    for (std::size_t i = 0; i < 4; ++i) {
      const Vector3 side = ring[(i + 1) % 4] - ring[i];
      const int parts = static_cast<int>(length(side) / kPart_m);
      for (int part = 0; part < parts; ++part) {
        const Vector3 a = ring[i] + (1.0 * part / parts) * side, b = ring[i] + ((part + 1.0) / parts) * side;
        builder_.object("fence", surface::kPartMetal, [&](MeshBuilder& s) {
          s.polygon({a, b, b + Vector3{0, 0, 2.4}, a + Vector3{0, 0, 2.4}}, true);
          s.bar(a, a + Vector3{0, 0, 2.6}, 0.15);
        });
      }
    }
  }

  void embankments() {
    for (int part = 0; part < 8; ++part) {
      const double x = -1200 + 300 * part;
      builder_.object("embankment", surface::kEarth,
                      [&](MeshBuilder& s) { s.bank({x, 260, 0}, {x + 290, 260, 0}, 16, 3, 5); });
    }
  }

  // Adds houses of the staff, then trees around the airfield, up to the requested number of triangles.
  void fill() {
    for (int i = 0; i < 24 && !builder_.is_full(); ++i)
      builder_.add_instance(kHouse, house_,
                            pose(60 + 30 * (i % 8), -540 - 26 * std::floor(i / 8.0), 5.0 * builder_.rng.below(2)));
    constexpr double kWood_m = 1'200;  // distance to which woods extend beyond the fence
    while (!builder_.is_full()) {
      const double x = builder_.rng.uniform(-kFenceX_m - kWood_m, kFenceX_m + kWood_m);
      const double y = builder_.rng.uniform(-kFenceY_m - kWood_m, 300 + kWood_m);
      const bool within = std::abs(x) < kFenceX_m + 15 && y > -kFenceY_m - 15 && y < 315;
      const bool approach = std::abs(y) < 150;
      const bool clearing = std::sin(x / 310) + std::sin(y / 270) + std::sin((x + y) / 190) < 0.4;
      const double scale = builder_.rng.uniform(0.7, 1.4);
      if (within || approach || clearing) continue;
      const bool conifer = builder_.rng.below(3) != 0;
      builder_.add_instance(conifer ? kConifer : kLeafy, conifer ? conifer_ : leafy_, pose(x, y, 0, scale));
    }
  }

  SceneBuilder& builder_;
  MeshBuilder& mesh_;
  std::uint64_t fighter_ = 0, transport_ = 0, truck_ = 0, tanker_ = 0, conifer_ = 0, leafy_ = 0, house_ = 0;
};

}  // namespace

void generate_airfield(SceneBuilder& builder) {
  AirfieldScene(builder).make();
}

}  // namespace yars::worldgen
