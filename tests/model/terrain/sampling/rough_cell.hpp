// Cells for tests: heights given by a function of row and column, or random heights with seas, cliffs and voids.
#pragma once

#include <cstdint>
#include <functional>
#include <random>
#include <utility>
#include <vector>

#include "model/terrain/formats/cell.hpp"

namespace yars::test {

inline model::terrain::Cell cell_of(model::terrain::CellCorner corner, int rows, int columns,
                                    const std::function<int(int, int)>& height) {
  std::vector<std::int16_t> posts;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) posts.push_back(static_cast<std::int16_t>(height(row, column)));
  return {corner, rows, columns, posts};
}

// Heights [m]: a random walk between -300 and 4000 m, with patches of sea and of voids.
inline model::terrain::Cell rough_cell(model::terrain::CellCorner corner, int rows, int columns, unsigned seed) {
  std::mt19937 random(seed);
  int height = 200;
  return cell_of(corner, rows, columns, [&](int row, int column) {
    height += static_cast<int>(random() % 61) - 30;
    if (height < -300 || height > 4000) height = 100;
    if ((row / 5 + column / 7) % 6 == 0) return 0;
    if ((row / 4 + column / 3) % 11 == 0) return int{model::terrain::kVoidPost};
    return height;
  });
}

inline bool same_posts(const model::terrain::Cell& a, const model::terrain::Cell& b) {
  if (a.rows() != b.rows() || a.columns() != b.columns()) return false;
  for (int row = 0; row < a.rows(); ++row)
    for (int column = 0; column < a.columns(); ++column)
      if (a.post(row, column) != b.post(row, column)) return false;
  return true;
}

}  // namespace yars::test
