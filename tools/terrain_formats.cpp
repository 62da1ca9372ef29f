#include "tools/terrain_formats.hpp"

#include <algorithm>

#include "model/terrain/dted_format.hpp"
#include "model/terrain/dted_writer.hpp"
#include "model/terrain/hgt_writer.hpp"
#include "model/terrain/pack_writer.hpp"
#include "model/terrain/resample.hpp"

namespace yars::tools {

namespace {

using namespace model::terrain;

int level_of(const TerrainOutput& output, const Cell& cell) {
  const int least = output.format == "hgt" ? 1 : 0;
  if (output.level) return std::max(least, *output.level);
  int level = least;
  while (level < 2 && dted::kPostsOfLevel[level + 1] <= cell.rows()) ++level;
  return level;
}

}  // namespace

std::string output_name(const TerrainOutput& output, CellPlace place, const Cell& cell) {
  if (output.format == "jp2") return pack_name(place);
  return output.format == "hgt" ? hgt_name(place) : dted_name(place, level_of(output, cell));
}

failure::Expected<std::filesystem::path> write_output(const TerrainOutput& output, const std::filesystem::path& tree,
                                                      const Cell& cell) {
  if (output.format == "jp2" && !output.level) return write_pack(tree, cell);
  const int level = level_of(output, cell);
  const int rows = dted::kPostsOfLevel[level];
  if (output.format == "hgt") return write_hgt(tree, in_whole_metres(resample(cell, rows, rows)));
  const Cell on_level = resample(cell, rows, dted_columns(cell.place(), level));
  return output.format == "jp2" ? write_pack(tree, on_level) : write_dted(tree, in_whole_metres(on_level), level);
}

}  // namespace yars::tools
