// The algorithm `reference` of patches, the oracle of `standard`: plain double precision, facet by facet. Terrain is a
// fan of pieces finer than a pixel at exact geodesic places; a scene is its triangles, cut until they are smaller than
// a third of a pixel. What is seen adds gamma times the area seen square on at the place on the map that is as far
// from the radar on the effective earth. Terrain hides by the running maximum along its column, a tenth of
// the posts' spacing at a time; the scene hides by rays.
#pragma once

#include <vector>

#include "model/hrm/map_image.hpp"
#include "model/hrm/occluders.hpp"
#include "model/hrm/patch_geometry.hpp"
#include "model/hrm/polar_ground.hpp"
#include "model/physics/atmosphere.hpp"
#include "model/physics/reflectivity.hpp"
#include "model/scene/placement/scene_view.hpp"

namespace yars::model::hrm {

inline constexpr int kReferenceCells = 3;  // of its fan a pixel, along and across

class ReferencePatch {
 public:
  ReferencePatch(const radar::RadarConfiguration& configuration, const PatchGeometry& geometry, const PolarGrid& grid);

  void read_terrain(const PatchTerrain& terrain);
  // Whether no nearer ground on its line of sight stands as high as that of a point of the grid; false for a void.
  bool lit(int column, int row) const;
  // `gain`: gamma of the ground by PolarGrid::at(); what lies flat on it gives it its own.
  void read_scene(const scene::SceneView& scene, const std::vector<const scene::Tile*>& tiles, SurfacePoint* surface);
  // Replaces the power of the image, in the unit of map_image.hpp.
  void accumulate(const SurfacePoint* surface, MapImage& image);

 private:
  // A face of the scene about the radar.
  struct Face {
    Occluders::Corners corners;
    Occluders::Corners normals;  // unit, at the corners
    std::size_t code = 0;        // of its material

    Point3 normal() const {
      const Point3 raw = cross(corners[1] - corners[0], corners[2] - corners[0]);
      return 1.0 / std::sqrt(dot(raw, raw)) * raw;
    }
  };
  struct Ground;

  void read_column(const PatchTerrain& terrain, int column);
  double tangent(double distance_m, double height_m) const;
  Point3 position(double distance_m, double turn_rad, double height_m) const;
  void read_tile(const scene::SceneView& scene, const scene::Tile& tile, SurfacePoint* surface);
  void lay_flat(const std::array<MapPoint, 3>& corners, double gamma, SurfacePoint* surface) const;
  void add_column(int column, const SurfacePoint* surface);
  void add_face(const Face& face);
  void add_facet(const Face& face, Point3 place, Point3 weights, double area_m2);
  bool seen(Point3 place) const;
  Ground below(Point3 place) const;
  Ground ground_at(Point3 place) const;
  void add(Point3 place, double cross_section_m2);

  radar::Fidelity fidelity_;
  physics::SceneSurface surface_;
  physics::GasPath gas_;
  double bounce_;  // of a wall's foot against the wall; 0 = none
  const PatchGeometry* geometry_;
  const PolarGrid* grid_;
  // By PolarGrid::at().
  std::vector<double> height_m_;  // above the map plane; NaN = void
  std::vector<double> top_m_;    // the same, raised to the line of sight over the ground on the way from the row before
  std::vector<double> horizon_;  // greatest tangent of all that is nearer
  std::vector<Face> faces_;
  Occluders occluders_;
  int size_ = 0;
  std::vector<double> power_;
};

}  // namespace yars::model::hrm
