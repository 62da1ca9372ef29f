// The impulse response of the synthetic array: what a point becomes, in range and in azimuth alike. Amplitude after
// Taylor (n-bar 5), scaled so that its half-power width is one resolution cell; on the map its square counts.
// Source: Carrara, Goodman, Majewski, "Spotlight SAR", D.2 (Taylor weighting); docs/spec/physics.md#response.
#pragma once

#include <array>
#include <vector>

#include "lib/memory/line_vector.hpp"
#include "model/hrm/crew.hpp"
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
  void apply(float floor, const Crew& crew, MapImage& image);
  // Weights of the pixels from `first` on for a point at this place [pixels]; sum 1.
  std::vector<float> weights(double pixel, int& first) const;

 private:
  void mirror_sidelobes();
  // A hand's own room: a row of the picture with its margins, a row of the result.
  struct Strong {
    std::size_t row, column;  // of the first
    std::array<float, lanes::kBlock> power;
  };
  struct Hand {
    memory::LineVector<float> source, row;
  };
  void make_room(const Crew& crew, const MapImage& image);
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

}  // namespace yars::model::hrm
