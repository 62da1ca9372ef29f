// Impulse response of a patch map that is computed as power.
// Input, output: MapImage in the unit of map_image.hpp.
// Units: distances from a point in resolution cells or pixels, as named.
// Threads: Response::apply() uses its executor; one call at a time.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "lib/memory/line_vector.hpp"
#include "lib/parallel/thread_pool.hpp"
#include "model/hrm/map_image.hpp"
#include "model/hrm/map_image_simd.hpp"

namespace yars::model::hrm {

// Impulse response in range and azimuth: the power of a Taylor-weighted aperture. The weighting lowers the sidelobes;
// its parameter n-bar is 5. The half-power width is one resolution cell.
// Source: Carrara, Goodman, Majewski, "Spotlight SAR", D.2 (Taylor weighting); docs/spec/physics.md#response.
class Response {
 public:
  static constexpr std::size_t kSlabBytes = std::size_t{8} << 20U;

  // `sidelobe_db`: level of the highest sidelobes relative to the main lobe; its sign is ignored. `cells_per_pixel`:
  // width of a pixel in resolution cells.
  Response(double sidelobe_db, double cells_per_pixel);

  // Power at a distance [cells] from a point; 1 at the point.
  double power(double cells) const;

  // Convolves the image with the main lobe. A pixel is strong if its highest sidelobe exceeds the power `floor`. The
  // sidelobes of a strong pixel are added along its row and its column.
  // The main lobe conserves the sum of the image, except for power that leaves the image.
  // Memory beside the image: buffers of one slab of rows. `slab_bytes` limits the greatest of them, and changes no
  // result; a slab has at least 32 rows.
  void apply(float floor, const parallel::Executor& executor, MapImage& image, std::size_t slab_bytes = kSlabBytes);
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
  // Buffers of one worker: a row of the image with margins, a row of the result, padded rows of sidelobes to add.
  struct WorkerBuffers {
    memory::CacheAlignedVector<float> source, row, added;
  };
  void resize_buffers(const parallel::Executor& executor, const MapImage& image, std::size_t slab_bytes);
  void begin_slab(int first, int last, const parallel::Executor& executor, const MapImage& image);
  void smooth_along(int first, int last, WorkerBuffers& buffers, const MapImage& image);
  void smooth_down(int first, int last, WorkerBuffers& buffers, MapImage& image) const;
  void find_strong(float limit, int first, int last, WorkerBuffers& buffers, const MapImage& image);
  void spread(const StrongBlock& strong, std::size_t first, std::size_t last, float* added) const;
  void add_sidelobes(int first, int last, WorkerBuffers& buffers, MapImage& image) const;
  std::size_t main_radius() const { return main_lobe_.size() - 1; }
  // Row of the image, from main_radius() before the slab to main_radius() behind it, convolved along the row.
  std::size_t across_at(std::size_t row) const { return (row + main_radius() - slab_first_) * pitch_ + margin_; }
  // Strong blocks of kRowsPerTask rows.
  std::vector<StrongBlock>& run(std::size_t number) { return strong_[number % strong_.size()]; }
  const std::vector<StrongBlock>& run(std::size_t number) const { return strong_[number % strong_.size()]; }

  std::vector<double> coefficients_;  // cosine series of the weighting; the first is 1
  double stretch_ = 1.0;              // resolution cell in units of 1 / bandwidth
  double cells_per_pixel_;
  std::vector<float> main_lobe_;  // weights by pixel from the centre outwards; the sum over both sides is 1
  std::vector<float> sidelobes_;  // weights of the pixels beyond the main lobe, on the scale of main_lobe_
  std::vector<float> along_;      // sidelobes on both sides of a point at along_middle_; 0 within the main lobe
  std::size_t along_radius_ = 0, along_middle_ = 0;   // [blocks], [pixels]
  std::size_t margin_ = 0, columns_ = 0, pitch_ = 0;  // [pixels] padded rows: margin, inner width, full width
  std::size_t slab_rows_ = 0, slab_first_ = 0;        // rows of a slab; first row of the current one
  memory::CacheAlignedVector<float> across_;          // padded rows of the slab, by across_at()
  std::vector<WorkerBuffers> buffers_;                // by thread
  std::vector<std::vector<StrongBlock>> strong_;      // ring of runs: those whose sidelobes may still be added
};

}  // namespace yars::model::hrm
