// Terrain store of a folder of elevation files. It loads the cells of a region, and keeps cells up to a memory limit.
// Input: a folder; regions (centre, radius [m], detail). Output: immutable views with ascending generation numbers.
// Errors: open() has the errors of index_directory(). take_problems() returns problems of files as sentences, and
//   take_notes() what is to be said without a problem.
// Threads: prepare() reads files and may wait. While it reads heights, a second thread reads the culture of the cell.
// One thread at a time calls the store. Any thread may read a view.
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
#include "model/terrain/formats/cell.hpp"
#include "model/terrain/formats/cell_reading.hpp"
#include "model/terrain/sampling/cell_view.hpp"
#include "model/terrain/sampling/terrain_view.hpp"
#include "model/terrain/store/cell_files.hpp"

namespace yars::radar {
struct TerrainConfiguration;
}  // namespace yars::radar

namespace yars::model::terrain {

struct DirectoryStoreOptions {
  bool missing_cell_is_sea = true;                // a cell without a file is sea at 0 m; false: void
  std::size_t resident_limit_bytes = 512U << 20;  // [bytes] limit after a prepare(); exceeded if one region needs more
  bool materials = true;                          // false: heights alone, no culture is read
};

// Numbers of cells in the region of the last prepare().
struct RegionCells {
  std::size_t files = 0;       // cells with a file
  std::size_t unreadable = 0;  // cells with a file that cannot be read; they are void
};

// Reduction: number of times that the spacing of posts is doubled. Returns the largest reduction, at most 6, with which
// the posts of a file along a meridian are at most 2^detail m apart. 0 if the file's spacing is larger or not known, or
// if `detail` is 0.
int reduction_for(const CellFile& file, int detail);

// Terrain store over a folder. prepare() loads the cells of the region and their culture, nearest first, reduced as far
// as the detail allows. Cells outside the region stay in memory up to the limit; the least recently used cells are
// dropped first. A cell with an unreadable file is reported once and is void from then on. A new view, with a higher
// generation, is made only if the cells in memory or the detail of the region have changed.
class DirectoryTerrainStore final : public TerrainStore {
 public:
  static error::Expected<std::unique_ptr<DirectoryTerrainStore>> open(const std::filesystem::path& directory,
                                                                      DirectoryStoreOptions options);

  TerrainViewPointer prepare(const TerrainRegion& region) override { return prepare_in_steps(region, {}); }
  TerrainViewPointer prepare_in_steps(const TerrainRegion& region, const Interim& interim) override;
  std::vector<std::string> take_problems() override;
  std::vector<std::string> take_notes() override;
  const RegionCells& region_cells() const { return region_cells_; }
  // Data left out of all regions so far, one sentence each: files of the folder that are not used, unreadable cells,
  // then parts of other cells that are left out or may be damaged. A call does not clear the list, unlike
  // take_problems().
  std::vector<std::string> left_out() const;
  const DirectoryIndex& index() const { return index_; }
  // The next region without a cell is a problem again, for callers whose regions have nothing to do with each other.
  void report_again() { outside_coverage_ = false; }

 private:
  using Level = std::pair<std::size_t, int>;  // a version of a cell: its slot_of() and a reduction
  struct Resident {
    TerrainCell cell;
    std::uint64_t last_use = 0;  // number of the last prepare() that needed the cell
  };

  DirectoryTerrainStore(std::string folder, DirectoryIndex index, DirectoryStoreOptions options,
                        FileSentences sentences);
  std::vector<Level> select(const TerrainRegion& region, bool& changed);
  bool use_in_view(Level level);
  void use_substitute(Level level);
  bool load(Level level);
  std::shared_ptr<const Culture> usable(error::Expected<Culture> culture, Level level);
  bool drop_least_recently_used();
  TerrainViewPointer make_view(int detail);

  void note_outside_coverage(const TerrainRegion& region);

  std::string folder_;  // path, for messages
  DirectoryIndex index_;
  DirectoryStoreOptions options_;
  std::map<Level, Resident> resident_;
  std::map<std::size_t, int> shown_;               // reduction of each cell of the next view, by slot
  std::map<std::size_t, std::string> unreadable_;  // why, by slot of an unreadable elevation file, already reported
  std::set<std::size_t> unreadable_culture_;       // slots with unreadable culture, already reported
  bool outside_coverage_ = false;                  // true: the folder has no cell in the last region
  std::size_t resident_bytes_ = 0;
  std::uint64_t prepares_ = 0;
  std::uint64_t generation_ = 0;
  std::vector<std::string> not_used_;  // problems of the folder's index
  std::set<std::string> incomplete_;   // problems of cells that were read
  RegionCells region_cells_;
  TerrainViewPointer view_;
  ReadingNotes reported_;
  FileSentences sentences_;
};

// Opens the terrain directory of a configuration. Without a directory, the store has the built-in hills.
// `materials` false: its views have heights alone. Errors: the directory is missing or has no usable cell.
error::Expected<std::unique_ptr<TerrainStore>> open_terrain(const radar::TerrainConfiguration& configuration,
                                                            bool materials = true);

}  // namespace yars::model::terrain
