#include "model/terrain/directory_index.hpp"

#include <algorithm>
#include <cctype>
#include <optional>
#include <system_error>
#include <tuple>
#include <utility>

#include "model/terrain/culture_tile.hpp"
#include "model/terrain/ded_reader.hpp"
#include "model/terrain/dted_format.hpp"
#include "model/terrain/gdal/raster.hpp"
#include "model/terrain/hgt_reader.hpp"
#include "model/terrain/link_target.hpp"
#include "model/terrain/pack_reader.hpp"
#include "model/terrain/packed_hgt_reader.hpp"

namespace yars::model::terrain {

namespace {

constexpr double kWhole = 0.99;  // share of a cell: a raster may miss the last row and column

// Smaller is better.
auto rank(const CellFile& file) {
  return std::tuple(file.covered < kWhole, -file.posts_per_degree, static_cast<int>(file.format), file.path.string());
}

void offer(CellPlace place, CellFile file, DirectoryIndex& index) {
  const auto [entry, fresh] = index.try_emplace(slot_of(place), file);
  if (!fresh && rank(file) < rank(entry->second)) entry->second = std::move(file);
}

CellFile described(const std::filesystem::path& path, const NamedCell& named) {
  const auto with_posts = [&](int rows, int columns) {
    return CellFile{path, named.format, std::max(0, rows - 1), std::max(0, columns - 1)};
  };
  std::error_code code;
  if (named.format == CellFormat::dted) {
    const int rows = dted::kPostsOfLevel[named.level];
    return with_posts(rows, (rows - 1) / dted::zone_factor(named.place.south_deg) + 1);
  }
  if (named.format == CellFormat::pack) {
    const GridSize size = pack_size(path);
    return with_posts(size.rows, size.columns);
  }
  // An HGT file's spacing is its length's: the directory knows that without opening it.
  const std::uintmax_t size = std::filesystem::file_size(path, code);
  const int posts = named.format == CellFormat::packed_hgt ? packed_hgt_posts(path)
                    : code                                 ? 0
                                                           : hgt_posts_for_size(size);
  return with_posts(posts, posts);
}

// The cells of a file whose header tells them; its error where it cannot be used.
failure::Expected<void> offer_ded(const std::filesystem::path& path, DirectoryIndex& index) {
  const auto cells = ded_cells(path);
  if (!cells) return tl::unexpected(cells.error());
  for (const DedCell& cell : *cells) offer(cell.place, {path, CellFormat::ded, cell.rows - 1, cell.columns - 1}, index);
  return {};
}

failure::Expected<void> offer_raster(const std::filesystem::path& path, DirectoryIndex& index) {
  if (is_virtual_raster_name(path))
    return failure::fail(path.string(), "a raster that holds its own heights",
                         "a .vrt, which may name any file or address", "make a GeoTIFF of it with gdal_translate");
  const auto raster = gdal::describe_raster(path);
  if (!raster) return tl::unexpected(raster.error());
  for (const gdal::RasterCell& cell : raster->cells)
    offer({cell.south_deg, cell.west_deg},
          {path, CellFormat::raster, cell.posts_per_degree_north, cell.posts_per_degree_east, cell.covered}, index);
  return {};
}

// The file itself, its map of materials and the other half of a pack.
bool leads_anywhere_out(const std::filesystem::path& path, const std::filesystem::path& root) {
  return leads_out(path, root) || leads_out(culture_path(path), root) ||
         leads_out(std::filesystem::path(path).replace_extension(".side"), root);
}

bool is_elevation_name(const std::filesystem::path& path) {
  return cell_named(path.parent_path().filename().string(), path.filename().string()) || is_ded_name(path) ||
         is_raster_name(path);
}

std::string lower_first(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
  return text;
}

// A problem where a folder below cannot be looked into.
std::optional<std::string> closed_folder(const std::filesystem::directory_entry& entry) {
  std::error_code code;
  if (!entry.is_directory(code) || entry.is_symlink(code)) return std::nullopt;
  const std::filesystem::directory_iterator look(entry.path(), code);
  if (!code) return std::nullopt;
  return failure::Error{entry.path().string(), "a folder that can be read", lower_first(code.message()),
                        "check its permissions", false}
      .message();
}

// `index` or `problems` gets something.
void offer_file(const std::filesystem::path& path, DirectoryIndex& index, std::vector<std::string>& problems) {
  const auto named = cell_named(path.parent_path().filename().string(), path.filename().string());
  if (named) {
    offer(named->place, described(path, *named), index);
    return;
  }
  const auto offered = is_ded_name(path) ? offer_ded(path, index) : offer_raster(path, index);
  if (!offered) problems.push_back(offered.error().message());
}

}  // namespace

failure::Expected<DirectoryIndex> index_directory(const std::filesystem::path& directory,
                                                  std::vector<std::string>* problems) {
  std::error_code code;
  if (!std::filesystem::is_directory(directory, code))
    return failure::fail(directory.string(), "a directory with elevation cells", code ? code.message() : "no directory",
                         "make one with `yars terrain generate --out DIR`");
  DirectoryIndex index;
  std::vector<std::string> found;
  const std::filesystem::path root = std::filesystem::weakly_canonical(directory, code);
  std::filesystem::recursive_directory_iterator entry(directory, code);
  for (const std::filesystem::recursive_directory_iterator end; !code && entry != end; entry.increment(code)) {
    if (const auto closed = closed_folder(*entry)) {
      found.push_back(*closed);
      entry.disable_recursion_pending();
    }
    if (!is_elevation_name(entry->path())) continue;
    if (!leads_anywhere_out(entry->path(), root))
      offer_file(entry->path(), index, found);
    else
      found.push_back(failure::Error{entry->path().string(), "a file inside " + root.string(), "a link that leads out",
                                     "copy the cell there, or give the folder that it lies in", false}
                          .message());
  }
  if (code)
    return failure::fail(directory.string(), "a directory that can be read", lower_first(code.message()),
                         "check its permissions");
  std::sort(found.begin(), found.end());
  if (index.empty() && !found.empty())
    return failure::fail(directory.string(), "elevation cells that can be used",
                         "none; of " + std::to_string(found.size()) + " the first: " + found.front());
  if (index.empty())
    return failure::fail(directory.string(), "elevation cells named like w122/n36.dt1 or N36W122.hgt", "none",
                         "give another directory or make cells with `yars terrain generate`");
  if (problems != nullptr) problems->insert(problems->end(), found.begin(), found.end());
  return index;
}

failure::Expected<DirectoryIndex> index_file(const std::filesystem::path& path) {
  DirectoryIndex index;
  const auto length = file_length(path);
  if (!length) return tl::unexpected(length.error());
  const std::filesystem::path whole = std::filesystem::absolute(path);
  const auto named = cell_named(whole.parent_path().filename().string(), whole.filename().string());
  if (named) {
    offer(named->place, described(path, *named), index);
    return index;
  }
  const auto offered = is_ded_name(path) ? offer_ded(path, index) : offer_raster(path, index);
  if (!offered) return tl::unexpected(offered.error());
  return index;
}

}  // namespace yars::model::terrain
