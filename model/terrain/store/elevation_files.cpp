#include "model/terrain/store/elevation_files.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <system_error>
#include <utility>

#include "lib/file/text_file.hpp"
#include "lib/text/plain_text.hpp"
#include "model/terrain/formats/cell_reading.hpp"
#include "model/terrain/formats/ded.hpp"
#include "model/terrain/formats/dted.hpp"
#include "model/terrain/formats/hgt.hpp"
#include "model/terrain/formats/pack.hpp"
#include "model/terrain/gdal/raster.hpp"

namespace yars::model::terrain {

namespace {

using file::lower_case;
using Extensions = std::span<const std::string_view>;

constexpr std::string_view kDted[] = {".dt0", ".dt1", ".dt2"};
constexpr std::string_view kRasters[] = {".tif", ".tiff", ".jp2", ".img", ".vrt"};
constexpr std::string_view kArchives[] = {".zip", ".gz"};
// Elevation that `yars terrain convert` reads through GDAL, one file at a time.
constexpr std::string_view kConvertible[] = {".asc", ".bil", ".bt", ".dem"};
constexpr std::string_view kForeign[] = {".nc", ".grd", ".adf", ".xyz", ".las", ".laz", ".dt3", ".dt4", ".dt5"};
// Files beside elevation, which may have the name of its cell.
constexpr std::string_view kBeside[] = {".side", ".xml", ".prj", ".aux",  ".ovr",  ".msk",  ".hdr",    ".tfw",
                                        ".txt",  ".png", ".jpg", ".jpeg", ".html", ".pdf",  ".md",     ".json",
                                        ".csv",  ".kml", ".num", ".flt",  ".guf",  ".yaml", ".sha256", ".md5"};

std::string extension_of(const std::filesystem::path& path) {
  return lower_case(path.extension().string());
}

bool has_one_of(const std::filesystem::path& path, Extensions extensions) {
  return std::find(extensions.begin(), extensions.end(), extension_of(path)) != extensions.end();
}

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

// The cell of `wLLL/nBB`.
std::optional<CellCorner> corner_named(std::string_view latitude, std::string_view longitude) {
  const std::optional<int> south_deg = signed_degrees(latitude, 'n', 's', 2);
  const std::optional<int> west_deg = signed_degrees(longitude, 'e', 'w', 3);
  if (!south_deg || !west_deg) return std::nullopt;
  if (*south_deg < -90 || *south_deg > 89 || *west_deg < -180 || *west_deg > 179) return std::nullopt;
  return CellCorner{*south_deg, *west_deg};
}

std::optional<NamedCell> cell_named(const std::filesystem::path& path) {
  return terrain::cell_named(path.parent_path().filename().string(), path.filename().string());
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
  const bool packed = text.ends_with(".hgt.zip") || text.ends_with(".hgt.gz");
  if (!packed && !text.ends_with(".hgt")) return std::nullopt;
  const std::optional<CellCorner> corner = corner_in_name(text);
  if (!corner) return std::nullopt;
  return NamedCell{*corner, packed ? CellFormat::compressed_hgt : CellFormat::hgt};
}

ElevationKind elevation_kind(const std::filesystem::path& path) {
  const std::string name = path.filename().string();
  // Files beside those of a Mac begin with ._ and hold no elevation, whatever their name.
  if (name.starts_with('.')) return ElevationKind::none;
  if (cell_named(path) || has_one_of(path, kDted) || has_one_of(path, kRasters) || extension_of(path) == ".ded")
    return ElevationKind::readable;
  if (extension_of(path) == ".hgt") return ElevationKind::unplaced;
  if (has_one_of(path, kArchives)) return ElevationKind::archive;
  if (has_one_of(path, kConvertible)) return ElevationKind::convertible;
  const bool foreign = has_one_of(path, kForeign) || (corner_in_name(name) && !has_one_of(path, kBeside));
  return foreign ? ElevationKind::foreign : ElevationKind::none;
}

namespace {

using Found = error::Expected<std::vector<FoundCell>>;

// The file of a cell, with the spacing of its posts if the file's name, length or header states the spacing.
CellFile described(const std::filesystem::path& path, const NamedCell& named) {
  const auto with_posts = [&](GridSize grid) {
    return CellFile{path, named.format, std::max(0, grid.rows - 1), std::max(0, grid.columns - 1)};
  };
  std::error_code code;
  if (named.format == CellFormat::dted) {
    const int rows = dted::kPostsOfLevel[named.level];
    return with_posts({rows, (rows - 1) / dted::zone_factor(named.corner.south_deg) + 1});
  }
  if (named.format == CellFormat::pack) return with_posts(pack_size(path));
  // The length of an uncompressed HGT file gives its spacing, so that the file need not be opened.
  const std::uintmax_t size = std::filesystem::file_size(path, code);
  if (named.format == CellFormat::compressed_hgt) return with_posts(compressed_hgt_grid(path, named.corner));
  return with_posts(code ? GridSize{} : hgt_grid_for_size(size));
}

Found cells_of_ded(const std::filesystem::path& path) {
  const auto cells = ded_cells(path);
  if (!cells) return tl::unexpected(cells.error());
  std::vector<FoundCell> found;
  for (const DedCell& cell : *cells)
    found.push_back({cell.corner, {path, CellFormat::ded, cell.rows - 1, cell.columns - 1}});
  return found;
}

Found cells_of_dted(const std::filesystem::path& path) {
  const auto place = dted_place(path);
  if (!place) return tl::unexpected(place.error());
  return std::vector<FoundCell>{
      {place->corner, {path, CellFormat::dted, place->grid.rows - 1, place->grid.columns - 1}}};
}

// Errors: also a DTED file whose datums are not WGS84 and mean sea level. GDAL would ignore these datums.
Found cells_of_raster(const std::filesystem::path& path) {
  if (extension_of(path) == ".vrt")
    return error::fail(path.string(), "a raster that holds its own heights",
                       "a .vrt, which may name any file or address", "make a GeoTIFF of it with gdal_translate");
  const auto summary = gdal::describe_raster(path);
  if (!summary) return tl::unexpected(summary.error());
  if (summary->dted_datums) {
    const auto& [vertical, horizontal] = *summary->dted_datums;
    if (const auto checked = check_dted_datums(vertical, horizontal, path.string()); !checked)
      return tl::unexpected(checked.error());
  }
  std::vector<FoundCell> found;
  const auto add = [&](const std::vector<gdal::RasterCell>& cells) {
    for (const gdal::RasterCell& cell : cells)
      found.push_back(
          {{cell.south_deg, cell.west_deg},
           {path, CellFormat::raster, cell.posts_per_degree_north, cell.posts_per_degree_east, cell.covered}});
  };
  add(summary->cells);
  add(summary->edges);
  return found;
}

Found cells_of_archive(const std::filesystem::path& path) {
  const auto packed = packed_hgt_files(path);
  if (!packed) return tl::unexpected(packed.error());
  std::vector<FoundCell> found;
  for (const CellCorner corner : packed->cells)
    found.push_back({corner, described(path, {corner, CellFormat::compressed_hgt})});
  if (!found.empty()) return found;
  for (const std::string& name : packed->others)
    if (elevation_kind(name) != ElevationKind::none)
      return error::fail(path.string(), "an archive with HGT", "'" + name + "', which is read only unpacked",
                         "unpack the archive");
  return found;
}

// DTED that is not one cell of a degree is a raster for GDAL.
Found cells_of_dted_or_raster(const std::filesystem::path& path) {
  Found found = cells_of_dted(path);
  if (found || !gdal::available()) return found;
  Found raster = cells_of_raster(path);
  return raster ? raster : found;
}

}  // namespace

error::Expected<std::vector<FoundCell>> cells_in_file(const std::filesystem::path& path) {
  if (const auto named = cell_named(path)) return std::vector<FoundCell>{{named->corner, described(path, *named)}};
  if (extension_of(path) == ".ded") return cells_of_ded(path);
  if (has_one_of(path, kDted)) return cells_of_dted_or_raster(path);
  switch (elevation_kind(path)) {
    case ElevationKind::unplaced:
      return error::fail(path.string(), "HGT whose name states its cell, as N36W122.hgt", "a name without a cell",
                         "rename it after the south-west corner of its cell");
    case ElevationKind::archive:
      return cells_of_archive(path);
    default:
      return begins_as_dted(path) ? cells_of_dted_or_raster(path) : cells_of_raster(path);
  }
}

}  // namespace yars::model::terrain
