#include "model/terrain/culture_writer.hpp"

#include <algorithm>

#include "lib/file/folder.hpp"
#include "lib/imageio/indexed_png.hpp"

namespace yars::model::terrain {

namespace {

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

std::array<std::uint8_t, 3> material_colour(std::uint8_t code) {
  constexpr std::array<std::uint8_t, 3> kUnnamed = {128, 128, 128};
  return code < kColours.size() ? kColours[code] : kUnnamed;
}

failure::Expected<void> write_culture(const std::filesystem::path& path, const Culture& culture) {
  if (auto folder = file::Folder::make(path.parent_path()); !folder) return tl::unexpected(folder.error());
  imageio::IndexedImage image{culture.columns(), culture.rows(), {}, {}};
  for (std::uint8_t material = 0; material <= kLargestMaterial; ++material)
    image.palette.push_back(material_colour(material));
  image.pixels.resize(culture.codes().size());
  const auto width = static_cast<std::ptrdiff_t>(culture.columns());
  for (std::ptrdiff_t row = 0; row < culture.rows(); ++row)
    std::copy_n(culture.codes().begin() + row * width, width, image.pixels.end() - (row + 1) * width);
  return imageio::write_indexed_png(path, image);
}

}  // namespace yars::model::terrain
