// Solid shapes as faces of an OpenFlight file, counted in triangles. Lengths in metres, x east, y north, z up before
// the sketch's own map; every face turns counter-clockwise from outside. Round shapes have the normals of the round
// surface.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "model/scene/openflight_writer.hpp"

namespace yars::model::scene {

// A point of a turned body: how far along its axis, and its radius there.
struct TurnedPoint {
  double along_m = 0.0, radius_m = 0.0;
};

class Sketch {
 public:
  explicit Sketch(OpenFlightWriter& out) : out_(out) {}

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

}  // namespace yars::model::scene
