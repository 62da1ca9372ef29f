// Last steps of a patch map that is computed as power: impulse response, point targets, video.
// Inputs: MapImage in the unit of map_image.hpp; point targets of the configuration and of the surface traffic.
// Outputs: the image with response and point targets; 8-bit video.
// Units: distances from a point in resolution cells or pixels, as named.
// Threads: Response::apply() uses its executor; one call at a time.
#pragma once

#include <array>
#include <vector>

#include "lib/memory/line_vector.hpp"
#include "lib/parallel/thread_pool.hpp"
#include "lib/radar/sensor.hpp"
#include "model/hrm/map_image.hpp"
#include "model/hrm/map_image_simd.hpp"
#include "model/hrm/patch_data.hpp"
#include "model/hrm/patch_geometry.hpp"
#include "model/physics/atmosphere.hpp"
#include "model/physics/environment.hpp"
#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::model::hrm {

// Impulse response in range and azimuth: the power of a Taylor-weighted aperture. The weighting lowers the sidelobes;
// its parameter n-bar is 5. The half-power width is one resolution cell.
// Source: Carrara, Goodman, Majewski, "Spotlight SAR", D.2 (Taylor weighting); docs/spec/physics.md#response.
class Response {
 public:
  // `sidelobe_db`: level of the highest sidelobes relative to the main lobe; its sign is ignored. `cells_per_pixel`:
  // width of a pixel in resolution cells.
  Response(double sidelobe_db, double cells_per_pixel);

  // Power at a distance [cells] from a point; 1 at the point.
  double power(double cells) const;

  // Convolves the image with the main lobe. A pixel is strong if its highest sidelobe exceeds the power `floor`. The
  // sidelobes of a strong pixel are added along its row and its column.
  // The main lobe conserves the sum of the image, except for power that leaves the image.
  void apply(float floor, const parallel::Executor& executor, MapImage& image);
  // Weights that spread a point at the fractional position `pixel` over a row or column; their sum is 1. Sets `first`,
  // the pixel of the first weight.
  std::vector<float> weights(double pixel, int& first) const;

 private:
  void mirror_sidelobes();
  // Block of kBlock pixels of a row, with at least one strong pixel.
  struct StrongBlock {
    std::size_t row, column;                // first pixel of the block
    std::array<float, simd::kBlock> power;  // 0 for pixels that are not strong
  };
  // Buffers of one worker: a row of the image with margins, a row of the result.
  struct WorkerBuffers {
    memory::CacheAlignedVector<float> source, row;
  };
  void resize_buffers(const parallel::Executor& executor, const MapImage& image);
  void smooth_along(int first, int last, WorkerBuffers& buffers, const MapImage& image);
  void smooth_down(int first, int last, WorkerBuffers& buffers, MapImage& image) const;
  void find_strong(float limit, int first, int last, WorkerBuffers& buffers, const MapImage& image);
  void spread(const StrongBlock& strong, std::size_t first, std::size_t last);
  void add_sidelobes(int first, int last, MapImage& image);
  // Index of the first pixel of an image row in a padded copy of the image.
  std::size_t padded(std::size_t row) const { return (row + margin_) * pitch_ + margin_; }

  std::vector<double> coefficients_;  // cosine series of the weighting; the first is 1
  double stretch_ = 1.0;              // resolution cell in units of 1 / bandwidth
  double cells_per_pixel_;
  std::vector<float> main_lobe_;  // weights by pixel from the centre outwards; the sum over both sides is 1
  std::vector<float> sidelobes_;  // weights of the pixels beyond the main lobe, on the scale of main_lobe_
  std::vector<float> along_;      // sidelobes on both sides of a point at along_middle_; 0 within the main lobe
  std::size_t along_radius_ = 0, along_middle_ = 0;   // [blocks], [pixels]
  std::size_t margin_ = 0, columns_ = 0, pitch_ = 0;  // [pixels] padded copies: margin, inner width, full width
  // Padded buffers, kept between maps: the image convolved along its rows, and the sidelobes to add.
  memory::CacheAlignedVector<float> across_, added_;
  std::vector<WorkerBuffers> buffers_;
  std::vector<std::vector<StrongBlock>> strong_;  // blocks with strong pixels; one element per kRowsPerTask rows
};

// Terrain and scene that can hide a point. Surface and crests are indexed by PolarGrid::at(), the horizon by column.
struct Horizons {
  const PolarGrid* grid = nullptr;
  const SurfacePoint* surface = nullptr;
  const float* crest_m = nullptr;  // as in GroundArrays::crest_m; null: none
  const float* horizon = nullptr;  // by column: greatest tangent of elevation of ground before row 0 of the grid
};

// Point targets on a map, moving or at rest (for example corner reflectors). The radial speed v_r, positive towards the
// radar, moves the apparent bearing towards the aircraft's ground track by v_r / (V sin(squint)) [rad]. V is the
// aircraft's ground speed, squint the target's bearing from the aircraft's ground track. At broadside and range R the
// shift is R v_r / V [m]. Motion during the formation time smears the image of a target.
// Source: docs/spec/physics.md#movers; Raney, "Synthetic Aperture Imaging Radar and Moving Targets" (1971).
class MapMovers {
 public:
  explicit MapMovers(const physics::RadarParameters& parameters);

  // Adds the points of configuration and traffic to the image, except hidden points and points over ground without a
  // known elevation.
  void draw(const PatchOrder& order, const PatchGeometry& geometry, geo::Duration formation,
            const physics::Environment& environment, const Horizons& horizons, const Response& response,
            MapImage& image) const;

 private:
  struct Trace {
    MapPoint from, to;  // ends of the smeared image of a target on the map
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

// For algorithms that compute power: the last part of the stage `map`, and the stage `video`. The video always has
// thermal noise. It has speckle only if the fidelity's `noise` is on.
class PowerPicture {
 public:
  explicit PowerPicture(const physics::RadarParameters& parameters);

  // Applies the response if the fidelity's `map_response` is on. Adds point targets, moving or at rest.
  void add_response_and_movers(const PatchInputs& inputs, PatchData& data);
  void draw_video(const PatchInputs& inputs, PatchData& data) const;

 private:
  double thermal_noise(const PatchInputs& inputs, const PatchData& data) const;

  radar::HighResolutionConfiguration high_resolution_;
  std::uint64_t seed_;
  bool with_speckle_, with_response_;
  MapMovers movers_;
  Response response_;
};

}  // namespace yars::model::hrm
