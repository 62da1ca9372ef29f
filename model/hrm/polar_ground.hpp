// The terrain under the columns of a fan: height, what it returns, and the horizon that the way from the aircraft to
// the first row has raised already. One instance a thread: it keeps the room for a column.
#pragma once

#include <memory>
#include <vector>

#include "lib/memory/line_vector.hpp"
#include "lib/radar/configuration.hpp"
#include "model/hrm/ground_detail.hpp"
#include "model/hrm/patch_geometry.hpp"
#include "model/physics/ground_return.hpp"
#include "model/physics/ray.hpp"
#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::model::hrm {

// What of the ground between neighbouring rows raises the horizon: lines of posts, where it is straight between posts,
// and summits of a curve through three rows, where it is smooth. Rows that are close to each other need neither.
struct CrestsBetweenRows {
  bool lines = false;
  bool summits = false;
  bool any() const { return lines || summits; }
};
// `smooth`: the ground of the window is, where posts lie far apart.
CrestsBetweenRows crests_between_rows(const PolarGrid& grid, const terrain::TerrainView& window, bool smooth);

// Of the window itself, and of the way to it, which may be coarser.
struct PatchTerrain {
  const terrain::TerrainView* window = nullptr;
  const terrain::TerrainView* path = nullptr;
  CrestsBetweenRows crests{};  // that GroundArrays::crest_m is asked for
};

// By PolarGrid::at(); the horizon by column.
struct GroundArrays {
  SurfacePoint* surface = nullptr;  // a void takes over its nearer neighbour's height (the first one's, where none is
                                    // nearer), and returns nothing
  float* horizon = nullptr;         // greatest (height - above) / distance before row 0
  // The ground on the way from the row before, raised to where a line of sight over its top passes this row: height
  // above the map plane; far below it where there is none. Null: not asked.
  float* crest_m = nullptr;
};

class PolarGround {
 public:
  explicit PolarGround(const radar::RadarConfiguration& configuration);

  // Before the first columns of a map.
  void begin(const PatchGeometry& geometry, const PolarGrid& grid, const terrain::TerrainView& path);
  // Fills the columns [first, last), whole strips; `detail` null: none. Returns how many samples met terrain that was
  // not loaded.
  std::size_t fill(const PatchOrder& order, const PatchGeometry& geometry, const PolarGrid& grid,
                   const PatchTerrain& terrain, const Detail* detail, int first, int last, const GroundArrays& arrays);

 private:
  // Room for a column of so many samples.
  struct Column {
    explicit Column(std::size_t samples);
    physics::PlaceArrays places;
    std::vector<float> distance_m, elevation_m, water, peak_m, crest;
  };
  // A line of sight at a distance over ground: tangent = (height cosine - above) / (chord + height sine).
  struct Sight {
    Sight(const PatchGeometry& geometry, double distance_m);
    float above_m, chord_m, sine, cosine;
  };
  int column_step(const PolarGrid& grid, const terrain::TerrainView& view, const Detail* detail) const;
  int path_step(const PolarGrid& grid, const terrain::TerrainView& view) const;
  std::size_t read_window(const PatchOrder& order, const PatchGeometry& geometry, geo::Bearing azimuth,
                          const terrain::TerrainView& view, const Detail* detail, std::size_t lane);
  std::size_t read_path(const PatchGeometry& geometry, const PolarGrid& grid, geo::Bearing azimuth,
                        const terrain::TerrainView& view, float& horizon);
  void read_crests(const PatchGeometry& geometry, const PatchTerrain& terrain, std::size_t lane);
  void raise_to_summits(const PatchGeometry& geometry, std::size_t lane);
  void level(const PatchGeometry& geometry, std::size_t lane);
  void fill_between(std::size_t step);
  void fetch_strip(const PolarGrid& grid, int column, const GroundArrays& arrays) const;
  void put_strip(const PolarGrid& grid, int strip, const GroundArrays& arrays) const;
  void put_crests(const PolarGrid& grid, int strip, float* crest_m) const;

  radar::RadarConfiguration configuration_;
  std::unique_ptr<Column> window_, path_;
  std::unique_ptr<physics::Ground> ground_;
  std::vector<float> sin_grazing_;                       // on the map plane, by row
  std::vector<Sight> path_sight_, row_sight_;            // by sample of the path and by row
  std::size_t pitch_ = 0;                                // of the columns of a strip in hand, as they were read
  memory::LineVector<float> strip_height_, strip_gain_;  // sixteen columns, one after the other
  memory::LineVector<float> strip_crest_;                // the same; only where crests are asked
  float plain_gamma_;                                    // of land without culture
};

}  // namespace yars::model::hrm
