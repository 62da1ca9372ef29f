// Response of points on a map: impulse response of the array, and moving targets.
#pragma once

#include <array>
#include <vector>

#include "lib/memory/line_vector.hpp"
#include "lib/parallel/thread_pool.hpp"
#include "lib/radar/configuration.hpp"
#include "model/hrm/map_image.hpp"
#include "model/hrm/map_image_simd.hpp"
#include "model/hrm/patch_geometry.hpp"
#include "model/physics/atmosphere.hpp"
#include "model/physics/environment.hpp"
#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::model::hrm {

// The impulse response of the synthetic array: what a point becomes, in range and in azimuth alike. Amplitude after
// Taylor (n-bar 5), scaled so that its half-power width is one resolution cell; on the map its square counts.
// Source: Carrara, Goodman, Majewski, "Spotlight SAR", D.2 (Taylor weighting); docs/spec/physics.md#response.
class Response {
 public:
  // `cells_a_pixel`: resolution cells that a pixel is wide.
  Response(double sidelobe_db, double cells_a_pixel);

  // Power at a distance from a point [cells], 1 at the point itself.
  double power(double cells) const;

  // Every pixel spreads over the main lobe; those so strong that their sidelobes rise above `floor`, over these too.
  // The sum over the picture stays, but for what leaves it.
  void apply(float floor, const parallel::Executor& crew, MapImage& image);
  // Weights of the pixels from `first` on for a point at this place [pixels]; sum 1.
  std::vector<float> weights(double pixel, int& first) const;

 private:
  void mirror_sidelobes();
  struct Strong {
    std::size_t row, column;  // of the first
    std::array<float, simd::kBlock> power;
  };
  // A hand's own room: a row of the picture with its margins, a row of the result.
  struct Hand {
    memory::LineVector<float> source, row;
  };
  void make_room(const parallel::Executor& crew, const MapImage& image);
  void smooth_along(int first, int last, Hand& hand, const MapImage& image);
  void smooth_down(int first, int last, Hand& hand, MapImage& image) const;
  void find_strong(float limit, int first, int last, Hand& hand, const MapImage& image);
  void spread(const Strong& strong, std::size_t first, std::size_t last);
  void add_sidelobes(int first, int last, MapImage& image);
  // Where a row of the image begins in a copy of it.
  std::size_t padded(std::size_t row) const { return (row + margin_) * pitch_ + margin_; }

  std::vector<double> coefficients_;  // of the weighting's cosine series, 1 first
  double stretch_ = 1.0;              // 1 / bandwidth of an unweighted array, in cells
  double cells_a_pixel_;
  std::vector<float> main_lobe_;  // from the middle outwards, pixels; with their mirror image the sum is 1
  std::vector<float> sidelobes_;  // behind them; likewise against a sum of 1
  std::vector<float> along_;  // the same on both sides of a point, its middle at along_middle_; 0 where main_lobe_ is
  std::size_t along_reach_ = 0, along_middle_ = 0;  // [blocks], [pixels]
  std::size_t margin_ = 0, columns_ = 0, pitch_ = 0;
  // Kept between maps: the picture spread along its rows, and what sidelobes add to it.
  memory::LineVector<float> across_, added_;
  std::vector<Hand> hands_;
  std::vector<std::vector<Strong>> strong_;  // points, by runs of rows
};

// What stands in the way of a point: highest tangent of all that is nearer, by column and row of the fan.
struct Horizons {
  const PolarGrid* grid = nullptr;
  const SurfacePoint* surface = nullptr;
  const float* crest_m = nullptr;  // as simd::Strip has it; null: none
  const float* horizon = nullptr;  // before row 0
};

// Moving targets, and points that stand (a corner reflector is one), on a map: displaced along the track by what their
// radial speed adds to the Doppler, and smeared over the time that the map takes. Radial speed v_r, positive towards
// the radar, shifts the bearing by v_r / (V sin(squint)) forwards: R v_r / V across a broadside line of sight.
// Source: docs/spec/physics.md#movers; Raney, "Synthetic Aperture Imaging Radar and Moving Targets" (1971).
class MapMovers {
 public:
  explicit MapMovers(const radar::RadarConfiguration& configuration);

  // Those of the configuration and of the traffic.
  void draw(const PatchOrder& order, const PatchGeometry& geometry, geo::Duration formation,
            const physics::Environment& database, const Horizons& horizons, const Response& response,
            MapImage& image) const;

 private:
  struct Trace {
    MapPoint from, to;  // on the map, where it appears at the start and at the end
  };
  void draw_point(const physics::MovingPoint& mover, const PatchOrder& order, const PatchGeometry& geometry,
                  geo::Duration formation, const terrain::TerrainView& terrain, const Horizons& horizons,
                  const Response& response, MapImage& image) const;
  Trace trace_of(const physics::MovingPoint& mover, const PatchOrder& order, const PatchGeometry& geometry,
                 geo::Duration formation, double height_m) const;
  bool hidden(const PatchGeometry& geometry, const Horizons& horizons, MapPoint point, double height_m) const;

  physics::GasPath gas_;
  std::vector<physics::MovingPoint> points_;
};

}  // namespace yars::model::hrm
