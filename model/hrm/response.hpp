// The impulse response of the synthetic array: what a point becomes, in range and in azimuth alike. Amplitude after
// Taylor (n-bar 5), scaled so that its half-power width is one resolution cell; on the map its square counts.
// Source: Carrara, Goodman, Majewski, "Spotlight SAR", D.2 (Taylor weighting); spec physics.md "HRM".
#pragma once

#include <array>
#include <vector>

#include "lib/memory/line_vector.hpp"
#include "model/hrm/map_image.hpp"
#include "model/hrm/response_lanes.hpp"

namespace yars::model::hrm {

class Response {
 public:
  // `cells_a_pixel`: resolution cells that a pixel is wide.
  Response(double sidelobe_db, double cells_a_pixel);

  // Power at a distance from a point [cells], 1 at the point itself.
  double power(double cells) const;

  // Every pixel spreads over the main lobe; those so strong that their sidelobes rise above `floor`, over these too.
  // The sum over the picture stays, but for what leaves it.
  void apply(float floor, MapImage& image);
  // Weights of the pixels from `first` on for a point at this place [pixels]; sum 1.
  std::vector<float> weights(double pixel, int& first) const;

 private:
  void mirror_sidelobes();
  void make_room(const MapImage& image);
  void smooth(MapImage& image);
  void add_sidelobes(float floor, MapImage& image);
  void find_strong(float limit, const MapImage& image);
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
  struct Strong {
    std::size_t row, column;  // of the first
    std::array<float, lanes::kBlock> power;
  };
  // Kept between maps: the picture spread along its rows; what sidelobes add to it; a row of the picture with its
  // margins; a row of the result; where the strong points are.
  memory::LineVector<float> across_, added_, source_, row_;
  std::vector<Strong> strong_;
};

}  // namespace yars::model::hrm
