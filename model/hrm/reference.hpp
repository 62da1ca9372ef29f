// Patch map by the algorithm `reference`: double precision, facet by facet. Tests compare `standard` with it.
// Terrain and scene triangles are cut into facets of at most a third of a pixel. Geodesics give exact positions.
// A visible facet adds gamma times its area projected towards the radar, at the point of the map plane with the facet's
// slant range. Without layover (Fidelity::map_layover) the point has the facet's distance over ground.
// Shadow of terrain: running maximum of the tangent of elevation angle along a column of the polar grid, in steps of at
// most a tenth of the post spacing.
// Shadow of the scene: ray casting (occluders.hpp).
// Threads: one caller; only point response and video use the executor's threads.
// Source: docs/radar_maths.md, "Patch maps".
#pragma once

#include <algorithm>
#include <vector>

#include "lib/radar/fidelity.hpp"
#include "model/hrm/algorithm.hpp"
#include "model/hrm/occluders.hpp"
#include "model/hrm/patch_geometry.hpp"
#include "model/hrm/power_picture.hpp"
#include "model/physics/atmosphere.hpp"
#include "model/physics/reflectivity.hpp"
#include "model/scene/placement/scene_view.hpp"

namespace yars::model::hrm {

inline constexpr int kReferenceCells = 3;  // minimum number of grid cells per pixel, in range and in azimuth

class Reference : public Algorithm {
 public:
  explicit Reference(const physics::RadarParameters& parameters);

  int cells_per_pixel() const override { return std::max(kReferenceCells, fidelity_.map_oversampling); }
  bool uses_crests() const override { return true; }
  bool uses_sectors() const override { return false; }  // a face may lie in many columns
  void begin(const PatchData& data) override;
  void read_terrain(const PatchInputs& inputs, PatchData& data) override;
  void draw_scene(const PatchInputs& inputs, PatchData& data) override;
  void cast_profiles(const PatchInputs& inputs, PatchData& data) override;
  void draw_pixels(const PatchInputs& inputs, PatchData& data) override;
  void complete_map(const PatchInputs& inputs, PatchData& data) override;
  void draw_video(const PatchInputs& inputs, PatchData& data) override;

  // True if the ground at a grid point is above all nearer ground, as seen from the radar. False for a void.
  bool lit(int column, int row) const;

 private:
  // A triangle of the scene in the radar's frame (occluders.hpp).
  struct Face {
    Occluders::Corners corners;
    Occluders::Corners normals;  // unit normals at the corners
    std::size_t code = 0;        // surface material code

    Point3 normal() const {
      const Point3 raw = cross(corners[1] - corners[0], corners[2] - corners[0]);
      return 1.0 / std::sqrt(dot(raw, raw)) * raw;
    }
  };
  struct Ground;

  void read_column(const PatchEnvironment& terrain, int column);
  double tangent(double distance_m, double height_m) const;
  Point3 position(double distance_m, double turn_rad, double height_m) const;
  void read_tile(const scene::SceneView& scene, const scene::Tile& tile, SurfacePoint* surface);
  void lay_flat(const std::array<MapPoint, 3>& corners, double gamma, SurfacePoint* surface) const;
  void add_column(int column, const SurfacePoint* surface);
  void add_face(const Face& face);
  void add_facet(const Face& face, Point3 point, Point3 weights, double area_m2);
  bool seen(Point3 point) const;
  Ground below(Point3 point) const;
  Ground ground_at(Point3 point) const;
  void add(Point3 point, double cross_section_m2);

  radar::Fidelity fidelity_;
  physics::SceneSurface surface_;
  physics::GasPath gas_;
  double bounce_;  // double bounce: echo over wall and ground, relative to the wall's return; 0: none
  PowerPicture power_picture_;
  // Current map, set by begin().
  const PatchGeometry* geometry_ = nullptr;
  const PolarGrid* grid_ = nullptr;
  // The following three arrays are indexed by PolarGrid::at().
  std::vector<double> height_m_;  // above the map plane; NaN: void
  std::vector<double> top_m_;     // height_m_, raised to the line of sight over the crest before this row
  std::vector<double> horizon_;   // greatest tangent of elevation angle of all nearer ground
  std::vector<Face> faces_;
  Occluders occluders_;
  int size_ = 0;               // pixels per side of the image
  std::vector<double> power_;  // cross section [m^2] by pixel
};

}  // namespace yars::model::hrm
