#include "model/terrain/store/cell_files.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <optional>
#include <string_view>
#include <system_error>
#include <tuple>
#include <utility>

#include "lib/error/error.hpp"
#include "lib/file/file_search.hpp"
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

using file::lower_case;

// Signed degrees from the letter of a hemisphere and `digits` digits; nullopt for any other text.
std::optional<int> signed_degrees(std::string_view text, char positive, char negative, std::size_t digits) {
  if (text.size() != digits + 1 || (text[0] != positive && text[0] != negative)) return std::nullopt;
  int degrees = 0;
  for (const char digit : text.substr(1)) {
    if (digit < '0' || digit > '9') return std::nullopt;
    degrees = degrees * 10 + (digit - '0');
  }
  return text[0] == positive ? degrees : -degrees;
}

std::optional<CellCorner> corner_named(std::string_view latitude, std::string_view longitude) {
  const std::optional<int> south_deg = signed_degrees(latitude, 'n', 's', 2);
  const std::optional<int> west_deg = signed_degrees(longitude, 'e', 'w', 3);
  if (!south_deg || !west_deg) return std::nullopt;
  if (*south_deg < -90 || *south_deg > 89 || *west_deg < -180 || *west_deg > 179) return std::nullopt;
  return CellCorner{*south_deg, *west_deg};
}

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

// The cells of a raster. Errors: also a DTED file whose datums are not WGS84 and mean sea level. GDAL would ignore
// these datums.
error::Expected<gdal::RasterSummary> describe(const std::filesystem::path& path) {
  auto summary = gdal::describe_raster(path);
  if (!summary || !summary->dted_datums) return summary;
  const auto& [vertical, horizontal] = *summary->dted_datums;
  if (const auto checked = check_dted_datums(vertical, horizontal, path.string()); !checked)
    return tl::unexpected(checked.error());
  return summary;
}

error::Expected<PostsPerDegree> posts_of(const CellFile& file, CellCorner corner) {
  if (file.posts_per_degree > 0 && file.posts_per_degree_east > 0)
    return PostsPerDegree{file.posts_per_degree, file.posts_per_degree_east};
  const auto summary = describe(file.path);
  if (!summary) return tl::unexpected(summary.error());
  for (const gdal::RasterCell& cell : summary->cells)
    if (CellCorner{cell.south_deg, cell.west_deg} == corner)
      return PostsPerDegree{cell.posts_per_degree_north, cell.posts_per_degree_east};
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
  auto posts = gdal::read_raster(file.path, corner.south_deg, corner.west_deg, north, east);
  if (!posts) return tl::unexpected(posts.error());
  CellReading reading{Cell(corner, posts->rows, posts->columns, posts->posts, posts->unit_m),
                      std::nullopt,
                      {},
                      std::move(posts->warnings),
                      posts->impossible};
  // If averaging has done the whole reduction, the averaged posts are also the peaks.
  if (reduction > 0 && remaining == 0) reading.peaks = reading.cell;
  return reduced(std::move(reading), remaining);
}

}  // namespace

std::optional<NamedCell> cell_named(const std::string& folder, const std::string& file) {
  const std::string name = lower_case(file);
  const std::string_view text = name;
  if (text.size() == 7 && text[3] == '.') {
    const std::optional<CellCorner> corner = corner_named(text.substr(0, 3), lower_case(folder));
    if (corner && text.substr(4, 2) == "dt" && text[6] >= '0' && text[6] <= '2')
      return NamedCell{*corner, CellFormat::dted, text[6] - '0'};
    if (corner && text.substr(4) == "jp2") return NamedCell{*corner, CellFormat::pack};
  }
  if (text.size() >= 11 && text.substr(7, 4) == ".hgt") {
    const std::string_view packing = text.substr(11);
    const std::optional<CellCorner> corner = corner_named(text.substr(0, 3), text.substr(3, 4));
    if (corner && packing.empty()) return NamedCell{*corner, CellFormat::hgt};
    if (corner && (packing == ".zip" || packing == ".gz")) return NamedCell{*corner, CellFormat::compressed_hgt};
  }
  return std::nullopt;
}

bool is_ded_name(const std::filesystem::path& path) {
  return lower_case(path.extension().string()) == ".ded";
}

bool is_raster_name(const std::filesystem::path& path) {
  constexpr std::array<std::string_view, 5> kExtensions = {".tif", ".tiff", ".jp2", ".img", ".vrt"};
  return std::find(kExtensions.begin(), kExtensions.end(), lower_case(path.extension().string())) != kExtensions.end();
}

bool is_virtual_raster_name(const std::filesystem::path& path) {
  return lower_case(path.extension().string()) == ".vrt";
}

error::Expected<CellReading> read_cell(const CellFile& file, CellCorner corner, int reduction) {
  YARS_REQUIRE(reduction, >=, 0);
  if (file.format == CellFormat::pack) return read_pack(file.path, corner, reduction);
  if (file.format == CellFormat::raster) return read_raster_cell(file, corner, reduction);
  return reduced(read_whole(file, corner), reduction);
}

bool links_outside(const std::filesystem::path& path, const std::filesystem::path& root) {
  std::error_code code;
  if (!std::filesystem::is_symlink(path, code)) return false;
  const std::filesystem::path target = std::filesystem::weakly_canonical(path, code);
  return code || std::mismatch(root.begin(), root.end(), target.begin(), target.end()).first != root.end();
}

namespace {

// Minimum covered fraction of a full cell. A raster that lacks 1 of 200 rows and 1 of 200 columns counts as full.
constexpr double kFullCover = 0.99;

// Sort key among files for one cell: the file with the smallest key is preferred.
auto rank(const CellFile& file) {
  return std::tuple(file.covered < kFullCover, -file.posts_per_degree, static_cast<int>(file.format),
                    file.path.string());
}

void add_candidate(CellCorner corner, CellFile file, DirectoryIndex& index) {
  const auto [entry, fresh] = index.try_emplace(slot_of(corner), file);
  if (!fresh && rank(file) < rank(entry->second)) entry->second = std::move(file);
}

// The file of a cell, with the spacing of its posts if the file's name, length or header states the spacing.
CellFile described(const std::filesystem::path& path, const NamedCell& named) {
  const auto with_posts = [&](int rows, int columns) {
    return CellFile{path, named.format, std::max(0, rows - 1), std::max(0, columns - 1)};
  };
  std::error_code code;
  if (named.format == CellFormat::dted) {
    const int rows = dted::kPostsOfLevel[named.level];
    return with_posts(rows, (rows - 1) / dted::zone_factor(named.corner.south_deg) + 1);
  }
  if (named.format == CellFormat::pack) {
    const GridSize size = pack_size(path);
    return with_posts(size.rows, size.columns);
  }
  // The length of an uncompressed HGT file gives its spacing, so that the file need not be opened.
  const std::uintmax_t size = std::filesystem::file_size(path, code);
  const int posts = named.format == CellFormat::compressed_hgt ? compressed_hgt_posts(path)
                    : code                                     ? 0
                                                               : hgt_posts_for_size(size);
  return with_posts(posts, posts);
}

// Adds the cells that the header of a .ded file states. Errors: the file cannot be used.
error::Expected<void> add_ded(const std::filesystem::path& path, DirectoryIndex& index) {
  const auto cells = ded_cells(path);
  if (!cells) return tl::unexpected(cells.error());
  for (const DedCell& cell : *cells)
    add_candidate(cell.corner, {path, CellFormat::ded, cell.rows - 1, cell.columns - 1}, index);
  return {};
}

error::Expected<void> add_raster(const std::filesystem::path& path, DirectoryIndex& index) {
  if (is_virtual_raster_name(path))
    return error::fail(path.string(), "a raster that holds its own heights",
                       "a .vrt, which may name any file or address", "make a GeoTIFF of it with gdal_translate");
  const auto raster = describe(path);
  if (!raster) return tl::unexpected(raster.error());
  for (const gdal::RasterCell& cell : raster->cells)
    add_candidate({cell.south_deg, cell.west_deg},
                  {path, CellFormat::raster, cell.posts_per_degree_north, cell.posts_per_degree_east, cell.covered},
                  index);
  return {};
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

bool is_elevation_name(const std::filesystem::path& path) {
  return cell_named(path.parent_path().filename().string(), path.filename().string()) || is_ded_name(path) ||
         is_raster_name(path);
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
                      "check its permissions", false}
      .message();
}

// Adds the cells of a file to `index`, or its error to `problems`.
void add_file(const std::filesystem::path& path, DirectoryIndex& index, std::vector<std::string>& problems) {
  const auto named = cell_named(path.parent_path().filename().string(), path.filename().string());
  if (named) {
    add_candidate(named->corner, described(path, *named), index);
    return;
  }
  const auto added = is_ded_name(path) ? add_ded(path, index) : add_raster(path, index);
  if (!added) problems.push_back(added.error().message());
}

}  // namespace

error::Expected<DirectoryIndex> index_directory(const std::filesystem::path& directory,
                                                std::vector<std::string>* problems) {
  std::error_code code;
  if (!std::filesystem::is_directory(directory, code))
    return error::fail(directory.string(), "a directory with elevation cells",
                       code ? error::reason_of(code.value()) : "no directory",
                       "make one with `yars terrain generate --out DIR`");
  DirectoryIndex index;
  file::FolderNames names;
  std::vector<std::string> found;
  const std::filesystem::path root = std::filesystem::weakly_canonical(directory, code);
  std::filesystem::recursive_directory_iterator entry(directory, code);
  for (const std::filesystem::recursive_directory_iterator end; !code && entry != end; entry.increment(code)) {
    if (const auto closed = unreadable_folder(*entry)) {
      found.push_back(*closed);
      entry.disable_recursion_pending();
    }
    if (!is_elevation_name(entry->path())) continue;
    if (!any_leads_out(entry->path(), root, names))
      add_file(entry->path(), index, found);
    else
      found.push_back(error::Error{entry->path().string(), "a file inside " + root.string(), "a link that leads out",
                                   "copy the cell into the folder, or give the folder of its target", false}
                          .message());
  }
  if (code)
    return error::fail(directory.string(), "a directory that can be read", lower_first(error::reason_of(code.value())),
                       "check its permissions");
  add_cultures(index, names);
  std::sort(found.begin(), found.end());
  if (index.empty() && !found.empty())
    return error::fail(directory.string(), "elevation cells that can be used",
                       "none; the first of " + std::to_string(found.size()) + " problems: " + found.front());
  if (index.empty())
    return error::fail(directory.string(), "elevation cells named like w122/n36.dt1 or N36W122.hgt", "none",
                       "give another directory or make cells with `yars terrain generate`");
  if (problems != nullptr) problems->insert(problems->end(), found.begin(), found.end());
  return index;
}

error::Expected<DirectoryIndex> index_file(const std::filesystem::path& path) {
  DirectoryIndex index;
  const auto length = file_length(path);
  if (!length) return tl::unexpected(length.error());
  const std::filesystem::path whole = std::filesystem::absolute(path);
  const auto named = cell_named(whole.parent_path().filename().string(), whole.filename().string());
  if (named) {
    add_candidate(named->corner, described(path, *named), index);
  } else if (const auto added = is_ded_name(path) ? add_ded(path, index) : add_raster(path, index); !added) {
    return tl::unexpected(added.error());
  }
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
