// Encoder and decoder of 16-bit height grids in lossless JPEG 2000 (ISO/IEC 15444-1): reversible 5/3 wavelet.
// Input: a grid without voids; a .jp2 in memory and a wavelet level. Output: a .jp2; a grid.
// Grid: rows run from north to south. Wavelet level 0 is the grid. Level r is the low-pass filtered grid at every
//   2^r-th row and column. It includes the first row and column, and the last ones if 2^r divides the number of
//   intervals between rows or columns. Decoding a level skips the finer levels.
// Errors: data that are no JPEG 2000 or are damaged; an image of another kind or size than expected.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "lib/error/error.hpp"
#include "model/terrain/formats/cell.hpp"

namespace yars::model::terrain {

struct HeightGrid {
  int rows = 0;
  int columns = 0;
  std::vector<std::int16_t> heights;  // [unit of the cell] row by row, north first
};

// Encodes a grid with `reductions` wavelet levels coarser than level 0. Requires 2 to 32,768 rows and columns.
// `reductions` must exceed neither halvings(rows) nor halvings(columns) (cell.hpp); this is not checked.
error::Expected<std::vector<std::byte>> encode_jpeg2000(const HeightGrid& grid, int reductions);

// Decodes level `reduction` of a grid that has `rows` x `columns` heights at level 0. `subject` names the file in
// errors.
error::Expected<HeightGrid> decode_jpeg2000(std::span<const std::byte> file, const std::string& subject, int rows,
                                            int columns, int reduction);

inline constexpr std::size_t kJpeg2000HeadBytes = 56;
// Size of a grid from the first kJpeg2000HeadBytes bytes of a .jp2. Zeros if the bytes are no header of a .jp2, or if
// rows or columns are not in [2, 32768].
GridSize jpeg2000_size(std::span<const std::byte> head);

// Replaces voids by smooth heights, so that the steps at the edges of voids do not enlarge the file. Each void is
// interpolated from means of neighbouring posts. Other posts do not change. If all posts are void, they become 0.
void fill_voids(HeightGrid& grid);

}  // namespace yars::model::terrain
