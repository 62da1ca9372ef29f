// Terrain store over a directory of elevation files, and the store that a configuration asks for.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "lib/error/error.hpp"
#include "lib/radar/configuration.hpp"
#include "model/terrain/formats/cell.hpp"
#include "model/terrain/formats/cell_reading.hpp"
#include "model/terrain/sampling/cell_view.hpp"
#include "model/terrain/sampling/terrain_view.hpp"
#include "model/terrain/store/cell_files.hpp"

namespace yars::model::terrain {

struct DirectoryStoreOptions {
  bool missing_cell_is_sea = true;                // a cell without a file: sea at 0 m, else void
  std::size_t resident_limit_bytes = 512U << 20;  // [bytes] of cells; only a region that needs more goes beyond it
};

// Cells of the region that a store was last asked for.
struct RegionCells {
  std::size_t files = 0;       // that have a file
  std::size_t unreadable = 0;  // of those: the file cannot be read, and the cell counts as void
};

// How far a file is reduced for a detail: every 2^reduction-th post lies at most 2^detail metres from the next, along a
// meridian. 0 where the file's spacing is not known.
int reduction_for(const CellFile& file, int detail);

// Terrain from a directory of elevation files. prepare() loads the cells within the region and their culture, nearest
// first, each reduced as far as the region's detail allows; what is outside stays while all fits into the limit, the
// longest unused goes first. A cell whose file cannot be read is noted as a problem once and is void from then on. A
// view's generation rises when, and only when, what it shows changes. Errors of open(): those of index_directory().
class DirectoryTerrainStore final : public TerrainStore {
 public:
  static error::Expected<std::unique_ptr<DirectoryTerrainStore>> open(const std::filesystem::path& directory,
                                                                      DirectoryStoreOptions options);

  TerrainViewPointer prepare(const TerrainRegion& region) override { return prepare_in_steps(region, {}); }
  TerrainViewPointer prepare_in_steps(const TerrainRegion& region, const Interim& interim) override;
  std::vector<std::string> take_problems() override;
  RegionCells region_cells() const { return region_cells_; }

 private:
  using Level = std::pair<std::size_t, int>;  // slot, reduction
  struct Resident {
    TerrainCell cell;
    std::uint64_t last_use = 0;  // number of the prepare() that wanted it last
  };

  DirectoryTerrainStore(std::string folder, DirectoryIndex index, DirectoryStoreOptions options,
                        std::vector<std::string> problems);
  std::vector<Level> select(const TerrainRegion& region, bool& changed);
  bool show(Level level);
  void show_stand_in(Level level);
  bool load(Level level);
  std::shared_ptr<const Culture> read_cover(Level level, const CellFile& file);
  bool drop_longest_unused();
  TerrainViewPointer make_view(int detail);

  void note_bare(const TerrainRegion& region);

  std::string folder_;  // for messages
  DirectoryIndex index_;
  DirectoryStoreOptions options_;
  std::map<Level, Resident> resident_;
  std::map<std::size_t, int> shown_;  // reduction that the view has of a slot
  std::set<std::size_t> unreadable_;  // slots
  std::set<std::size_t> coverless_;   // slots whose culture cannot be read, said once
  bool bare_ = false;                 // the last region had no cell
  std::size_t resident_bytes_ = 0;
  std::uint64_t prepares_ = 0;
  std::uint64_t generation_ = 0;
  RegionCells region_cells_;
  TerrainViewPointer view_;
  ReadingNotes notes_;
  std::vector<std::string> problems_;
};

// The terrain store that a configuration asks for: its directory, or the built-in hills when it names none.
// Errors: the directory is missing or holds no cell.
error::Expected<std::unique_ptr<TerrainStore>> open_terrain(const radar::TerrainConfiguration& configuration);

}  // namespace yars::model::terrain
