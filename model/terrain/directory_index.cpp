#include "model/terrain/directory_index.hpp"

#include <algorithm>
#include <cctype>
#include <string_view>
#include <system_error>
#include <tuple>

#include "model/terrain/dted_format.hpp"
#include "model/terrain/dted_reader.hpp"
#include "model/terrain/hgt_reader.hpp"

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

// Smaller is better.
auto rank(const CellFile& file) {
  return std::tuple(-file.posts_per_degree, static_cast<int>(file.format), file.path.string());
}

CellFile described(const std::filesystem::directory_entry& entry, const NamedCell& named) {
  CellFile file{entry.path(), named.format, 0};
  std::error_code code;
  if (named.format == CellFormat::dted) file.posts_per_degree = dted::kPostsOfLevel[named.level] - 1;
  // An HGT file's spacing is its length's: the directory knows that without opening it.
  if (named.format == CellFormat::hgt) {
    const std::uintmax_t size = entry.file_size(code);
    file.posts_per_degree = code ? 0 : std::max(0, hgt_posts_for_size(size) - 1);
  }
  return file;
}

}  // namespace

std::optional<NamedCell> cell_named(const std::string& folder, const std::string& file) {
  const std::string name = lower_case(file);
  const std::string_view view = name;
  if (view.size() == 7 && view.substr(3, 3) == ".dt" && view[6] >= '0' && view[6] <= '2') {
    const std::optional<CellPlace> place = place_named(view.substr(0, 3), lower_case(folder));
    if (place) return NamedCell{*place, CellFormat::dted, view[6] - '0'};
  }
  if (view.size() >= 11 && view.substr(7, 4) == ".hgt") {
    const std::string_view packing = view.substr(11);
    const std::optional<CellPlace> place = place_named(view.substr(0, 3), view.substr(3, 4));
    if (place && packing.empty()) return NamedCell{*place, CellFormat::hgt};
    if (place && (packing == ".zip" || packing == ".gz")) return NamedCell{*place, CellFormat::packed_hgt};
  }
  return std::nullopt;
}

failure::Expected<DirectoryIndex> index_directory(const std::filesystem::path& directory) {
  std::error_code code;
  if (!std::filesystem::is_directory(directory, code))
    return failure::fail(directory.string(), "a directory with elevation cells", code ? code.message() : "no directory",
                         "make one with `yars terrain generate --out DIR`");
  DirectoryIndex index;
  const auto options = std::filesystem::directory_options::skip_permission_denied;
  std::filesystem::recursive_directory_iterator entry(directory, options, code);
  for (const std::filesystem::recursive_directory_iterator end; !code && entry != end; entry.increment(code)) {
    const std::filesystem::path& path = entry->path();
    const auto named = cell_named(path.parent_path().filename().string(), path.filename().string());
    if (!named) continue;
    CellFile file = described(*entry, *named);
    const auto [place, fresh] = index.try_emplace(slot_of(named->place), file);
    if (!fresh && rank(file) < rank(place->second)) place->second = std::move(file);
  }
  if (code) return failure::fail(directory.string(), "a directory that can be walked", code.message());
  if (index.empty())
    return failure::fail(directory.string(), "elevation cells named like w122/n36.dt1 or N36W122.hgt", "none",
                         "give another directory or make cells with `yars terrain generate`");
  return index;
}

failure::Expected<CellReading> read_cell(const CellFile& file, CellPlace place) {
  return file.format == CellFormat::dted ? read_dted(file.path, place) : read_hgt(file.path, place);
}

}  // namespace yars::model::terrain
