// Writes a picture as a GeoTIFF that says where on the earth it lies, through GDAL. A build without GDAL has the same
// function, which fails with a word (gdal_absent.cpp).
// The picture's plane is azimuthal equidistant on WGS84 about `origin`: x east, y north [m], distances and bearings
// from there are true. The affine transform places the upper left corner and turns the rows, as the picture lies.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "lib/error/error.hpp"

namespace yars::model::terrain::gdal {

struct MapPicture {
  int columns = 0;
  int rows = 0;
  double origin_latitude_deg = 0.0;
  double origin_longitude_deg = 0.0;
  // x = [0] + column [1] + row [2], y = [3] + column [4] + row [5]; columns and rows count from the corner.
  std::array<double, 6> plane_from_pixel{};
  // Row by row from the top; reals that are NaN are declared to be no data.
  std::variant<std::vector<std::uint8_t>, std::vector<float>> pixels;
  std::string description;  // of what the pixels are
};

// Errors: the file cannot be written; nothing is left of it then.
error::Expected<void> write_map(const std::filesystem::path& path, const MapPicture& picture);

}  // namespace yars::model::terrain::gdal
