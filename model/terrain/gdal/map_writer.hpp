// Writer of a picture as a georeferenced GeoTIFF, through GDAL.
// Input: pixels (bytes or floats), an origin, an affine transform from pixels to the plane. Output: a file.
// Frame: azimuthal equidistant plane on WGS84 about the origin, x east and y north [m]. Distances and bearings from the
//   origin are exact; bearings count from true north. The affine transform states the upper left corner, the size of
//   pixels and the directions of rows and columns.
// Errors: GDAL fails, the file cannot be written, the system lacks the library of GDAL or PROJ, or the build has no
// GDAL
//   (gdal_absent.cpp).
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
  // GDAL geotransform t: x = t[0] + column t[1] + row t[2], y = t[3] + column t[4] + row t[5]. Column 0, row 0 is the
  // upper left corner of the picture.
  std::array<double, 6> plane_from_pixel{};
  // Row by row from the top. In a float picture, NaN is declared as no data.
  std::variant<std::vector<std::uint8_t>, std::vector<float>> pixels;
  std::string description;  // stored with the raster band
};

// Writes the picture as a GeoTIFF. A failed write leaves an earlier file at `path` unchanged.
error::Expected<void> write_map(const std::filesystem::path& path, const MapPicture& picture);

}  // namespace yars::model::terrain::gdal
