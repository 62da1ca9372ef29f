#include "model/terrain/formats/culture.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "lib/error/error.hpp"
#include "lib/file/folder.hpp"
#include "lib/file/text_file.hpp"
#include "lib/imageio/png.hpp"
#include "lib/text/plain_text.hpp"
#include "model/terrain/formats/cell_reading.hpp"

namespace yars::model::terrain {

namespace {

// The highest code, without a branch, so that the compiler uses SIMD.
std::uint8_t highest_of(std::span<const std::uint8_t> codes) {
  std::uint8_t highest = 0;
  for (const std::uint8_t code : codes) highest = std::max(highest, code);
  return highest;
}

}  // namespace

Culture::Culture(CellCorner corner, int rows, int columns, std::span<const std::uint8_t> bytes)
    : corner_(corner),
      rows_(rows),
      columns_(columns),
      blocks_(rows, columns, bytes),
      has_water_(highest_of(bytes) > kMaxMaterial) {}

std::vector<std::uint8_t> Culture::posts() const {
  const auto columns = static_cast<std::size_t>(columns_);
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(rows_) * columns);
  for (int row = 0; row < rows_; ++row)
    blocks_.copy_row(row, std::span(bytes).subspan(static_cast<std::size_t>(row) * columns, columns));
  return bytes;
}

Culture Culture::reduced(int reduction) const {
  if (reduction == 0) return *this;
  const auto step_of = [reduction](int intervals) {
    int step = 1;
    for (int halving = 0; halving < reduction && intervals % (2 * step) == 0 && intervals > 2 * step; ++halving)
      step *= 2;
    return step;
  };
  const int row_step = step_of(rows_ - 1);
  const int column_step = step_of(columns_ - 1);
  std::vector<std::uint8_t> bytes;
  for (int row = 0; row < rows_; row += row_step)
    for (int column = 0; column < columns_; column += column_step) bytes.push_back(blocks_.post(row, column));
  return {corner_, (rows_ - 1) / row_step + 1, (columns_ - 1) / column_step + 1, bytes};
}

Cover Culture::nearest(double north_deg, double east_deg) const {
  const auto row = static_cast<int>(std::lround(std::clamp(north_deg, 0.0, 1.0) * (rows_ - 1)));
  const auto column = static_cast<int>(std::lround(std::clamp(east_deg, 0.0, 1.0) * (columns_ - 1)));
  return post(row, column);
}

std::filesystem::path culture_path(const std::filesystem::path& elevation) {
  std::filesystem::path stem = elevation;
  const std::string ending = file::lower_case(stem.extension().string());
  if (ending == ".zip" || ending == ".gz") stem.replace_extension();
  return stem.replace_extension(".smc.png");
}

bool is_culture_name(const std::filesystem::path& path) {
  return file::lower_case(path.filename().string()).ends_with(".smc.png");
}

std::optional<std::filesystem::path> find_culture(const std::filesystem::path& elevation, file::FolderNames& names) {
  return names.find(culture_path(elevation));
}

std::optional<std::filesystem::path> find_culture(const std::filesystem::path& elevation) {
  file::FolderNames names;
  return find_culture(elevation, names);
}

error::Expected<void> remove_culture(const std::filesystem::path& elevation) {
  for (auto path = find_culture(elevation); path; path = find_culture(elevation)) {
    const auto folder = file::Folder::open(path->parent_path());
    if (!folder) return tl::unexpected(folder.error());
    if (!folder->remove(path->filename().string()))
      return error::fail(path->string(), "an older culture that can be removed",
                         std::error_code(errno, std::generic_category()).message(), "remove it");
  }
  return {};
}

namespace {

constexpr std::array<std::string_view, 14> kNames{"land",    "metal", "part metal", "stone", "composition",
                                                  "earthen", "water", "sand",       "rock",  "asphalt",
                                                  "soil",    "marsh", "trees",      "snow"};

// Red, green, blue by surface material code, 0 to 13 (Material).
constexpr std::array<std::array<std::uint8_t, 3>, 14> kColours = {{{0, 0, 0},
                                                                   {214, 64, 64},
                                                                   {190, 110, 96},
                                                                   {168, 96, 104},
                                                                   {196, 152, 132},
                                                                   {150, 120, 80},
                                                                   {48, 86, 140},
                                                                   {226, 208, 150},
                                                                   {132, 124, 116},
                                                                   {84, 84, 92},
                                                                   {170, 172, 110},
                                                                   {104, 138, 122},
                                                                   {62, 104, 58},
                                                                   {246, 248, 252}}};

}  // namespace

std::string_view material_name(std::uint8_t code) {
  return code < kNames.size() ? kNames[code] : std::string_view();
}

std::optional<std::uint8_t> material_of(std::string_view text) {
  const auto named = std::find(kNames.begin(), kNames.end(), text);
  if (named != kNames.end()) return static_cast<std::uint8_t>(named - kNames.begin());
  const auto code = text::whole_number<std::uint8_t>(text);
  return code && *code <= kMaxMaterial ? code : std::nullopt;
}

std::array<std::uint8_t, 3> material_colour(std::uint8_t code) {
  constexpr std::array<std::uint8_t, 3> kUnnamed = {128, 128, 128};
  return code < kColours.size() ? kColours[code] : kUnnamed;
}

namespace {
// Colours of all bytes of a culture file.
std::vector<imageio::PaletteColour> cover_palette() {
  std::vector<imageio::PaletteColour> palette;
  const auto water = material_colour(static_cast<std::uint8_t>(Material::water));
  for (int byte = 0; byte < 256; ++byte) {
    const Cover cover = cover_of(static_cast<std::uint8_t>(byte));
    imageio::PaletteColour colour = material_colour(cover.material);
    for (std::size_t i = 0; i < colour.size(); ++i) {
      const int dry = colour[i], wet = water[i];
      colour[i] = static_cast<std::uint8_t>(std::lround(dry + cover.water.value_or(0.0) * (wet - dry)));
    }
    palette.push_back(colour);
  }
  return palette;
}
}  // namespace

error::Expected<Culture> read_culture(const std::filesystem::path& path, CellCorner corner) {
  std::vector<std::uint8_t>& buffer = reading_buffers().codes;
  error::Expected<imageio::IndexedImage> image = imageio::read_indexed_png(path, kMaxCulturePosts, std::move(buffer));
  if (!image) return tl::unexpected(image.error());
  if (image->width < 2 || image->height < 2)
    return error::fail(path.string(), "at least 2 x 2 posts",
                       std::to_string(image->width) + " x " + std::to_string(image->height));
  const auto width = static_cast<std::ptrdiff_t>(image->width);
  if (highest_of(image->pixels) > kMaxMaterial && image->palette != cover_palette()) {
    const auto wrong =
        std::find_if(image->pixels.begin(), image->pixels.end(), [](std::uint8_t code) { return code > kMaxMaterial; });
    const std::ptrdiff_t at = wrong - image->pixels.begin();
    return error::fail(path.string(), "surface material codes from 0 to " + std::to_string(kMaxMaterial),
                       "code " + std::to_string(*wrong) + " at column " + std::to_string(at % width) + " of row " +
                           std::to_string(at / width) + " from the north",
                       "use the DFAD codes as palette indices");
  }
  for (std::ptrdiff_t row = 0; row < image->height / 2; ++row)
    std::swap_ranges(image->pixels.begin() + row * width, image->pixels.begin() + (row + 1) * width,
                     image->pixels.end() - (row + 1) * width);
  Culture culture(corner, image->height, image->width, image->pixels);
  buffer = std::move(image->pixels);
  return culture;
}

error::Expected<void> write_culture(const std::filesystem::path& path, const Culture& culture) {
  if (auto folder = file::Folder::make(path.parent_path()); !folder) return tl::unexpected(folder.error());
  imageio::IndexedImage image{culture.columns(), culture.rows(), {}, {}};
  image.palette = cover_palette();
  if (!culture.has_water()) image.palette.resize(kMaxMaterial + 1);
  const std::vector<std::uint8_t> posts = culture.posts();
  image.pixels.resize(posts.size());
  const auto width = static_cast<std::ptrdiff_t>(culture.columns());
  for (std::ptrdiff_t row = 0; row < culture.rows(); ++row)
    std::copy_n(posts.begin() + row * width, width, image.pixels.end() - (row + 1) * width);
  return imageio::write_indexed_png(path, image);
}

}  // namespace yars::model::terrain
