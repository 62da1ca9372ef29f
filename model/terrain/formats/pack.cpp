#include "model/terrain/formats/pack.hpp"

#include <algorithm>
#include <utility>

#include "lib/file/output_file.hpp"
#include "lib/file/text_file.hpp"
#include "model/terrain/formats/cell.hpp"
#include "model/terrain/formats/dted.hpp"
#include "model/terrain/formats/jpeg2000.hpp"
#include "model/terrain/formats/pack_side.hpp"

namespace yars::model::terrain {

namespace {

constexpr std::size_t kMaxFile_bytes = 256UL << 20U;  // [bytes] more than 7201 x 7201 uncompressed posts

// Converts a decoded grid to a cell, whose rows run from the south.
Cell from_south(const HeightGrid& grid, CellCorner corner, double unit_m) {
  const auto columns = static_cast<std::ptrdiff_t>(grid.columns);
  std::vector<std::int16_t> posts;
  posts.reserve(grid.heights.size());
  for (std::ptrdiff_t row = grid.rows - 1; row >= 0; --row)
    posts.insert(posts.end(), grid.heights.begin() + row * columns, grid.heights.begin() + (row + 1) * columns);
  // Voids come from the side file. A wavelet value equal to kVoidPost is a height and is raised by one unit.
  std::replace(posts.begin(), posts.end(), kVoidPost, static_cast<std::int16_t>(kVoidPost + 1));
  return {corner, grid.rows, grid.columns, posts, unit_m};
}

// Limits a height of land to at most `peak`, because a wavelet overshoots beside cliffs. A result of 0 becomes 1 unit
// if the peak is above 0, else -1 unit, because 0 means sea.
std::int16_t land_below(std::int16_t peak, std::int16_t height) {
  const std::int16_t lower = std::min(peak, height);
  if (lower != 0) return lower;
  return peak > 0 ? std::int16_t{1} : std::int16_t{-1};
}

// Applies the side file to the decoded posts: voids, and at a reduction above 0 also sea, peaks and edges.
Cell marked(const Cell& cell, const SideLevel& level, int reduction) {
  const int rows = cell.rows();
  const int columns = cell.columns();
  const auto index = [columns](int row, int column) {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
  };
  std::vector<std::int16_t> posts;
  posts.reserve(level.voids.size());
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      std::int16_t post = cell.post(row, column);
      if (reduction > 0)
        post = level.sea[posts.size()] ? std::int16_t{0} : land_below(level.peaks->post(row, column), post);
      posts.push_back(level.voids[posts.size()] ? kVoidPost : post);
    }
  if (reduction > 0) {
    for (int column = 0; column < columns; ++column) {
      posts[index(0, column)] = level.edges[0][static_cast<std::size_t>(column)];
      posts[index(rows - 1, column)] = level.edges[1][static_cast<std::size_t>(column)];
    }
    for (int row = 0; row < rows; ++row) {
      posts[index(row, 0)] = level.edges[2][static_cast<std::size_t>(row)];
      posts[index(row, columns - 1)] = level.edges[3][static_cast<std::size_t>(row)];
    }
  }
  return {cell.corner(), rows, columns, posts, cell.unit_m()};
}

}  // namespace

error::Expected<CellReading> parse_pack(std::span<const std::byte> jp2, std::span<const std::byte> side,
                                        const std::string& subject, CellCorner corner, int reduction) {
  const auto head = parse_side_head(side, jp2, subject);
  if (!head) return tl::unexpected(head.error());
  const int level_reduction = std::min(reduction, head->reductions);
  const int by_wavelet = std::min({level_reduction, halvings(head->rows), halvings(head->columns)});
  const auto grid = decode_jpeg2000(jp2, subject, head->rows, head->columns, by_wavelet);
  if (!grid) return tl::unexpected(grid.error());
  auto level = parse_side_level(side, corner, level_reduction, subject);
  if (!level) return tl::unexpected(level.error());
  const Cell decoded = from_south(*grid, corner, head->unit_m);
  const int rows = reduced_posts(head->rows, level_reduction);
  const int columns = reduced_posts(head->columns, level_reduction);
  const int row_factor = (decoded.rows() - 1) / (rows - 1);
  const int column_factor = (decoded.columns() - 1) / (columns - 1);
  // The wavelet halves both dimensions together. Further halvings of one dimension average the decoded posts.
  const Cell heights = row_factor * column_factor == 1 ? decoded : reduce_by(decoded, row_factor, column_factor).means;
  Cell cell = marked(heights, *level, level_reduction);
  // If the cell cannot be halved, its posts are its peaks.
  if (reduction > 0 && level_reduction == 0) level->peaks = cell;
  return CellReading{std::move(cell), std::move(level->peaks), {}};
}

error::Expected<CellReading> read_pack(const std::filesystem::path& path, CellCorner corner, int reduction) {
  const auto jp2 = read_file(path, kMaxFile_bytes);
  if (!jp2) return tl::unexpected(jp2.error());
  const auto side_path = std::filesystem::path(path).replace_extension(".side");
  const auto side = read_file(file::FolderNames().find(side_path).value_or(side_path), kMaxFile_bytes);
  if (!side) return tl::unexpected(side.error());
  return parse_pack(*jp2, *side, path.string(), corner, reduction);
}

GridSize pack_size(const std::filesystem::path& path) {
  const auto head = read_file_part(path, 0, kJpeg2000HeadBytes);
  return head ? jpeg2000_size(*head) : GridSize{};
}

namespace {

// Reduction 5 turns a spacing of one arc second into 1 km. No range scale of the radar needs coarser grids.
constexpr int kMaxReductions = 5;

HeightGrid filled_grid(const Cell& cell) {
  HeightGrid grid{cell.rows(), cell.columns(), {}};
  grid.heights.reserve(static_cast<std::size_t>(cell.rows()) * static_cast<std::size_t>(cell.columns()));
  for (int row = cell.rows() - 1; row >= 0; --row)
    for (int column = 0; column < cell.columns(); ++column) grid.heights.push_back(cell.post(row, column));
  fill_voids(grid);
  return grid;
}

}  // namespace

std::string pack_name(CellCorner corner) {
  return std::filesystem::path(dted_name(corner, 0)).replace_extension(".jp2").string();
}

error::Expected<PackedCell> pack_cell(const Cell& cell) {
  const int down = std::min(halvings(cell.rows()), kMaxReductions);
  const int across = std::min(halvings(cell.columns()), kMaxReductions);
  // A wavelet level halves both dimensions. The side file also has the reductions that halve only one dimension.
  auto jp2 = encode_jpeg2000(filled_grid(cell), std::min(down, across));
  if (!jp2) return tl::unexpected(jp2.error());
  auto side = side_bytes(cell, std::max(down, across), *jp2);
  if (!side) return tl::unexpected(side.error());
  return PackedCell{std::move(*jp2), std::move(*side)};
}

error::Expected<std::filesystem::path> write_pack(const std::filesystem::path& tree, const Cell& cell) {
  const auto packed = pack_cell(cell);
  if (!packed) return tl::unexpected(packed.error());
  const std::filesystem::path path = tree / pack_name(cell.corner());
  const auto side = file::write_file_and_folders(std::filesystem::path(path).replace_extension(".side"), packed->side);
  if (!side) return tl::unexpected(side.error());
  return file::write_file_and_folders(path, packed->jp2);
}

}  // namespace yars::model::terrain
