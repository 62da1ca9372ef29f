#include "model/terrain/store/directory_store.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <future>
#include <utility>

#include "lib/geo/geodesy.hpp"
#include "lib/radar/world.hpp"
#include "model/terrain/formats/culture.hpp"
#include "model/terrain/sampling/analytic_terrain.hpp"
#include "model/terrain/sampling/terrain_view.hpp"
#include "model/terrain/store/cell_files.hpp"

namespace yars::model::terrain {

namespace {
constexpr int kMaxReduction = 6;     // maximum number of times that the spacing of posts is doubled
constexpr int kServesNoDetail = -1;  // detail of a view in which cells within the scan's range are still to be loaded

std::size_t bytes_of(const TerrainCell& cell) {
  return cell.heights->bytes() + (cell.peaks ? cell.peaks->bytes() : 0) + (cell.culture ? cell.culture->bytes() : 0);
}

struct FreeBuffers {
  ~FreeBuffers() { free_reading_buffers(); }
};
}  // namespace

int reduction_for(const CellFile& file, int detail) {
  if (file.posts_per_degree <= 0 || detail <= 0) return 0;
  const double spacing_m = geo::kMetresPerDegree / file.posts_per_degree;
  const double halvings = std::log2(std::ldexp(1.0, detail) / spacing_m);
  return std::clamp(static_cast<int>(std::floor(halvings)), 0, kMaxReduction);
}

error::Expected<std::unique_ptr<DirectoryTerrainStore>> DirectoryTerrainStore::open(
    const std::filesystem::path& directory, DirectoryStoreOptions options) {
  FileSentences sentences;
  error::Expected<DirectoryIndex> index = index_directory(directory, &sentences);
  if (!index) return tl::unexpected(index.error());
  return std::unique_ptr<DirectoryTerrainStore>(
      new DirectoryTerrainStore(directory.string(), std::move(*index), options, std::move(sentences)));
}

DirectoryTerrainStore::DirectoryTerrainStore(std::string folder, DirectoryIndex index, DirectoryStoreOptions options,
                                             FileSentences sentences)
    : folder_(std::move(folder)),
      index_(std::move(index)),
      options_(options),
      not_used_(sentences.problems),
      sentences_(std::move(sentences)) {}

TerrainViewPointer DirectoryTerrainStore::prepare_in_steps(const TerrainRegion& region, const Interim& interim) {
  const FreeBuffers after_last_cell;
  ++prepares_;
  note_outside_coverage(region);
  bool changed = view_ == nullptr || !view_->has_detail(region.detail);
  const std::vector<Level> missing = select(region, changed);
  const double reach_deg = touched_within_deg(region.reach_m);
  const auto beyond_reach = [&](Level level) {
    return angle_to_centre_deg(region.centre, corner_of_slot(level.first)) > reach_deg;
  };
  for (std::size_t i = 0; i < missing.size(); ++i) {
    if (load(missing[i])) use_in_view(missing[i]);
    changed = true;
    if (!interim || i + 1 == missing.size()) continue;
    // Cells are sorted by distance. If the next cell lies beyond the scan's range, all later cells do, too.
    view_ = make_view(beyond_reach(missing[i + 1]) ? region.detail : kServesNoDetail);
    if (!interim(view_)) return view_;
  }
  while (resident_bytes_ > options_.resident_limit_bytes && drop_least_recently_used()) changed = true;
  if (changed) view_ = make_view(region.detail);
  return view_;
}

// Reports a problem when a region has no cell with a file, and it is the first region or the one before had a cell.
// Ignores regions of radius 0 (a single position).
void DirectoryTerrainStore::note_outside_coverage(const TerrainRegion& region) {
  if (region.radius_m <= 0.0) return;
  const bool outside = !touches(index_, region);
  if (outside && !outside_coverage_) {
    std::array<char, 120> where{};
    std::snprintf(where.data(), where.size(), "a cell within %.0f NM of latitude %.4f, longitude %.4f",
                  region.radius_m / geo::kMetresPerNauticalMile, region.centre.latitude_deg,
                  region.centre.longitude_deg);
    sentences_.problems.push_back(
        error::Error{folder_, where.data(), "none: the folder covers " + coverage_text(index_),
                     std::string("the ground there counts as ") + (options_.missing_cell_is_sea ? "sea" : "void") +
                         "; check the position and its signs"}
            .message());
  }
  outside_coverage_ = outside;
}

// Puts the cells of the region into the next view: at the requested reduction if that version is in memory, else a
// substitute. Sets `changed` if a version at the requested reduction is new in it. Returns the versions still to be
// loaded, nearest first.
std::vector<DirectoryTerrainStore::Level> DirectoryTerrainStore::select(const TerrainRegion& region, bool& changed) {
  std::vector<Level> missing;
  region_cells_ = {};
  for (const CellCorner corner : cells_within(region)) {
    const std::size_t slot = slot_of(corner);
    const auto file = index_.find(slot);
    if (file == index_.end()) continue;
    ++region_cells_.files;
    if (unreadable_.contains(slot)) {
      ++region_cells_.unreadable;
      continue;
    }
    const Level level{slot, reduction_for(file->second, region.detail)};
    const auto resident = resident_.find(level);
    if (resident == resident_.end()) {
      use_substitute(level);
      missing.push_back(level);
      continue;
    }
    resident->second.last_use = prepares_;
    if (use_in_view(level)) changed = true;
  }
  const auto angle_and_slot = [&](Level level) {
    return std::pair(angle_to_centre_deg(region.centre, corner_of_slot(level.first)), level.first);
  };
  std::sort(missing.begin(), missing.end(), [&](Level a, Level b) { return angle_and_slot(a) < angle_and_slot(b); });
  return missing;
}

// Puts a cell into the next view at a reduction. Returns true if `shown_` had the cell at another reduction or not at
// all.
bool DirectoryTerrainStore::use_in_view(Level level) {
  const auto [shown, fresh] = shown_.try_emplace(level.first, level.second);
  const bool changed = fresh || shown->second != level.second;
  shown->second = level.second;
  return changed;
}

// Puts a substitute for `level` into the next views until `level` is loaded: the next coarser version of the cell in
// memory, else the next finer version. Without any version in memory, nothing changes.
void DirectoryTerrainStore::use_substitute(Level level) {
  auto found = resident_.upper_bound(level);
  if (found == resident_.end() || found->first.first != level.first) {
    if (found == resident_.begin()) return;
    --found;
  }
  if (found->first.first == level.first) use_in_view(found->first);
}

std::vector<std::string> DirectoryTerrainStore::left_out() const {
  std::vector<std::string> sentences = not_used_;
  for (const auto& [slot, reason] : unreadable_) sentences.push_back(reason);
  sentences.insert(sentences.end(), incomplete_.begin(), incomplete_.end());
  return sentences;
}

std::vector<std::string> DirectoryTerrainStore::take_problems() {
  return std::exchange(sentences_.problems, {});
}

std::vector<std::string> DirectoryTerrainStore::take_notes() {
  return std::exchange(sentences_.notes, {});
}

bool DirectoryTerrainStore::load(Level level) {
  const CellFile& file = index_.at(level.first);
  const CellCorner corner = corner_of_slot(level.first);
  // Heights and culture are read at the same time. If no thread can be started, get() reads the culture.
  std::future<error::Expected<Culture>> culture;
  if (file.culture && options_.materials)
    culture = std::async(std::launch::async | std::launch::deferred,
                         [&path = *file.culture, corner] { return read_culture(path, corner); });
  error::Expected<CellReading> reading = read_cell(file, corner, level.second);
  if (!reading) {
    const std::string reason = reading.error().message() + "; the cell counts as void";
    sentences_.problems.push_back(reason);
    unreadable_.emplace(level.first, reason);
    ++region_cells_.unreadable;
    shown_.erase(level.first);
    return false;
  }
  FileSentences found = reported_.take_new(file.path, *reading);
  incomplete_.insert(found.problems.begin(), found.problems.end());
  for (std::string& problem : found.problems) sentences_.problems.push_back(std::move(problem));
  for (std::string& note : found.notes) sentences_.notes.push_back(std::move(note));
  TerrainCell cell{std::make_shared<const Cell>(std::move(reading->cell)), nullptr,
                   culture.valid() ? usable(culture.get(), level) : nullptr};
  if (reading->peaks) cell.peaks = std::make_shared<const Cell>(std::move(*reading->peaks));
  resident_bytes_ += bytes_of(cell);
  resident_[level] = {std::move(cell), prepares_};
  return true;
}

// The culture at the reduction of `level`; null, and a problem once for each cell, if its file cannot be read.
std::shared_ptr<const Culture> DirectoryTerrainStore::usable(error::Expected<Culture> culture, Level level) {
  if (culture && level.second == 0) return std::make_shared<const Culture>(std::move(*culture));
  if (culture) return std::make_shared<const Culture>(culture->reduced(level.second));
  if (unreadable_culture_.insert(level.first).second)
    sentences_.problems.push_back(culture.error().message() + "; the cell has no materials other than land and sea");
  return nullptr;
}

// Drops the least recently used version of a cell from memory. Returns false if the current prepare() needs all of
// them.
bool DirectoryTerrainStore::drop_least_recently_used() {
  auto oldest = resident_.end();
  for (auto candidate = resident_.begin(); candidate != resident_.end(); ++candidate) {
    if (candidate->second.last_use == prepares_) continue;
    if (oldest == resident_.end() || candidate->second.last_use < oldest->second.last_use) oldest = candidate;
  }
  if (oldest == resident_.end()) return false;
  const auto shown = shown_.find(oldest->first.first);
  if (shown != shown_.end() && shown->second == oldest->first.second) shown_.erase(shown);
  resident_bytes_ -= bytes_of(oldest->second.cell);
  resident_.erase(oldest);
  return true;
}

TerrainViewPointer DirectoryTerrainStore::make_view(int detail) {
  auto view =
      std::make_shared<CellView>(++generation_, options_.missing_cell_is_sea ? Absence::sea : Absence::none, detail);
  for (const auto& [slot, file] : index_)
    view->set_absence(corner_of_slot(slot), unreadable_.contains(slot) ? Absence::none : Absence::not_loaded);
  for (const auto& [slot, reduction] : shown_) view->add(resident_.at({slot, reduction}).cell);
  return view;
}

error::Expected<std::unique_ptr<TerrainStore>> open_terrain(const radar::TerrainConfiguration& configuration,
                                                            bool materials) {
  if (configuration.directory.empty())
    return std::make_unique<FixedTerrainStore>(std::make_shared<const AnalyticTerrain>(built_in_hills()));
  auto store = DirectoryTerrainStore::open(
      configuration.directory, {.missing_cell_is_sea = configuration.missing_cell_is_sea, .materials = materials});
  if (!store) return tl::unexpected(store.error());
  return std::move(*store);
}

}  // namespace yars::model::terrain
