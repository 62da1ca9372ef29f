#include "model/terrain/post_blocks.hpp"

#include "lib/failure/require.hpp"

namespace yars::model::terrain {

namespace {
int blocks_over(int intervals, int step) {
  return (intervals + step - 1) / step;
}
}  // namespace

PostBlocks::PostBlocks(int rows, int columns, std::span<const std::int16_t> posts)
    : block_rows_(blocks_over(rows - 1, kRowStep)), block_columns_(blocks_over(columns - 1, kColumnStep)) {
  YARS_REQUIRE(rows, >=, 2);
  YARS_REQUIRE(columns, >=, 2);
  YARS_REQUIRE(posts.size(), ==, static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns));
  blocks_.resize(static_cast<std::size_t>(block_rows_) * static_cast<std::size_t>(block_columns_));
  auto block = blocks_.begin();
  for (int block_row = 0; block_row < block_rows_; ++block_row)
    for (int block_column = 0; block_column < block_columns_; ++block_column, ++block)
      for (int entry = 0; entry < static_cast<int>(kPosts); ++entry) {
        // What a last block overhangs repeats the edge: never looked up, yet no accident.
        const int row = std::min(block_row * kRowStep + entry / kColumns, rows - 1);
        const int column = std::min(block_column * kColumnStep + entry % kColumns, columns - 1);
        block->posts[static_cast<std::size_t>(entry)] =
            posts[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column)];
      }
}

}  // namespace yars::model::terrain
