#include "model/terrain/pack_writer.hpp"

#include <algorithm>
#include <utility>

#include "lib/file/new_file.hpp"
#include "model/terrain/dted_writer.hpp"
#include "model/terrain/jpeg2000.hpp"
#include "model/terrain/pack_side.hpp"
#include "model/terrain/reduce.hpp"
#include "model/terrain/void_fill.hpp"

namespace yars::model::terrain {

namespace {

// Of a one-arc-second cell the fifth reduction would have posts every kilometre; coarser serves no range.
constexpr int kMostReductions = 5;

HeightGrid filled_grid(const Cell& cell) {
  HeightGrid grid{cell.rows(), cell.columns(), {}};
  grid.heights.reserve(static_cast<std::size_t>(cell.rows()) * static_cast<std::size_t>(cell.columns()));
  for (int row = cell.rows() - 1; row >= 0; --row)
    for (int column = 0; column < cell.columns(); ++column) grid.heights.push_back(cell.post(row, column));
  fill_voids(grid);
  return grid;
}

}  // namespace

std::string pack_name(CellPlace place) {
  return std::filesystem::path(dted_name(place, 0)).replace_extension(".jp2").string();
}

failure::Expected<PackedCell> pack_cell(const Cell& cell) {
  const int down = std::min(halvings(cell.rows()), kMostReductions);
  const int across = std::min(halvings(cell.columns()), kMostReductions);
  // A side that halves less often stops the wavelet, not the side file.
  auto jp2 = encode_jpeg2000(filled_grid(cell), std::min(down, across));
  if (!jp2) return tl::unexpected(jp2.error());
  auto side = side_bytes(cell, std::max(down, across), *jp2);
  if (!side) return tl::unexpected(side.error());
  return PackedCell{std::move(*jp2), std::move(*side)};
}

failure::Expected<std::filesystem::path> write_pack(const std::filesystem::path& tree, const Cell& cell) {
  const auto packed = pack_cell(cell);
  if (!packed) return tl::unexpected(packed.error());
  const std::filesystem::path path = tree / pack_name(cell.place());
  const auto side = file::write_file_and_folders(std::filesystem::path(path).replace_extension(".side"), packed->side);
  if (!side) return tl::unexpected(side.error());
  return file::write_file_and_folders(path, packed->jp2);
}

}  // namespace yars::model::terrain
