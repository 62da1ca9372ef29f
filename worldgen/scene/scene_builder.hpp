// Builder of made-up scenes: solid shapes, the order for a scene, and what all kinds of scenes share.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lib/geo/frames.hpp"
#include "worldgen/scene/openflight_writer.hpp"

namespace yars::worldgen {

// A point of a turned body: how far along its axis, and its radius there.
struct TurnedPoint {
  double along_m = 0.0, radius_m = 0.0;
};

// Solid shapes as faces of an OpenFlight file, counted in triangles. Lengths in metres, x east, y north, z up before
// the sketch's own map; every face turns counter-clockwise from outside. Round shapes have the normals of the round
// surface.
class MeshBuilder {
 public:
  explicit MeshBuilder(OpenFlightWriter& out) : out_(out) {}

  SurfaceKind kind;  // of the faces to come
  Affine map;        // applied to them
  std::uint64_t triangles() const { return triangles_; }
  void count(std::uint64_t triangles) { triangles_ += triangles; }  // what instances add

  void polygon(const std::vector<Vector3>& corners, bool two_sided = false);
  // Axis-parallel, standing at z = base.z with its middle there; without a floor.
  void box(Vector3 base, double east_m, double north_m, double height_m);
  // An upright prism over an outline that turns counter-clockwise from above; without a floor.
  void prism(const std::vector<Vector3>& outline, double height_m);
  // A roof on a box's top: ridge along x, eaves overhanging on all sides.
  void gable(Vector3 eaves, double east_m, double north_m, double rise_m, double overhang_m);
  // Turned about the line from `from` along `axis` (unit); ends with a radius are closed.
  void turned(Vector3 from, Vector3 axis, const std::vector<TurnedPoint>& profile, int sides);
  void cylinder(Vector3 base, double radius_m, double height_m, int sides);
  // A square bar between two points, open at its ends.
  void bar(Vector3 from, Vector3 to, double side_m);
  // A plate of constant thickness over an outline in space, closed all around.
  void plate(const std::vector<Vector3>& outline, double thickness_m);
  // A wall that tapers: its cross-section is a trapezium; ends closed.
  void bank(Vector3 from, Vector3 to, double foot_m, double top_m, double height_m);

 private:
  void emit(const std::vector<WriterVertex>& corners, bool two_sided);

  OpenFlightWriter& out_;
  std::uint64_t triangles_ = 0;
};

// Made-up scenes as OpenFlight files, the same for the same order: an airfield, a harbour, a bridge, a town. z = 0 is
// the ground; of water there is none, that is the terrain's. What stands in numbers (aircraft, houses, trees) is
// defined once and shown by instances, so that a town of millions of triangles is a file of some megabytes.
enum class GeneratedKind : std::uint8_t { airfield, harbour, bridge, town };
std::optional<GeneratedKind> generated_kind(std::string_view name);

struct SceneOrder {
  GeneratedKind kind = GeneratedKind::airfield;
  std::uint64_t triangles = 20'000;  // about; at least what the kind cannot do without, some thousands
  std::uint64_t seed = 1;
  geo::GeoPoint origin;
};

inline constexpr std::uint64_t kMaxGenerated = 8'000'000;

struct GeneratedScene {
  std::vector<std::byte> file;
  std::uint64_t triangles = 0;  // as a reader shows them: finest level of detail, instances counted each time
};

// Called now and then with the triangles made so far.
using GenerationProgress = std::function<void(std::uint64_t triangles)>;

GeneratedScene generate_scene(const SceneOrder& order, const GenerationProgress& progress = {});

// Numbers by chance, the same everywhere (SplitMix64: Steele, Lea, Flood, OOPSLA 2014).
class Chance {
 public:
  explicit Chance(std::uint64_t seed) : state_(seed) {}
  std::uint64_t word() {
    state_ += 0x9E3779B97F4A7C15U;
    std::uint64_t z = state_;
    z = (z ^ z >> 30U) * 0xBF58476D1CE4E5B9U;
    z = (z ^ z >> 27U) * 0x94D049BB133111EBU;
    return z ^ z >> 31U;
  }
  double share() { return static_cast<double>(word() >> 11U) * 0x1.0p-53; }  // [0, 1)
  double between(double least, double most) { return least + (most - least) * share(); }
  int below(int count) { return static_cast<int>(share() * count); }

 private:
  std::uint64_t state_;
};

// Surfaces by DFAD code, in the colours of the picture for people.
namespace surface {
inline constexpr SurfaceKind kMetal{1, 100, 0x9AA4AD}, kDarkMetal{1, 101, 0x5B646B}, kPartMetal{2, 102, 0x7D8790};
inline constexpr SurfaceKind kStone{3, 103, 0xB9A58C}, kBrick{3, 104, 0xA45A44}, kTiles{3, 105, 0x8C4632};
inline constexpr SurfaceKind kComposition{4, 106, 0xCFC9BD}, kRoofing{4, 107, 0x6E6862}, kGlass{4, 108, 0x4A6A80};
inline constexpr SurfaceKind kEarth{5, 109, 0x8A7850};
inline constexpr SurfaceKind kConcrete{9, 111, 0xA8A8A2}, kAsphalt{9, 112, 0x55565A}, kPaint{9, 113, 0xF0F0EA};
inline constexpr SurfaceKind kLeaves{12, 114, 0x3C6B33}, kNeedles{12, 115, 0x2C5238}, kTrunk{12, 116, 0x5C4630};
inline constexpr SurfaceKind kRed{1, 117, 0xA03A2E}, kBlue{1, 118, 0x2F5A8C}, kGreen{1, 119, 0x3E7A54};
inline constexpr SurfaceKind kWhite{1, 120, 0xE4E6E6}, kOlive{1, 121, 0x5E6144};
}  // namespace surface

// What the generators of all kinds of scenes work with: the file, a sketch, numbers by chance, and how far the order is
// filled.
class SceneBuilder {
 public:
  SceneBuilder(const SceneOrder& wanted, const GenerationProgress& progress)
      : order(wanted), out(wanted.origin), sketch(out), chance(wanted.seed), progress_(progress) {}

  const SceneOrder& order;
  OpenFlightWriter out;
  MeshBuilder sketch;
  Chance chance;
  double reach_m = 0.0;  // half the side of a square about the origin that holds the scene

  std::uint64_t triangles() const { return sketch.triangles(); }
  bool is_full() const { return sketch.triangles() >= order.triangles; }

  // Sides of round things, more where more triangles are asked for.
  int sides(int least, int most) const {
    const double detail = std::log2(static_cast<double>(order.triangles) / 5000.0) / 8.0;
    return static_cast<int>(least + (most - least) * std::min(1.0, std::max(0.0, detail)));
  }

  // Draws into a definition, which counts only where it is shown. Returns its triangles.
  template <class Draw>
  std::uint64_t define(std::uint16_t number, const Draw& draw) {
    MeshBuilder apart(out);
    out.begin_definition(number);
    draw(apart);
    out.end();
    return apart.triangles();
  }

  // Draws an object under its name.
  template <class Draw>
  void object(const std::string& name, const SurfaceKind& kind, const Draw& draw) {
    out.begin_object(name);
    sketch.kind = kind;
    draw(sketch);
    out.end();
    tell();
  }

  void show(std::uint16_t number, std::uint64_t triangles, const Affine& where) {
    out.instance(number, where * sketch.map);
    sketch.count(triangles);
    tell();
  }

 private:
  void tell() {
    if (progress_ && triangles() >= told_ + 10'000) progress_(told_ = triangles());
  }

  const GenerationProgress& progress_;
  std::uint64_t told_ = 0;
};

// Turned by a heading-like angle [deg], counter-clockwise from east, and moved.
inline Affine standing(double x, double y, double turn_deg, double scale = 1.0) {
  return Affine::scale({scale, scale, scale}) * Affine::turn_about_up(turn_deg * std::numbers::pi / 180.0) *
         Affine::translation({x, y, 0});
}

void generate_airfield(SceneBuilder& yard);
void generate_harbour(SceneBuilder& yard);
void generate_bridge(SceneBuilder& yard);
void generate_town(SceneBuilder& yard);

}  // namespace yars::worldgen
