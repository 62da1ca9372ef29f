#include "model/terrain/gdal/map_writer.hpp"

#include <ogr_srs_api.h>

#include <array>
#include <cstdio>
#include <limits>
#include <memory>
#include <system_error>
#include <type_traits>

#include "model/terrain/gdal/open_raster.hpp"

namespace yars::model::terrain::gdal {

namespace {

struct DestroyReference {
  void operator()(OGRSpatialReferenceH reference) const { OSRDestroySpatialReference(reference); }
};
using Reference = std::unique_ptr<std::remove_pointer_t<OGRSpatialReferenceH>, DestroyReference>;

Reference plane_about(double latitude_deg, double longitude_deg) {
  Reference plane(OSRNewSpatialReference(nullptr));
  std::array<char, 160> text{};
  std::snprintf(text.data(), text.size(),
                "+proj=aeqd +lat_0=%.12f +lon_0=%.12f +x_0=0 +y_0=0 +datum=WGS84 +units=m +no_defs", latitude_deg,
                longitude_deg);
  if (OSRImportFromProj4(plane.get(), text.data()) != OGRERR_NONE) plane.reset();
  return plane;
}

// False at the first failure; GDAL has said why.
bool fill(GDALDatasetH dataset, const MapPicture& picture) {
  const Reference plane = plane_about(picture.origin_latitude_deg, picture.origin_longitude_deg);
  std::array<double, 6> geotransform = picture.plane_from_pixel;
  if (!plane || GDALSetSpatialRef(dataset, plane.get()) != CE_None ||
      GDALSetGeoTransform(dataset, geotransform.data()) != CE_None)
    return false;
  GDALRasterBandH const band = GDALGetRasterBand(dataset, 1);
  GDALSetDescription(band, picture.description.c_str());
  const auto write = [&](const auto& pixels, GDALDataType type) {
    auto* const values = const_cast<void*>(static_cast<const void*>(pixels.data()));  // GDAL reads from it
    return GDALRasterIO(band, GF_Write, 0, 0, picture.columns, picture.rows, values, picture.columns, picture.rows,
                        type, 0, 0) == CE_None;
  };
  if (const auto* bytes = std::get_if<std::vector<std::uint8_t>>(&picture.pixels)) return write(*bytes, GDT_Byte);
  if (GDALSetRasterNoDataValue(band, std::numeric_limits<double>::quiet_NaN()) != CE_None) return false;
  return write(std::get<std::vector<float>>(picture.pixels), GDT_Float32);
}

}  // namespace

failure::Expected<void> write_map(const std::filesystem::path& path, const MapPicture& picture) {
  const MessageKeeper messages;
  GDALDriverH const driver = GDALGetDriverByName("GTiff");
  const bool bytes = std::holds_alternative<std::vector<std::uint8_t>>(picture.pixels);
  const std::filesystem::path absolute = std::filesystem::absolute(path);
  std::array<const char*, 2> creation{"COMPRESS=DEFLATE", nullptr};
  Dataset dataset(driver != nullptr ? GDALCreate(driver, absolute.c_str(), picture.columns, picture.rows, 1,
                                                 bytes ? GDT_Byte : GDT_Float32, const_cast<char**>(creation.data()))
                                    : nullptr);
  const bool created = dataset != nullptr;
  const bool filled = created && fill(dataset.get(), picture);
  dataset.reset();  // what is buffered is written at the latest by this
  if (filled && messages.first_or("").empty()) return {};
  std::error_code ignored;
  if (created && std::filesystem::is_regular_file(absolute, ignored)) std::filesystem::remove(absolute, ignored);
  return failure::fail(path.string(), "a file that can be written", messages.first_or("a failure of GDAL"),
                       "check the folder and the space left");
}

}  // namespace yars::model::terrain::gdal
