// Generator of OpenFlight scenes: the request, solid shapes as meshes, and functions that all kinds of scenes share.
// Objects that several kinds use: aircraft, vehicles, trees, buildings; `sides` is the number of sides of their round
// parts.
// Input: a SceneRequest. Output: an OpenFlight file as bytes and its number of triangles. Equal requests give equal
// files. Units: metres. Frame: x east, y north, z up; z = 0 is the ground. Each object stands around the origin.
// Aircraft and vehicles point toward +x. Buildings have their length along x. Threads: one thread per builder.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lib/geo/frames.hpp"
#include "lib/geo/quantity.hpp"
#include "lib/random/counter_rng.hpp"
#include "worldgen/scene/openflight_writer.hpp"
#include "yars/requests.hpp"

namespace yars::worldgen {

// A point of the profile of a body of revolution: position along the axis, and radius.
struct ProfilePoint {
  double along_m = 0.0, radius_m = 0.0;
};

// Writes solid shapes as faces of an OpenFlight file and counts their triangles. `map` transforms all corners. The
// corners of a face are counter-clockwise seen from outside. Round shapes have the normals of the exact shape.
class MeshBuilder {
 public:
  explicit MeshBuilder(OpenFlightWriter& out) : out_(out) {}

  SurfaceKind kind;  // surface of the faces that follow
  Transform map;     // applied to the faces that follow
  std::uint64_t triangles() const { return triangles_; }
  void count(std::uint64_t triangles) { triangles_ += triangles; }  // adds triangles of instances

  void polygon(const std::vector<Vector3>& corners, bool two_sided = false);
  // Axis-parallel box without a floor. `base` is the centre of its bottom.
  void box(Vector3 base, double east_m, double north_m, double height_m);
  // Upright prism without a floor over an outline that is counter-clockwise seen from above.
  void prism(const std::vector<Vector3>& outline, double height_m);
  // Gable roof on a box: ridge along x, overhanging the walls on all sides. `eaves` is the centre of the box's top.
  void gable(Vector3 eaves, double east_m, double north_m, double rise_m, double overhang_m);
  // Body of revolution about the line from `from` along the unit vector `axis`. Ends with a radius above 0 are closed.
  void revolve(Vector3 from, Vector3 axis, const std::vector<ProfilePoint>& profile, int sides);
  void cylinder(Vector3 base, double radius_m, double height_m, int sides);
  // Bar of square cross-section between two points, open at both ends.
  void bar(Vector3 from, Vector3 to, double side_m);
  // Closed plate of constant thickness, half of it on each side of the outline.
  void plate(const std::vector<Vector3>& outline, double thickness_m);
  // Embankment with a trapezoidal cross-section and closed ends, without a floor. `from`, `to`: ends of the centre line
  // of its foot. `foot_m`, `top_m`: widths.
  void bank(Vector3 from, Vector3 to, double foot_m, double top_m, double height_m);

 private:
  void emit(const std::vector<WriterVertex>& corners, bool two_sided);

  OpenFlightWriter& out_;
  std::uint64_t triangles_ = 0;
};

// Kinds of scenes. No scene has faces of water, because water belongs to the terrain.
using GeneratedKind = SceneKind;

struct SceneRequest {
  GeneratedKind kind = GeneratedKind::airfield;
  std::uint64_t triangles = 20'000;  // approximate; each kind has a minimum of its own
  std::uint64_t seed = 1;
  geo::GeoPoint origin;
  // [deg] True bearing of the scene's y axis. Runway and quay lie along x. nullopt: the seed turns airfield and town;
  // harbour and bridge are not turned.
  std::optional<double> heading_deg{};
};

struct GeneratedScene {
  std::vector<std::byte> file;
  std::uint64_t triangles = 0;  // at the finest level of detail; each instance counts
};

// Called about every 10,000 triangles, with the number of triangles so far.
using GenerationProgress = std::function<void(std::uint64_t triangles)>;

// Generates a scene. Repeated objects (aircraft, houses, trees) are defined once and instanced, so that a town of
// millions of triangles is a file of some megabytes.
GeneratedScene generate_scene(const SceneRequest& request, const GenerationProgress& progress = {});

// Surfaces: material code and feature id of DFAD (Digital Feature Analysis Data, docs/spec/formats.md#dfad), display
// colour.
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

inline constexpr double kPaved_m = 0.05;  // height of paved surfaces above the ground

// State of a scene under construction: the file, a mesh, random numbers and the number of triangles so far.
class SceneBuilder {
 public:
  SceneBuilder(const SceneRequest& scene_request, const GenerationProgress& progress)
      : request(scene_request), out(request.origin), mesh(out), rng(request.seed), progress_(progress) {}

  const SceneRequest& request;
  OpenFlightWriter out;
  MeshBuilder mesh;
  random::CounterRng rng;
  double half_side_m = 0.0;  // half the side of a square around the origin that contains the scene

  std::uint64_t triangles() const { return mesh.triangles(); }
  bool is_full() const { return mesh.triangles() >= request.triangles; }

  // Turns all faces about the vertical axis through the origin: by the requested heading, else by a random angle of at
  // most `max_random_rad` to either side.
  void turn(double max_random_rad) {
    const double random_rad = max_random_rad > 0.0 ? rng.uniform(-max_random_rad, max_random_rad) : 0.0;
    // A heading counts clockwise, a rotation counter-clockwise.
    mesh.map = rotation_about_up(request.heading_deg ? -*request.heading_deg * geo::kRadiansPerDegree : random_rad);
  }

  // Number of sides of round shapes, `min` to `max`. It increases with the requested number of triangles.
  int sides(int min, int max) const {
    const double detail = std::log2(static_cast<double>(request.triangles) / 5000.0) / 8.0;
    return static_cast<int>(min + (max - min) * std::min(1.0, std::max(0.0, detail)));
  }

  // Draws definition `number`: a part of the scene that add_instance() places, any number of times. Returns its number
  // of triangles. The scene counts them with each instance, not here.
  template <class Draw>
  std::uint64_t define(std::uint16_t number, const Draw& draw) {
    MeshBuilder definition(out);
    out.begin_definition(number);
    draw(definition);
    out.end();
    return definition.triangles();
  }

  // Draws a definition whose faces belong to one object of the file, with this name.
  template <class Draw>
  std::uint64_t define_object(std::uint16_t number, const std::string& name, const Draw& draw) {
    return define(number, [&](MeshBuilder& definition) {
      out.begin_object(name);
      draw(definition);
      out.end();
    });
  }

  // Draws one object of the scene into `mesh`. `kind`: surface of its faces until `draw` sets another surface.
  template <class Draw>
  void object(const std::string& name, const SurfaceKind& kind, const Draw& draw) {
    out.begin_object(name);
    mesh.kind = kind;
    draw(mesh);
    out.end();
    report_progress();
  }

  // Adds an instance of definition `number`, which has `triangles` triangles. The instance is transformed by `where`,
  // then by `mesh.map`.
  void add_instance(std::uint16_t number, std::uint64_t triangles, const Transform& where) {
    out.instance(number, mesh.map * where);
    mesh.count(triangles);
    report_progress();
  }

 private:
  void report_progress() {
    if (progress_ && triangles() >= reported_triangles_ + 10'000) progress_(reported_triangles_ = triangles());
  }

  const GenerationProgress& progress_;
  std::uint64_t reported_triangles_ = 0;
};

// Transform that scales, rotates by turn_deg counter-clockwise seen from above, then translates in x and y [m].
inline Transform pose(double x, double y, double turn_deg, double scale = 1.0) {
  return translation({x, y, 0}) * rotation_about_up(turn_deg * std::numbers::pi / 180.0) *
         scaling({scale, scale, scale});
}

void generate_airfield(SceneBuilder& builder);
void generate_harbour(SceneBuilder& builder);
void generate_bridge(SceneBuilder& builder);
void generate_town(SceneBuilder& builder);

void draw_fighter(MeshBuilder& mesh, int sides);
void draw_transport(MeshBuilder& mesh, int sides);  // transport aircraft
void draw_truck(MeshBuilder& mesh, const SurfaceKind& body);
void draw_tanker(MeshBuilder& mesh, int sides);  // road tanker
void draw_car(MeshBuilder& mesh, const SurfaceKind& body);
void draw_conifer(MeshBuilder& mesh, double height_m, int sides);
void draw_leafy_tree(MeshBuilder& mesh, double height_m, int sides);
// House with pitched roof and chimney. A dormer and a garage are each added at random.
void draw_house(MeshBuilder& mesh, random::CounterRng& rng);
// Block of flats with rows of windows, a parapet, and the upper ends of the stairwells on the roof.
void draw_block(MeshBuilder& mesh, random::CounterRng& rng);
// High-rise building on a wider base. It narrows in steps toward the top and has machinery and a mast on the roof.
void draw_tower(MeshBuilder& mesh, random::CounterRng& rng);

}  // namespace yars::worldgen
