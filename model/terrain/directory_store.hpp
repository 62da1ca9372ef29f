// Terrain from a directory of DTED and HGT cells. prepare() loads the cells within the region; cells outside stay
// while all fit into the limit, the longest unused go first. A cell whose file cannot be read is noted as a
// problem once and is void from then on. A view's generation rises when, and only when, its set of cells changes.
// Errors of open(): those of index_directory().
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "model/terrain/cell.hpp"
#include "model/terrain/directory_index.hpp"
#include "model/terrain/terrain_view.hpp"

namespace yars::model::terrain {

struct DirectoryStoreOptions {
  bool missing_cell_is_sea = true;                // a cell without a file: sea at 0 m, else void
  std::size_t resident_limit_bytes = 512U << 20;  // [bytes] of cells; only a region that needs more goes beyond it
};

class DirectoryTerrainStore final : public TerrainStore {
 public:
  static failure::Expected<std::unique_ptr<DirectoryTerrainStore>> open(const std::filesystem::path& directory,
                                                                        DirectoryStoreOptions options);

  TerrainViewPointer prepare(const TerrainRegion& region) override;
  std::vector<std::string> take_problems() override;

 private:
  struct Resident {
    std::shared_ptr<const Cell> cell;  // null: the file could not be read
    std::uint64_t last_use = 0;        // number of the prepare() that wanted it last
  };

  DirectoryTerrainStore(DirectoryIndex index, DirectoryStoreOptions options);
  std::shared_ptr<const Cell> load(const CellFile& file, CellPlace place);
  bool drop_longest_unused();
  TerrainViewPointer make_view();

  DirectoryIndex index_;
  DirectoryStoreOptions options_;
  std::map<std::size_t, Resident> resident_;  // by slot
  std::size_t resident_bytes_ = 0;
  std::uint64_t prepares_ = 0;
  std::uint64_t generation_ = 0;
  TerrainViewPointer view_;
  std::vector<std::string> problems_;
};

}  // namespace yars::model::terrain
