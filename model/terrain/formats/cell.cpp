#include "model/terrain/formats/cell.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "lib/error/error.hpp"

namespace yars::model::terrain {

namespace {
// Number of blocks that cover the intervals between posts, rounded up.
int blocks_over(int intervals, int step) {
  return (intervals + step - 1) / step;
}
}  // namespace

template <class Post>
Blocks<Post>::Blocks(int rows, int columns, std::span<const Post> posts)
    : block_rows_(blocks_over(rows - 1, kRowStep)), block_columns_(blocks_over(columns - 1, kColumnStep)) {
  YARS_REQUIRE(rows, >=, 2);
  YARS_REQUIRE(columns, >=, 2);
  YARS_REQUIRE(posts.size(), ==, static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns));
  blocks_.reserve(static_cast<std::size_t>(block_rows_) * static_cast<std::size_t>(block_columns_) + 1);
  // Number of blocks of a block row that do not extend beyond the last column.
  const int whole_columns = columns >= kColumns ? (columns - kColumns) / kColumnStep + 1 : 0;
  for (int block_row = 0; block_row < block_rows_; ++block_row) {
    std::array<const Post*, kRows> lines;
    for (int line = 0; line < kRows; ++line) {
      // In the last blocks, entries beyond the grid repeat the edge of the grid. No caller reads these entries.
      const int row = std::min(block_row * kRowStep + line, rows - 1);
      lines[static_cast<std::size_t>(line)] = posts.data() + static_cast<std::ptrdiff_t>(row) * columns;
    }
    Block block;
    for (int block_column = 0; block_column < block_columns_; ++block_column) {
      const int first = block_column * kColumnStep;
      Post* entry = block.posts.data();
      if (block_column < whole_columns)
        for (const Post* line : lines) entry = std::copy_n(line + first, kColumns, entry);
      else
        for (const Post* line : lines)
          for (int column = first; column < first + kColumns; ++column) *entry++ = line[std::min(column, columns - 1)];
      blocks_.push_back(block);
    }
  }
  blocks_.push_back(Block{});
}

template <class Post>
void Blocks<Post>::copy_row(int row, std::span<Post> posts) const {
  const int block_row = std::min(row / kRowStep, block_rows_ - 1);
  auto block = blocks_.begin() + static_cast<std::ptrdiff_t>(block_row) * block_columns_;
  const int first = (row - block_row * kRowStep) * kColumns;
  for (std::span<Post> rest = posts; !rest.empty(); ++block) {
    // The last post of a block is also the first of the next one, if there is a next one.
    const std::size_t count = std::min<std::size_t>(rest.size() > kColumns ? kColumnStep : kColumns, rest.size());
    std::copy_n(block->posts.begin() + first, count, rest.begin());
    rest = rest.subspan(count);
  }
}

template class Blocks<std::int16_t>;
template class Blocks<std::uint8_t>;

Ceilings::Ceilings(int rows, int columns, std::span<const std::int16_t> posts)
    : tile_rows_(blocks_over(rows - 1, kTile)), tile_columns_(blocks_over(columns - 1, kTile)) {
  // Maximum of squares of kReach x kReach posts. A tile with its surroundings is four by four of them.
  static_assert(kTile == 2 * kReach);
  const int square_rows = blocks_over(rows, kReach), square_columns = blocks_over(columns, kReach);
  std::vector<std::int16_t> squares(static_cast<std::size_t>(square_rows) * static_cast<std::size_t>(square_columns));
  std::vector<std::int16_t> column_peaks(static_cast<std::size_t>(columns));
  for (int square_row = 0; square_row < square_rows; ++square_row) {
    const int first = square_row * kReach;
    std::fill(column_peaks.begin(), column_peaks.end(), std::numeric_limits<std::int16_t>::min());
    for (int row = first; row < std::min(first + kReach, rows); ++row) {
      const auto line = posts.subspan(static_cast<std::size_t>(row) * static_cast<std::size_t>(columns));
      for (std::size_t column = 0; column < column_peaks.size(); ++column)
        column_peaks[column] = std::max(column_peaks[column], line[column]);
    }
    for (int square_column = 0; square_column < square_columns; ++square_column) {
      const auto from = column_peaks.begin() + square_column * kReach;
      const auto to = column_peaks.begin() + std::min((square_column + 1) * kReach, columns);
      squares[static_cast<std::size_t>(square_row) * static_cast<std::size_t>(square_columns) +
              static_cast<std::size_t>(square_column)] = *std::max_element(from, to);
    }
  }
  for (int tile_row = 0; tile_row < tile_rows_; ++tile_row)
    for (int tile_column = 0; tile_column < tile_columns_; ++tile_column) {
      std::int16_t highest = std::numeric_limits<std::int16_t>::min();
      for (int row = std::max(2 * tile_row - 1, 0); row < std::min(2 * tile_row + 3, square_rows); ++row)
        for (int column = std::max(2 * tile_column - 1, 0); column < std::min(2 * tile_column + 3, square_columns);
             ++column)
          highest = std::max(highest, squares[static_cast<std::size_t>(row) * static_cast<std::size_t>(square_columns) +
                                              static_cast<std::size_t>(column)]);
      highest_.push_back(highest);
    }
}

CellCorner cell_containing(geo::GeoPoint point) {
  const double latitude_deg = std::clamp(point.latitude_deg, -90.0, 90.0);
  const double longitude_deg = geo::wrapped_degrees(point.longitude_deg);
  // The north pole belongs to the last row. Rounding may lift a longitude just below 180 to 180.
  return {std::min(static_cast<int>(std::floor(latitude_deg)), 89),
          std::min(static_cast<int>(std::floor(longitude_deg)), 179)};
}

Cell::Cell(CellCorner corner, int rows, int columns, const std::vector<std::int16_t>& posts, double unit_m)
    : corner_(corner),
      rows_(rows),
      columns_(columns),
      unit_m_(unit_m),
      blocks_(rows, columns, posts),
      ceilings_(rows, columns, posts) {
  YARS_REQUIRE(unit_m, >, 0.0);
  YARS_REQUIRE(columns, <=, static_cast<int>(UINT16_MAX));
  static_assert(kVoidPost == INT16_MIN, "a void is below every height");
  std::int16_t lowest_less_1 = INT16_MAX, highest = kVoidPost;
  for (std::span<const std::int16_t> rest = posts; !rest.empty();) {
    const auto line = rest.first(static_cast<std::size_t>(columns));
    rest = rest.subspan(line.size());
    // Counts of one row fit 16 bits, so that a SIMD register counts as many posts at a time as it holds.
    std::uint16_t voids = 0, sea_posts = 0;
    for (const std::int16_t post : line) {
      voids = static_cast<std::uint16_t>(voids + (post == kVoidPost ? 1U : 0U));
      sea_posts = static_cast<std::uint16_t>(sea_posts + (post == 0 ? 1U : 0U));
      // Less 1, a void wraps to above every height, without a condition that would keep the compiler from using SIMD.
      lowest_less_1 = std::min(lowest_less_1, static_cast<std::int16_t>(static_cast<std::uint16_t>(post) - 1U));
      highest = std::max(highest, post);
    }
    voids_ += voids;
    sea_posts_ += sea_posts;
  }
  if (voids_ == posts.size()) return;
  lowest_ = static_cast<std::int16_t>(lowest_less_1 + 1);
  highest_ = highest;
}

std::vector<std::int16_t> Cell::posts() const {
  std::vector<std::int16_t> posts(post_count());
  for (int row = 0; row < rows_; ++row)
    blocks_.copy_row(row, std::span(posts).subspan(static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_),
                                                   static_cast<std::size_t>(columns_)));
  return posts;
}

Cell in_whole_metres(const Cell& cell) {
  std::vector<std::int16_t> posts = cell.posts();
  for (std::int16_t& post : posts) {
    if (post == kVoidPost || post == 0) continue;
    const long metres = std::lround(post * cell.unit_m());
    post = static_cast<std::int16_t>(metres != 0 ? metres : post > 0 ? 1 : -1);
  }
  return {cell.corner(), cell.rows(), cell.columns(), posts};
}

namespace {

// Range of fine posts, both ends included, that one coarse post covers along one dimension.
struct Window {
  int first;
  int last;
};

Window mean_window(int coarse, int posts, int factor) {
  const int middle = coarse * factor;
  if (middle == 0 || middle == posts - 1) return {middle, middle};
  return {middle - factor / 2, middle + factor / 2};
}

Window peak_window(int coarse, int posts, int factor) {
  return {std::max(0, coarse * factor - factor + 1), std::min(posts - 1, coarse * factor + factor - 1)};
}

// Weight of a fine post in a mean: 1 if the post lies midway between two coarse posts, else 2.
int weight(int post, Window window, int factor) {
  const bool shared = factor % 2 == 0 && window.first != window.last && (post == window.first || post == window.last);
  return shared ? 1 : 2;
}

// Weighted sums over the posts of one window. Voids are left out.
struct Sums {
  std::int64_t height = 0;  // [unit_m of the cell] weight * post
  std::int64_t weight = 0;  // sum of the weights of posts that have a height
  std::int64_t sea = 0;     // sum of the weights of posts at exactly 0 m
};

std::int16_t mean_of(const Sums& sums) {
  if (sums.weight == 0) return kVoidPost;
  if (2 * sums.sea > sums.weight) return 0;
  const std::int64_t half = sums.height < 0 ? -sums.weight / 2 : sums.weight / 2;
  const std::int64_t rounded = (sums.height + half) / sums.weight;
  if (rounded != 0) return static_cast<std::int16_t>(rounded);
  return sums.height < 0 ? std::int16_t{-1} : std::int16_t{1};
}

// Numbers of posts of a coarser grid, and the numbers of fine intervals in one of its intervals.
struct CoarseGrid {
  int rows, columns;
  int row_factor, column_factor;
};

// Sums of each column over the rows of a window. A sum is at most 2 * 7200 posts, so that 32 bits hold it.
struct ColumnSums {
  explicit ColumnSums(int columns)
      : posts(static_cast<std::size_t>(columns)), height(posts.size()), weight(posts.size()), sea(posts.size()) {}
  void add(int row_weight) {
    for (std::size_t column = 0; column < posts.size(); ++column) {
      const std::int32_t post = posts[column];
      const std::int32_t counted = post != kVoidPost ? row_weight : 0;
      height[column] += counted * post;
      weight[column] += counted;
      sea[column] += post == 0 ? row_weight : 0;
    }
  }
  void clear() {
    for (auto* sums : {&height, &weight, &sea}) std::fill(sums->begin(), sums->end(), 0);
  }
  std::vector<std::int16_t> posts;  // of the row to be added
  std::vector<std::int32_t> height, weight, sea;
};

void append_mean_row(const Cell& cell, const CoarseGrid& grid, int coarse_row, ColumnSums& sums,
                     std::vector<std::int16_t>& means) {
  const Window rows = mean_window(coarse_row, cell.rows(), grid.row_factor);
  sums.clear();
  for (int row = rows.first; row <= rows.last; ++row) {
    cell.blocks().copy_row(row, sums.posts);
    sums.add(weight(row, rows, grid.row_factor));
  }
  for (int coarse = 0; coarse < grid.columns; ++coarse) {
    const Window columns = mean_window(coarse, cell.columns(), grid.column_factor);
    Sums total;
    for (int column = columns.first; column <= columns.last; ++column) {
      const std::int64_t column_weight = weight(column, columns, grid.column_factor);
      const auto at = static_cast<std::size_t>(column);
      total.height += column_weight * sums.height[at];
      total.weight += column_weight * sums.weight[at];
      total.sea += column_weight * sums.sea[at];
    }
    means.push_back(mean_of(total));
  }
}

void append_peak_row(const Cell& cell, const CoarseGrid& grid, int coarse_row, std::vector<std::int16_t>& column_peaks,
                     std::vector<std::int16_t>& peaks) {
  static_assert(kVoidPost == INT16_MIN, "a void is below every height");
  const Window rows = peak_window(coarse_row, cell.rows(), grid.row_factor);
  std::fill(column_peaks.begin(), column_peaks.end(), kVoidPost);
  std::vector<std::int16_t> posts(column_peaks.size());
  for (int row = rows.first; row <= rows.last; ++row) {
    cell.blocks().copy_row(row, posts);
    for (std::size_t column = 0; column < posts.size(); ++column)
      column_peaks[column] = std::max(column_peaks[column], posts[column]);
  }
  for (int coarse = 0; coarse < grid.columns; ++coarse) {
    const Window columns = peak_window(coarse, cell.columns(), grid.column_factor);
    peaks.push_back(*std::max_element(column_peaks.begin() + columns.first, column_peaks.begin() + columns.last + 1));
  }
}

}  // namespace

int halvings(int posts) {
  YARS_REQUIRE(posts, >=, 2);
  int count = 0;
  for (int intervals = posts - 1; intervals % 2 == 0; intervals /= 2) ++count;
  return count;
}

int reduced_posts(int posts, int reduction) {
  return ((posts - 1) >> std::min(reduction, halvings(posts))) + 1;
}

ReducedCell reduce_by(const Cell& cell, int row_factor, int column_factor) {
  YARS_REQUIRE(row_factor, >=, 1);
  YARS_REQUIRE(column_factor, >=, 1);
  YARS_REQUIRE((cell.rows() - 1) % row_factor, ==, 0);
  YARS_REQUIRE((cell.columns() - 1) % column_factor, ==, 0);
  const CoarseGrid grid{(cell.rows() - 1) / row_factor + 1, (cell.columns() - 1) / column_factor + 1, row_factor,
                        column_factor};
  const std::size_t posts = static_cast<std::size_t>(grid.rows) * static_cast<std::size_t>(grid.columns);
  std::vector<std::int16_t> means;
  std::vector<std::int16_t> peaks;
  means.reserve(posts);
  peaks.reserve(posts);
  ColumnSums column_sums(cell.columns());
  std::vector<std::int16_t> column_peaks(static_cast<std::size_t>(cell.columns()));
  for (int row = 0; row < grid.rows; ++row) {
    append_mean_row(cell, grid, row, column_sums, means);
    append_peak_row(cell, grid, row, column_peaks, peaks);
  }
  return {Cell(cell.corner(), grid.rows, grid.columns, means, cell.unit_m()),
          Cell(cell.corner(), grid.rows, grid.columns, peaks, cell.unit_m())};
}

ReducedCell reduce(const Cell& cell, int reduction) {
  YARS_REQUIRE(reduction, >=, 0);
  return reduce_by(cell, 1 << std::min(reduction, halvings(cell.rows())),
                   1 << std::min(reduction, halvings(cell.columns())));
}

}  // namespace yars::model::terrain
