#include "model/terrain/culture_reader.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "lib/imageio/indexed_png.hpp"
#include "model/terrain/culture_tile.hpp"

namespace yars::model::terrain {

failure::Expected<Culture> read_culture(const std::filesystem::path& path, CellPlace place) {
  const failure::Expected<imageio::IndexedImage> image = imageio::read_indexed_png(path, kMostCulturePosts);
  if (!image) return tl::unexpected(image.error());
  if (image->width < 2 || image->height < 2)
    return failure::fail(path.string(), "at least 2 x 2 posts",
                         std::to_string(image->width) + " x " + std::to_string(image->height));
  const auto width = static_cast<std::ptrdiff_t>(image->width);
  const auto wrong = std::find_if(image->pixels.begin(), image->pixels.end(),
                                  [](std::uint8_t code) { return code > kLargestMaterial; });
  if (wrong != image->pixels.end()) {
    const std::ptrdiff_t at = wrong - image->pixels.begin();
    return failure::fail(path.string(), "surface material codes from 0 to " + std::to_string(kLargestMaterial),
                         "code " + std::to_string(*wrong) + " at column " + std::to_string(at % width) + " of row " +
                             std::to_string(at / width) + " from the north",
                         "number the palette by the codes of DFAD");
  }
  std::vector<std::uint8_t> codes(image->pixels.size());
  for (std::ptrdiff_t row = 0; row < image->height; ++row)
    std::copy_n(image->pixels.begin() + row * width, width, codes.end() - (row + 1) * width);
  return Culture(place, image->height, image->width, std::move(codes));
}

}  // namespace yars::model::terrain
