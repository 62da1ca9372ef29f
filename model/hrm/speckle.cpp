#include "model/hrm/speckle.hpp"

#include <cmath>

#include "lib/radar/map_formation.hpp"
#include "model/hrm/speckle_lanes.hpp"
#include "model/rbm/video_lanes.hpp"

namespace yars::model::hrm {

namespace {
constexpr std::size_t kSlack = 16;  // entries that vectors may touch behind a row
// Rows of cells count from -1: the first pixels lie before the middle of the first cell.
constexpr int kCellRows = radar::kCellsOfMap + 2;

std::size_t padded(std::size_t count) {
  return (count + kSlack - 1) / kSlack * kSlack;
}
}  // namespace

Speckle::Speckle(int size, int looks, std::uint64_t seed, std::uint32_t map)
    : size_(size),
      looks_(looks),
      seed_(seed),
      map_(map),
      finer_(size > radar::kCellsOfMap),
      pitch_(padded(static_cast<std::size_t>(size))),
      intensity_(pitch_ + kSlack) {
  if (!finer_) return;
  cell_.assign(pitch_, 0);
  first_.assign(pitch_, 0.0F);
  second_.assign(pitch_, 0.0F);
  for (int pixel = 0; pixel < size_; ++pixel) {
    const auto i = static_cast<std::size_t>(pixel);
    const Between place = between(pixel);
    cell_[i] = place.cell;
    first_[i] = place.first;
    second_[i] = place.second;
  }
  cells_.assign(2 * padded(kCellRows), 0.0F);
  near_.assign(2 * static_cast<std::size_t>(looks_) * pitch_, 0.0F);
  far_ = near_;
}

Speckle::Between Speckle::between(int pixel) const {
  const double place = (pixel + 0.5) * radar::kCellsOfMap / size_ - 0.5;
  const double cell = std::floor(place);
  const double second = place - cell;
  const double first = 1.0 - second;
  const double scale = 1.0 / std::sqrt(first * first + second * second);
  return {static_cast<std::int32_t>(cell) + 1, static_cast<float>(first * scale), static_cast<float>(second * scale)};
}

void Speckle::draw_cells(int cell_row, std::vector<float>& field) {
  const std::size_t half = cells_.size() / 2;
  for (int look = 0; look < looks_; ++look) {
    const auto name = static_cast<std::uint32_t>(cell_row * looks_ + look);
    lanes::draw_gaussian(half, rbm::make_noise_state({seed_, map_, name}), cells_.data(), &cells_[half]);
    float* real = &field[2 * static_cast<std::size_t>(look) * pitch_];
    lanes::interpolate(pitch_, {cell_.data(), first_.data(), second_.data()}, cells_.data(), real);
    lanes::interpolate(pitch_, {cell_.data(), first_.data(), second_.data()}, &cells_[half], real + pitch_);
  }
}

const float* Speckle::row(int row) {
  if (!finer_) {
    const auto name = static_cast<std::uint32_t>(row);
    rbm::lanes::speckle(static_cast<std::size_t>(size_), rbm::make_noise_state({seed_, map_, name}), looks_,
                        intensity_.data());
    return intensity_.data();
  }
  const Between place = between(row);
  while (drawn_ < place.cell + 1) {
    near_.swap(far_);
    drawn_ = drawn_ < place.cell ? place.cell : drawn_ + 1;
    draw_cells(drawn_, far_);
  }
  lanes::intensity(pitch_, looks_, {near_.data(), place.first}, {far_.data(), place.second}, intensity_.data());
  return intensity_.data();
}

}  // namespace yars::model::hrm
