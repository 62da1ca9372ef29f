#include "model/terrain/store/cell_files.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <system_error>
#include <tuple>
#include <utility>

#include "lib/error/error.hpp"
#include "lib/file/text_file.hpp"
#include "model/terrain/formats/cell.hpp"
#include "model/terrain/formats/culture.hpp"
#include "model/terrain/formats/ded.hpp"
#include "model/terrain/formats/dted.hpp"
#include "model/terrain/formats/hgt.hpp"
#include "model/terrain/formats/pack.hpp"
#include "model/terrain/gdal/raster.hpp"
#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::model::terrain {

namespace {

error::Expected<CellReading> read_whole(const CellFile& file, CellCorner corner) {
  switch (file.format) {
    case CellFormat::dted:
      return read_dted(file.path, corner);
    case CellFormat::hgt:
      return read_hgt(file.path, corner);
    case CellFormat::ded:
      return read_ded(file.path, corner);
    default:
      return read_compressed_hgt(file.path, corner);
  }
}

error::Expected<CellReading> reduced(error::Expected<CellReading> reading, int reduction) {
  if (!reading || reduction == 0) return reading;
  ReducedCell coarse = reduce(reading->cell, reduction);
  reading->cell = std::move(coarse.means);
  reading->peaks = std::move(coarse.peaks);
  return reading;
}

// Numbers of intervals between posts in one degree.
struct PostsPerDegree {
  int north = 0, east = 0;
};

error::Expected<PostsPerDegree> posts_of(const CellFile& file, CellCorner corner) {
  if (file.posts_per_degree > 0 && file.posts_per_degree_east > 0)
    return PostsPerDegree{file.posts_per_degree, file.posts_per_degree_east};
  const auto cells = cells_in_file(file.path);
  if (!cells) return tl::unexpected(cells.error());
  for (const FoundCell& cell : *cells)
    if (cell.corner == corner) return PostsPerDegree{cell.file.posts_per_degree, cell.file.posts_per_degree_east};
  return error::fail(file.path.string(),
                     "a raster that touches the cell with the south-west corner " + std::to_string(corner.south_deg) +
                         ", " + std::to_string(corner.west_deg),
                     "one that lies elsewhere");
}

error::Expected<CellReading> read_raster_cell(const CellFile& file, CellCorner corner, int reduction) {
  static_assert(gdal::kNoHeight == kVoidPost);
  const auto whole = posts_of(file, corner);
  if (!whole) return tl::unexpected(whole.error());
  auto [north, east] = *whole;
  // For a raster finer than one arc second, read_raster() does the first halvings by averaging pixels. They end
  // when the posts are at least one arc second apart, or when a number of intervals is odd. reduced() does the rest and
  // finds the peaks. Averaging to even coarser posts would lose summits.
  constexpr int kFinestReduced = 3600;  // posts per degree at one arc second
  int remaining = reduction;
  for (; remaining > 0 && std::max(north, east) > kFinestReduced && north % 2 == 0 && east % 2 == 0; --remaining) {
    north /= 2;
    east /= 2;
  }
  std::vector<std::filesystem::path> rasters{file.path};
  rasters.insert(rasters.end(), file.others.begin(), file.others.end());
  auto posts = gdal::read_raster(rasters, corner.south_deg, corner.west_deg, north, east);
  if (!posts) return tl::unexpected(posts.error());
  CellReading reading{Cell(corner, posts->rows, posts->columns, posts->posts, posts->unit_m),
                      std::nullopt,
                      {},
                      {},
                      std::move(posts->notes),
                      posts->impossible};
  for (const std::string& problem : posts->problems)
    reading.warnings.push_back("voids of its cell are not filled from another raster: " + problem);
  // If averaging has done the whole reduction, the averaged posts are also the peaks.
  if (reduction > 0 && remaining == 0) reading.peaks = reading.cell;
  return reduced(std::move(reading), remaining);
}

}  // namespace

error::Expected<CellReading> read_cell(const CellFile& file, CellCorner corner, int reduction) {
  YARS_REQUIRE(reduction, >=, 0);
  auto reading = file.format == CellFormat::pack     ? read_pack(file.path, corner, reduction)
                 : file.format == CellFormat::raster ? read_raster_cell(file, corner, reduction)
                                                     : reduced(read_whole(file, corner), reduction);
  if (!reading) return reading;
  if (auto note = sea_floor_note(reading->cell)) reading->notes.push_back(std::move(*note));
  return reading;
}

bool links_outside(const std::filesystem::path& path, const std::filesystem::path& root) {
  std::error_code code;
  if (!std::filesystem::is_symlink(path, code)) return false;
  const std::filesystem::path target = std::filesystem::weakly_canonical(path, code);
  return code || std::mismatch(root.begin(), root.end(), target.begin(), target.end()).first != root.end();
}

namespace {

// Sort key among files for one cell: the file with the smallest key is preferred.
auto rank(const CellFile& file) {
  return std::tuple(file.is_part(), file.covered <= 0.0, -file.posts_per_degree, static_cast<int>(file.format),
                    file.path.filename().string().size(), file.path.string());
}

// All files that have posts of a cell, by cell.
using Candidates = std::map<std::size_t, std::vector<CellFile>>;

void add_candidates(std::vector<FoundCell> cells, Candidates& candidates) {
  for (FoundCell& cell : cells) candidates[slot_of(cell.corner)].push_back(std::move(cell.file));
}

// A sentence about a file that is not read, since `chosen` has its cell.
std::string unneeded(const CellFile& file, const CellFile& chosen, CellCorner corner) {
  const char* const why = file.is_part() && !chosen.is_part()               ? "spans the whole cell"
                          : chosen.posts_per_degree > file.posts_per_degree ? "has finer posts"
                                                                            : "has posts as fine";
  return file.path.string() + ": not used: the cell with the south-west corner " + std::to_string(corner.south_deg) +
         ", " + std::to_string(corner.west_deg) + " is read from " + chosen.path.string() + ", which " + why;
}

// Chooses the file of each cell. `found` receives the files that are in no cell.
DirectoryIndex chosen_from(Candidates candidates, FileSentences& found) {
  DirectoryIndex index;
  std::set<std::filesystem::path> used;
  for (auto& [slot, files] : candidates) {
    std::sort(files.begin(), files.end(), [](const CellFile& a, const CellFile& b) { return rank(a) < rank(b); });
    if (files.front().covered <= 0.0) continue;  // posts on an edge alone do not make a cell
    CellFile& chosen = index[slot] = files.front();
    used.insert(chosen.path);
    if (chosen.format != CellFormat::raster) continue;
    for (auto other = files.begin() + 1; other != files.end(); ++other) {
      if (other->format != CellFormat::raster) continue;
      chosen.others.push_back(other->path);
      if (chosen.is_part()) used.insert(other->path);
    }
  }
  std::set<std::filesystem::path> reported;
  for (const auto& [slot, files] : candidates)
    for (const CellFile& file : files) {
      if (file.covered <= 0.0 || used.contains(file.path) || !reported.insert(file.path).second) continue;
      const CellFile& chosen = index.at(slot);
      const std::string sentence = unneeded(file, chosen, corner_of_slot(slot));
      if (file.posts_per_degree > chosen.posts_per_degree)
        found.problems.push_back(sentence + "; join them with gdalwarp to have its finer posts");
      else
        found.notes.push_back(sentence);
    }
  return index;
}

// Reports the culture files that belong to no file of the index.
void report_unused_cultures(const DirectoryIndex& index, const std::vector<std::filesystem::path>& cultures,
                            std::vector<std::string>& problems) {
  std::set<std::filesystem::path> used;
  for (const auto& [slot, file] : index)
    if (file.culture) used.insert(*file.culture);
  for (const std::filesystem::path& culture : cultures)
    if (!used.contains(culture))
      problems.push_back(error::Error{culture.string(), "beside it the elevation file that its cell is read from",
                                      "none of its name", "give both the same name, as n36.dt1 and n36.smc.png"}
                             .message());
}

// True if the file, its culture file or its side file (of a pack) is a symbolic link with a target outside `root`.
bool any_leads_out(const std::filesystem::path& path, const std::filesystem::path& root, file::FolderNames& names) {
  const auto leads_out = [&](const std::optional<std::filesystem::path>& beside) {
    return beside && links_outside(*beside, root);
  };
  return links_outside(path, root) || leads_out(find_culture(path, names)) ||
         leads_out(names.find(std::filesystem::path(path).replace_extension(".side")));
}

void add_cultures(DirectoryIndex& index, file::FolderNames& names) {
  for (auto& [slot, file] : index) file.culture = find_culture(file.path, names);
}

// A sentence about an elevation file in a form that is not read from a folder.
std::string unread_form(const std::filesystem::path& path, ElevationKind kind) {
  return error::Error{path.string(), "DTED, HGT, DED, a pack or a raster by its name", "a name of another form",
                      kind == ElevationKind::convertible
                          ? "read it with `yars terrain convert --in FILE --out DIR`"
                          : "unpack it, give it the ending of its form, or make a GeoTIFF of it with gdal_translate"}
      .message();
}

// Adds the cells of a file to `candidates`, or its problem to `problems`.
void add_file(const std::filesystem::path& path, Candidates& candidates, std::vector<std::string>& problems) {
  const ElevationKind kind = elevation_kind(path);
  if (kind == ElevationKind::convertible || kind == ElevationKind::foreign) {
    problems.push_back(unread_form(path, kind));
    return;
  }
  auto cells = cells_in_file(path);
  if (cells)
    add_candidates(std::move(*cells), candidates);
  else
    problems.push_back(cells.error().message());
}

std::string lower_first(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
  return text;
}

// Message about a folder that cannot be read; nullopt for a readable folder and for other entries.
std::optional<std::string> unreadable_folder(const std::filesystem::directory_entry& entry) {
  std::error_code code;
  if (!entry.is_directory(code) || entry.is_symlink(code)) return std::nullopt;
  const std::filesystem::directory_iterator first(entry.path(), code);
  if (!code) return std::nullopt;
  return error::Error{entry.path().string(), "a folder that can be read", lower_first(error::reason_of(code.value())),
                      "check its permissions"}
      .message();
}

}  // namespace

error::Expected<DirectoryIndex> index_directory(const std::filesystem::path& directory, FileSentences* found) {
  std::error_code code;
  if (!std::filesystem::is_directory(directory, code))
    return error::fail(directory.string(), "a directory with elevation cells",
                       code ? error::reason_of(code.value()) : "no directory",
                       "make one with `yars terrain generate --out DIR`");
  Candidates candidates;
  std::vector<std::filesystem::path> cultures;
  file::FolderNames names;
  FileSentences sentences;
  std::vector<std::string>& problems = sentences.problems;
  const std::filesystem::path root = std::filesystem::weakly_canonical(directory, code);
  std::filesystem::recursive_directory_iterator entry(directory, code);
  for (const std::filesystem::recursive_directory_iterator end; !code && entry != end; entry.increment(code)) {
    if (const auto closed = unreadable_folder(*entry)) {
      problems.push_back(*closed);
      entry.disable_recursion_pending();
    }
    std::error_code ignored;
    if (is_culture_name(entry->path()) && !links_outside(entry->path(), root)) cultures.push_back(entry->path());
    if (elevation_kind(entry->path()) == ElevationKind::none || entry->is_directory(ignored)) continue;
    if (!any_leads_out(entry->path(), root, names))
      add_file(entry->path(), candidates, problems);
    else
      problems.push_back(error::Error{entry->path().string(), "a file inside " + root.string(), "a link that leads out",
                                      "copy the cell into the folder, or give the folder of its target"}
                             .message());
  }
  if (code)
    return error::fail(directory.string(), "a directory that can be read", lower_first(error::reason_of(code.value())),
                       "check its permissions");
  DirectoryIndex index = chosen_from(std::move(candidates), sentences);
  add_cultures(index, names);
  report_unused_cultures(index, cultures, problems);
  std::sort(problems.begin(), problems.end());
  std::sort(sentences.notes.begin(), sentences.notes.end());
  if (index.empty() && !problems.empty())
    return error::fail(directory.string(), "elevation cells that can be used",
                       "none; the first of " + std::to_string(problems.size()) + " problems: " + problems.front());
  if (index.empty())
    return error::fail(directory.string(), "elevation cells named like w122/n36.dt1 or N36W122.hgt", "none",
                       "give another directory or make cells with `yars terrain generate`");
  if (found != nullptr) *found = std::move(sentences);
  return index;
}

error::Expected<DirectoryIndex> index_file(const std::filesystem::path& path) {
  const auto length = file_length(path);
  if (!length) return tl::unexpected(length.error());
  auto cells = cells_in_file(std::filesystem::absolute(path));  // the name of its folder may state the cell
  if (!cells) return tl::unexpected(cells.error());
  for (FoundCell& cell : *cells) cell.file.path = path;
  Candidates candidates;
  add_candidates(std::move(*cells), candidates);
  FileSentences sentences;
  DirectoryIndex index = chosen_from(std::move(candidates), sentences);
  if (index.empty()) return error::fail(path.string(), "a file with elevation", "one without");
  file::FolderNames names;
  add_cultures(index, names);
  return index;
}

bool touches(const DirectoryIndex& index, const TerrainRegion& region) {
  const std::vector<CellCorner> corners = cells_within(region);
  return std::any_of(corners.begin(), corners.end(),
                     [&](CellCorner corner) { return index.contains(slot_of(corner)); });
}

geo::GeoPoint within_index(const DirectoryIndex& index, geo::GeoPoint position) {
  const auto has = [&](geo::GeoPoint point) { return index.contains(slot_of(cell_containing(point))); };
  if (index.empty() || has(position)) return position;
  const double latitude_deg = position.latitude_deg, longitude_deg = geo::wrapped_degrees(position.longitude_deg);
  const bool on_parallel = latitude_deg == std::floor(latitude_deg) && latitude_deg > -90.0;
  const bool on_meridian = longitude_deg == std::floor(longitude_deg);
  const geo::GeoPoint south{std::nextafter(latitude_deg, -90.0), position.longitude_deg};
  // West of the meridian of 180 degrees is the last cell.
  const geo::GeoPoint west{
      latitude_deg, longitude_deg == -180.0 ? std::nextafter(180.0, 0.0) : std::nextafter(longitude_deg, -181.0)};
  if (on_parallel && has(south)) return south;
  if (on_meridian && has(west)) return west;
  const geo::GeoPoint corner{south.latitude_deg, west.longitude_deg};
  return on_parallel && on_meridian && has(corner) ? corner : position;
}

Coverage coverage_of(const DirectoryIndex& index) {
  YARS_REQUIRE(index.empty(), ==, false);
  CellCorner lowest{90, 180};
  CellCorner highest{-90, -180};
  for (const auto& [slot, file] : index) {
    const CellCorner corner = corner_of_slot(slot);
    lowest = {std::min(lowest.south_deg, corner.south_deg), std::min(lowest.west_deg, corner.west_deg)};
    highest = {std::max(highest.south_deg, corner.south_deg), std::max(highest.west_deg, corner.west_deg)};
  }
  return {lowest.south_deg, highest.south_deg + 1, lowest.west_deg, highest.west_deg + 1};
}

std::string coverage_text(const DirectoryIndex& index) {
  const Coverage all = coverage_of(index);
  return "latitude " + std::to_string(all.south_deg) + " to " + std::to_string(all.north_deg) + ", longitude " +
         std::to_string(all.west_deg) + " to " + std::to_string(all.east_deg);
}

}  // namespace yars::model::terrain
