#include "model/terrain/bilinear.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace yars::model::terrain {

namespace {

constexpr std::size_t kBlock = 128;  // places a pass: its scratch stays in the first-level cache

// Where a block's places lie between posts, and the four posts of each.
struct Block {
  std::array<std::int32_t, kBlock> south_west;  // index of the post south-west of the place
  std::array<float, kBlock> north, east;        // [0, 1] from that post to the next
  std::array<float, kBlock> south_west_m, south_east_m, north_west_m, north_east_m;
};

void locate(const Cell& cell, double shift_deg, const double* latitude_deg, const double* longitude_deg,
            std::size_t count, Block& block) {
  const double south_deg = cell.place().south_deg;
  const double west_deg = cell.place().west_deg - shift_deg;
  const std::int32_t columns = cell.columns();
  const std::int32_t last_row = cell.rows() - 2;
  const std::int32_t last_column = columns - 2;
  for (std::size_t i = 0; i < count; ++i) {
    const double row = std::clamp(latitude_deg[i] - south_deg, 0.0, 1.0) * (last_row + 1);
    const double column = std::clamp(longitude_deg[i] - west_deg, 0.0, 1.0) * (last_column + 1);
    const std::int32_t south = std::min(static_cast<std::int32_t>(row), last_row);
    const std::int32_t west = std::min(static_cast<std::int32_t>(column), last_column);
    block.south_west[i] = south * columns + west;
    block.north[i] = static_cast<float>(row - south);
    block.east[i] = static_cast<float>(column - west);
  }
}

void gather(const Cell& cell, std::size_t count, Block& block) {
  const std::int16_t* const posts = cell.posts().data();
  const std::int32_t columns = cell.columns();
  for (std::size_t i = 0; i < count; ++i) {
    const std::int16_t* const post = posts + block.south_west[i];
    block.south_west_m[i] = post[0];
    block.south_east_m[i] = post[1];
    block.north_west_m[i] = post[columns];
    block.north_east_m[i] = post[columns + 1];
  }
}

void blend(const Block& block, std::size_t count, float* elevation_m) {
  for (std::size_t i = 0; i < count; ++i) {
    const float south_m = block.south_west_m[i] + block.east[i] * (block.south_east_m[i] - block.south_west_m[i]);
    const float north_m = block.north_west_m[i] + block.east[i] * (block.north_east_m[i] - block.north_west_m[i]);
    elevation_m[i] = south_m + block.north[i] * (north_m - south_m);
  }
}

void blend_water(const Block& block, std::size_t count, float* water) {
  const auto at_sea = [](float post_m) { return post_m == 0.0F ? 1.0F : 0.0F; };
  for (std::size_t i = 0; i < count; ++i) {
    const float south_west = at_sea(block.south_west_m[i]);
    const float north_west = at_sea(block.north_west_m[i]);
    const float south = south_west + block.east[i] * (at_sea(block.south_east_m[i]) - south_west);
    const float north = north_west + block.east[i] * (at_sea(block.north_east_m[i]) - north_west);
    water[i] = south + block.north[i] * (north - south);
  }
}

}  // namespace

Surface interpolate(const Cell& cell, double north_deg, double east_deg) {
  const double row = std::clamp(north_deg, 0.0, 1.0) * (cell.rows() - 1);
  const double column = std::clamp(east_deg, 0.0, 1.0) * (cell.columns() - 1);
  const int south = std::min(static_cast<int>(row), cell.rows() - 2);
  const int west = std::min(static_cast<int>(column), cell.columns() - 2);
  double total = 0.0;
  double height_m = 0.0;
  double water = 0.0;
  for (const int up : {0, 1})
    for (const int right : {0, 1}) {
      const std::int16_t post_m = cell.post(south + up, west + right);
      if (post_m == kVoidPost) continue;
      const double along = row - south;
      const double across = column - west;
      const double weight = (up == 1 ? along : 1 - along) * (right == 1 ? across : 1 - across);
      total += weight;
      height_m += weight * post_m;
      if (post_m == 0) water += weight;
    }
  if (total <= 0.0) return {std::numeric_limits<double>::quiet_NaN(), 0.0, 0};
  return {height_m / total, water / total, 0};
}

void interpolate_run(const Cell& cell, double shift_deg, std::span<const double> latitude_deg,
                     std::span<const double> longitude_deg, std::span<float> elevation_m, std::span<float> water) {
  const std::size_t places = latitude_deg.size();
  if (cell.voids() > 0) {
    for (std::size_t i = 0; i < places; ++i) {
      const Surface surface = interpolate(cell, latitude_deg[i] - cell.place().south_deg,
                                          longitude_deg[i] + shift_deg - cell.place().west_deg);
      elevation_m[i] = static_cast<float>(surface.elevation_m);
      water[i] = static_cast<float>(surface.water);
    }
    return;
  }
  Block block;
  for (std::size_t start = 0; start < places; start += kBlock) {
    const std::size_t count = std::min(kBlock, places - start);
    locate(cell, shift_deg, &latitude_deg[start], &longitude_deg[start], count, block);
    gather(cell, count, block);
    blend(block, count, &elevation_m[start]);
    if (cell.sea_posts() > 0)
      blend_water(block, count, &water[start]);
    else
      std::fill_n(&water[start], count, 0.0F);
  }
}

}  // namespace yars::model::terrain
