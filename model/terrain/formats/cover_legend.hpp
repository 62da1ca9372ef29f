// Legend of land cover: the surface material of each class of a raster.
// Input: a CSV file. Its first line names the columns: class, name, material, source; others are not used. `class` has
//   one or several numbers with blanks between them. `material` is a name of material_name() or a code up to
//   kMaxMaterial. `source` says why the class has this material. `#` begins a comment.
// Errors: a file that cannot be read, a missing column, a class that is no number from 0 to 65535 or has two lines, an
//   unknown material. The error names the line.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lib/error/error.hpp"

namespace yars::model::terrain {

struct CoverClass {
  std::vector<std::uint16_t> values;  // of the raster's pixels
  std::string name;
  std::uint8_t material = 0;
};

using CoverLegend = std::vector<CoverClass>;

error::Expected<CoverLegend> read_cover_legend(const std::string& path);

}  // namespace yars::model::terrain
