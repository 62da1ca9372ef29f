// Sums the faces of a scene up to scatterers while it is placed.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

#include "model/scene/plane.hpp"
#include "model/scene/scatterers.hpp"

namespace yars::model::scene {

// Squares are made larger as a scene turns out to be larger, so that there is a bound on what it takes; what does not
// fit even then is left out.
class ScatterBuilder {
 public:
  // What lies farther from the place than `most_reach_m` is left out.
  explicit ScatterBuilder(double most_reach_m) : most_reach_m_(most_reach_m) {}

  // A triangle, counter-clockwise from outside, not much longer than the smallest square: metres east and north on the
  // scene's plane, altitude MSL. It counts where its middle is.
  void stand(const std::array<geo::Vector3, 3>& corners, std::uint8_t material);
  // The same of one that lies on the ground, seen from above: each square gets what lies in it.
  void lie(const std::array<geo::Vector3, 3>& corners, std::uint8_t material);

  // Ends the work; null if nothing was added.
  std::shared_ptr<const Scatterers> take(const Plane& plane);

 private:
  struct FacingSum {
    std::uint32_t key = 0;  // material, elevation and azimuth of the normal
    geo::Vector3 area_m2;
  };
  struct Square {
    geo::Vector3 middle;  // sums, times area
    double spread = 0.0;  // sum of area times square of the distance from the plane's origin
    double area_m2 = 0.0;
    double least_m = 0.0, most_m = 0.0;
    std::vector<FacingSum> facings;
  };
  using Squares = std::unordered_map<std::uint64_t, Square>;
  using Keys = std::vector<std::uint64_t>;

  bool within_reach(const std::array<geo::Vector3, 3>& corners) const;
  double side_m() const { return kScattererSides_m[finest_]; }
  bool coarsen();
  Square* square_in(Squares& squares, geo::Vector3 at);
  static void add(Square& square, std::uint32_t key, geo::Vector3 area_m2);
  static Keys sorted_keys(const Squares& squares);
  static Squares coarser(const Squares& squares);
  void finish(const Plane& plane, double side_m, Scatterers& made, ScattererLevel& level) const;

  double most_reach_m_;
  std::size_t finest_ = 0;    // level
  Squares standing_, lying_;  // of the level under way
};

}  // namespace yars::model::scene
