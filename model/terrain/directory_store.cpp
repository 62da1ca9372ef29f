#include "model/terrain/directory_store.hpp"

#include <utility>

#include "model/terrain/cell_view.hpp"
#include "model/terrain/region_cells.hpp"

namespace yars::model::terrain {

failure::Expected<std::unique_ptr<DirectoryTerrainStore>> DirectoryTerrainStore::open(
    const std::filesystem::path& directory, DirectoryStoreOptions options) {
  failure::Expected<DirectoryIndex> index = index_directory(directory);
  if (!index) return tl::unexpected(index.error());
  return std::unique_ptr<DirectoryTerrainStore>(new DirectoryTerrainStore(std::move(*index), options));
}

DirectoryTerrainStore::DirectoryTerrainStore(DirectoryIndex index, DirectoryStoreOptions options)
    : index_(std::move(index)), options_(options) {}

TerrainViewPointer DirectoryTerrainStore::prepare(const TerrainRegion& region) {
  ++prepares_;
  bool changed = view_ == nullptr;
  for (const CellPlace place : cells_within(region)) {
    const std::size_t slot = slot_of(place);
    const auto file = index_.find(slot);
    if (file == index_.end()) continue;
    const auto [resident, fresh] = resident_.try_emplace(slot);
    if (fresh) {
      resident->second.cell = load(file->second, place);
      if (resident->second.cell) resident_bytes_ += resident->second.cell->bytes();
      changed = true;
    }
    resident->second.last_use = prepares_;
  }
  while (resident_bytes_ > options_.resident_limit_bytes && drop_longest_unused()) changed = true;
  if (changed) view_ = make_view();
  return view_;
}

std::vector<std::string> DirectoryTerrainStore::take_problems() {
  return std::exchange(problems_, {});
}

std::shared_ptr<const Cell> DirectoryTerrainStore::load(const CellFile& file, CellPlace place) {
  failure::Expected<CellReading> reading = read_cell(file, place);
  if (!reading) {
    problems_.push_back(reading.error().message() + "; the cell counts as void");
    return nullptr;
  }
  for (const std::string& warning : reading->warnings) problems_.push_back(file.path.string() + ": " + warning);
  return std::make_shared<const Cell>(std::move(reading->cell));
}

// False when nothing outside the present region is left to drop.
bool DirectoryTerrainStore::drop_longest_unused() {
  auto oldest = resident_.end();
  for (auto candidate = resident_.begin(); candidate != resident_.end(); ++candidate) {
    const bool droppable = candidate->second.cell && candidate->second.last_use < prepares_;
    if (droppable && (oldest == resident_.end() || candidate->second.last_use < oldest->second.last_use))
      oldest = candidate;
  }
  if (oldest == resident_.end()) return false;
  resident_bytes_ -= oldest->second.cell->bytes();
  resident_.erase(oldest);
  return true;
}

TerrainViewPointer DirectoryTerrainStore::make_view() {
  auto view = std::make_shared<CellView>(++generation_, options_.missing_cell_is_sea ? Absence::sea : Absence::none);
  for (const auto& [slot, file] : index_) view->set_absence(place_of_slot(slot), Absence::not_loaded);
  for (const auto& [slot, resident] : resident_) {
    if (resident.cell)
      view->add(resident.cell);
    else
      view->set_absence(place_of_slot(slot), Absence::none);
  }
  return view;
}

}  // namespace yars::model::terrain
