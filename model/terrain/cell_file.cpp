#include "model/terrain/cell_file.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>
#include <utility>

#include "lib/failure/require.hpp"
#include "model/terrain/ded_reader.hpp"
#include "model/terrain/dted_reader.hpp"
#include "model/terrain/gdal/raster.hpp"
#include "model/terrain/hgt_reader.hpp"
#include "model/terrain/pack_reader.hpp"
#include "model/terrain/packed_hgt_reader.hpp"
#include "model/terrain/reduce.hpp"

namespace yars::model::terrain {

namespace {

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return text;
}

// A hemisphere letter and so many digits, as signed degrees.
std::optional<int> signed_degrees(std::string_view text, char positive, char negative, std::size_t digits) {
  if (text.size() != digits + 1 || (text[0] != positive && text[0] != negative)) return std::nullopt;
  int degrees = 0;
  for (const char digit : text.substr(1)) {
    if (digit < '0' || digit > '9') return std::nullopt;
    degrees = degrees * 10 + (digit - '0');
  }
  return text[0] == positive ? degrees : -degrees;
}

std::optional<CellPlace> place_named(std::string_view latitude, std::string_view longitude) {
  const std::optional<int> south_deg = signed_degrees(latitude, 'n', 's', 2);
  const std::optional<int> west_deg = signed_degrees(longitude, 'e', 'w', 3);
  if (!south_deg || !west_deg) return std::nullopt;
  if (*south_deg < -90 || *south_deg > 89 || *west_deg < -180 || *west_deg > 179) return std::nullopt;
  return CellPlace{*south_deg, *west_deg};
}

failure::Expected<CellReading> read_whole(const CellFile& file, CellPlace place) {
  switch (file.format) {
    case CellFormat::dted:
      return read_dted(file.path, place);
    case CellFormat::hgt:
      return read_hgt(file.path, place);
    case CellFormat::ded:
      return read_ded(file.path, place);
    default:
      return read_packed_hgt(file.path, place);
  }
}

failure::Expected<CellReading> reduced(failure::Expected<CellReading> reading, int reduction) {
  if (!reading || reduction == 0) return reading;
  ReducedCell coarse = reduce(reading->cell, reduction);
  reading->cell = std::move(coarse.means);
  reading->peaks = std::move(coarse.peaks);
  return reading;
}

struct PostsPerDegree {
  int north = 0, east = 0;
};

failure::Expected<PostsPerDegree> posts_of(const CellFile& file, CellPlace place) {
  if (file.posts_per_degree > 0 && file.posts_per_degree_east > 0)
    return PostsPerDegree{file.posts_per_degree, file.posts_per_degree_east};
  const auto summary = gdal::describe_raster(file.path);
  if (!summary) return tl::unexpected(summary.error());
  for (const gdal::RasterCell& cell : summary->cells)
    if (CellPlace{cell.south_deg, cell.west_deg} == place)
      return PostsPerDegree{cell.posts_per_degree_north, cell.posts_per_degree_east};
  return failure::fail(file.path.string(),
                       "a raster that touches the cell with the south-west corner " + std::to_string(place.south_deg) +
                           ", " + std::to_string(place.west_deg),
                       "one that lies elsewhere");
}

failure::Expected<CellReading> read_raster_cell(const CellFile& file, CellPlace place, int reduction) {
  static_assert(gdal::kNoHeight == kVoidPost);
  const auto whole = posts_of(file, place);
  if (!whole) return tl::unexpected(whole.error());
  auto [north, east] = *whole;
  // Peaks are of the posts that are read: no coarser than an arc second.
  constexpr int kFinestReduced = 3600;
  int left = reduction;
  for (; left > 0 && std::max(north, east) > kFinestReduced && north % 2 == 0 && east % 2 == 0; --left) {
    north /= 2;
    east /= 2;
  }
  auto posts = gdal::read_raster(file.path, place.south_deg, place.west_deg, north, east);
  if (!posts) return tl::unexpected(posts.error());
  CellReading reading{Cell(place, posts->rows, posts->columns, posts->posts, posts->unit_m),
                      std::nullopt,
                      {},
                      std::move(posts->warnings),
                      posts->impossible};
  // A reduced reading always has peaks, also where smoothing was all of it.
  if (reduction > 0 && left == 0) reading.peaks = reading.cell;
  return reduced(std::move(reading), left);
}

}  // namespace

std::optional<NamedCell> cell_named(const std::string& folder, const std::string& file) {
  const std::string name = lower_case(file);
  const std::string_view view = name;
  if (view.size() == 7 && view[3] == '.') {
    const std::optional<CellPlace> place = place_named(view.substr(0, 3), lower_case(folder));
    if (place && view.substr(4, 2) == "dt" && view[6] >= '0' && view[6] <= '2')
      return NamedCell{*place, CellFormat::dted, view[6] - '0'};
    if (place && view.substr(4) == "jp2") return NamedCell{*place, CellFormat::pack};
  }
  if (view.size() >= 11 && view.substr(7, 4) == ".hgt") {
    const std::string_view packing = view.substr(11);
    const std::optional<CellPlace> place = place_named(view.substr(0, 3), view.substr(3, 4));
    if (place && packing.empty()) return NamedCell{*place, CellFormat::hgt};
    if (place && (packing == ".zip" || packing == ".gz")) return NamedCell{*place, CellFormat::packed_hgt};
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

failure::Expected<CellReading> read_cell(const CellFile& file, CellPlace place, int reduction) {
  YARS_REQUIRE(reduction, >=, 0);
  if (file.format == CellFormat::pack) return read_pack(file.path, place, reduction);
  if (file.format == CellFormat::raster) return read_raster_cell(file, place, reduction);
  return reduced(read_whole(file, place), reduction);
}

}  // namespace yars::model::terrain
