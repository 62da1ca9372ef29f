#include "model/terrain/gdal/height_window.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>

namespace yars::model::terrain::gdal {

namespace {

// [m] MSL; the same as for other cells (cell_reading.cpp).
constexpr double kLowest_m = -12'000.0;
constexpr double kHighest_m = 10'000.0;
constexpr float kUsualVoids[] = {-32768.0F, -32767.0F, -9999.0F};
constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();
constexpr float kImpossible = std::numeric_limits<float>::infinity();

class Judge {
 public:
  explicit Judge(const Raster& raster)
      : scale_(raster.scale),
        offset_m_(raster.offset_m),
        void_number_(raster.void_number ? static_cast<float>(*raster.void_number) : kNothing) {}

  float operator()(float number) const {
    if (std::isnan(number) || number == void_number_) return kNothing;
    const double height_m = static_cast<double>(number) * scale_ + offset_m_;
    const bool height = height_m >= kLowest_m && height_m <= kHighest_m && height_m != kUsualVoid_m &&
                        std::find(std::begin(kUsualVoids), std::end(kUsualVoids), number) == std::end(kUsualVoids);
    return height ? static_cast<float>(height_m) : kImpossible;
  }

 private:
  static constexpr double kUsualVoid_m = -9999.0;
  double scale_, offset_m_;
  float void_number_;
};

// Sums over the blocks of a window, added to as pixels come.
class Means {
 public:
  Means(BlockSize size, const Box& blocks, const Box& counted)
      : size_(size), counted_(counted), window_{blocks, {}, 0}, sums_m_(blocks.area()), counts_(blocks.area()) {}

  void add(const std::vector<float>& heights_m, const Box& pixels) {
    std::size_t pixel = 0;
    for (int row = pixels.first_row; row < pixels.first_row + pixels.rows; ++row)
      for (int column = pixels.first_column; column < pixels.first_column + pixels.columns; ++column)
        add(column / size_.across, row / size_.along, heights_m[pixel++]);
  }

  HeightWindow take() {
    window_.height_m.reserve(sums_m_.size());
    for (std::size_t block = 0; block < sums_m_.size(); ++block)
      window_.height_m.push_back(counts_[block] == 0 ? kNothing : static_cast<float>(sums_m_[block] / counts_[block]));
    return std::move(window_);
  }

 private:
  void add(int column, int row, float height_m) {
    if (std::isfinite(height_m)) {
      const Box& blocks = window_.blocks;
      const auto block = static_cast<std::size_t>(row - blocks.first_row) * static_cast<std::size_t>(blocks.columns) +
                         static_cast<std::size_t>(column - blocks.first_column);
      sums_m_[block] += static_cast<double>(height_m);
      ++counts_[block];
    } else if (std::isinf(height_m) && column >= counted_.first_column && row >= counted_.first_row &&
               column < counted_.first_column + counted_.columns && row < counted_.first_row + counted_.rows) {
      ++window_.impossible;
    }
  }

  BlockSize size_;
  Box counted_;
  HeightWindow window_;
  std::vector<double> sums_m_;
  std::vector<int> counts_;
};

}  // namespace

failure::Expected<std::vector<float>> read_heights(const Raster& raster, const Box& pixels) {
  const MessageKeeper messages;
  std::vector<float> heights(pixels.area());
  std::vector<std::uint8_t> valid(raster.masked ? heights.size() : 0);
  const auto read = [&](GDALRasterBandH band, void* into, GDALDataType type) {
    return GDALRasterIO(band, GF_Read, pixels.first_column, pixels.first_row, pixels.columns, pixels.rows, into,
                        pixels.columns, pixels.rows, type, 0, 0) == CE_None;
  };
  if (!read(raster.heights, heights.data(), GDT_Float32) ||
      (raster.masked && !read(GDALGetMaskBand(raster.heights), valid.data(), GDT_Byte)))
    return failure::fail(raster.subject, "heights that can be read", messages.first_or("a failure of GDAL"),
                         "the file may be damaged; fetch it again");
  std::transform(heights.begin(), heights.end(), heights.begin(), Judge(raster));
  for (std::size_t i = 0; i < valid.size(); ++i)
    if (valid[i] == 0) heights[i] = kNothing;
  return heights;
}

failure::Expected<HeightWindow> read_window(const Raster& raster, BlockSize size, const Box& blocks,
                                            const Box& counted) {
  Means means(size, blocks, counted);
  Box pixels;
  pixels.first_column = blocks.first_column * size.across;
  pixels.columns = std::min(raster.columns, (blocks.first_column + blocks.columns) * size.across) - pixels.first_column;
  // Strips, so that the pixels of large blocks never stand whole in memory.
  constexpr int kMostPixels = 1 << 22;
  const int rows_at_once = std::max(1, kMostPixels / std::max(1, pixels.columns));
  const int end_row = std::min(raster.rows, (blocks.first_row + blocks.rows) * size.along);
  for (pixels.first_row = blocks.first_row * size.along; pixels.first_row < end_row; pixels.first_row += rows_at_once) {
    pixels.rows = std::min(rows_at_once, end_row - pixels.first_row);
    const auto heights = read_heights(raster, pixels);
    if (!heights) return tl::unexpected(heights.error());
    means.add(*heights, pixels);
  }
  return means.take();
}

}  // namespace yars::model::terrain::gdal
