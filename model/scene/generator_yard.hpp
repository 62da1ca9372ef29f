// What the generators of all kinds of scenes work with: the file, a sketch, numbers by chance, and how far the order is
// filled.
#pragma once

#include <cmath>
#include <numbers>
#include <string>

#include "model/scene/generator.hpp"
#include "model/scene/sketch.hpp"

namespace yars::model::scene {

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
inline constexpr SurfaceKind kEarth{5, 109, 0x8A7850}, kGrass{10, 110, 0x6F8A4A};
inline constexpr SurfaceKind kConcrete{9, 111, 0xA8A8A2}, kAsphalt{9, 112, 0x55565A}, kPaint{9, 113, 0xF0F0EA};
inline constexpr SurfaceKind kLeaves{12, 114, 0x3C6B33}, kNeedles{12, 115, 0x2C5238}, kTrunk{12, 116, 0x5C4630};
inline constexpr SurfaceKind kRed{1, 117, 0xA03A2E}, kBlue{1, 118, 0x2F5A8C}, kGreen{1, 119, 0x3E7A54};
inline constexpr SurfaceKind kWhite{1, 120, 0xE4E6E6}, kOlive{1, 121, 0x5E6144};
}  // namespace surface

class Yard {
 public:
  Yard(const SceneOrder& wanted, const GenerationProgress& progress)
      : order(wanted), out(wanted.origin), sketch(out), chance(wanted.seed), progress_(progress) {}

  const SceneOrder& order;
  OpenFlightWriter out;
  Sketch sketch;
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
    Sketch apart(out);
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

void generate_airfield(Yard& yard);
void generate_harbour(Yard& yard);
void generate_bridge(Yard& yard);
void generate_town(Yard& yard);

}  // namespace yars::model::scene
