// Height grids as JPEG 2000, and the filling of voids that coding needs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "lib/error/error.hpp"

namespace yars::model::terrain {

// Grids of 16-bit heights as JPEG 2000 (ISO/IEC 15444-1), lossless: reversible 5/3 wavelet, one component, signed.
// Rows run from north to south, as in a picture. Level r of the wavelet is a low-pass of the grid at every 2^r-th
// row and column, the first and, where the intervals divide, the last among them; decoding it skips finer levels.
// Errors of decoding: no JPEG 2000, another kind of image, other sizes than asked for, damaged data.
struct HeightGrid {
  int rows = 0;
  int columns = 0;
  std::vector<std::int16_t> heights;  // row by row, north first
};

// `reductions` wavelet levels, at most as often as the shorter side can be halved. Requires rows, columns >= 2.
error::Expected<std::vector<std::byte>> encode_jpeg2000(const HeightGrid& grid, int reductions);

// Level `reduction` of a picture of `rows` x `columns` heights; the result has its sides reduced.
error::Expected<HeightGrid> decode_jpeg2000(std::span<const std::byte> file, const std::string& subject, int rows,
                                            int columns, int reduction);

// Sides of a .jp2 file from its first kJpeg2000HeadBytes; zeros where they are not those of one.
struct GridSize {
  int rows = 0;
  int columns = 0;
};
inline constexpr std::size_t kJpeg2000HeadBytes = 56;
GridSize jpeg2000_size(std::span<const std::byte> head);

// Puts smooth heights where a grid has voids, so that a wavelet does not spend bits on cliffs: each void gets the
// mean of what lies around it, taken from ever coarser grids until there is something. Other posts stay as they
// are. A grid of voids alone becomes 0.
void fill_voids(HeightGrid& grid);

}  // namespace yars::model::terrain
