// Writes rasters for tests with GDAL, and transforms coordinates with GDAL and PROJ.
#pragma once

#include <gdal.h>
#include <ogr_srs_api.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string_view>
#include <type_traits>
#include <vector>

namespace yars::test {

struct DestroyTransform {
  void operator()(OGRCoordinateTransformationH transform) const { OCTDestroyCoordinateTransformation(transform); }
};
using Transform = std::unique_ptr<std::remove_pointer_t<OGRCoordinateTransformationH>, DestroyTransform>;

// Transformation between two coordinate systems. Coordinates are in the order longitude, latitude or easting, northing.
inline Transform transform_between(const char* from_system, const char* to_system) {
  const OGRSpatialReferenceH from = OSRNewSpatialReference(nullptr);
  const OGRSpatialReferenceH to = OSRNewSpatialReference(nullptr);
  OSRSetFromUserInput(from, from_system);
  OSRSetFromUserInput(to, to_system);
  OSRSetAxisMappingStrategy(from, OAMS_TRADITIONAL_GIS_ORDER);
  OSRSetAxisMappingStrategy(to, OAMS_TRADITIONAL_GIS_ORDER);
  Transform made(OCTNewCoordinateTransformation(from, to));
  OSRDestroySpatialReference(from);
  OSRDestroySpatialReference(to);
  return made;
}

struct RasterFields {
  int columns = 0, rows = 0;
  std::array<double, 6> geotransform{};  // GDAL geotransform of the pixel corners; rows run southwards
  int epsg = 4326;                       // 0: no coordinate system
  const char* system = nullptr;          // replaces `epsg` if not null; text for OSRSetFromUserInput()
  GDALDataType type = GDT_Int16;
  int bands = 1;
  std::optional<double> void_value = {};
  const char* unit = nullptr;
  double scale = 1.0, offset = 0.0;  // height = scale x pixel value + offset
  const char* driver = "GTiff";
};

// Raster of one degree with `posts` x `posts` pixels. The centres of the outermost pixels lie on the degree's edges.
inline RasterFields degree_raster(int south_deg, int west_deg, int posts) {
  const double step = 1.0 / (posts - 1);
  return {posts, posts, {west_deg - step / 2, step, 0, south_deg + 1 + step / 2, 0, -step}};
}

// Writes a raster. `height`: pixel value as a function of the row, counted from the north, and the column.
inline void write_raster(const std::filesystem::path& path, const RasterFields& fields,
                         const std::function<double(int, int)>& height) {
  GDALAllRegister();
  std::filesystem::create_directories(path.parent_path());
  const GDALDriverH memory = GDALGetDriverByName("MEM");
  const GDALDatasetH dataset = GDALCreate(memory, "", fields.columns, fields.rows, fields.bands, fields.type, nullptr);
  std::array<double, 6> geotransform = fields.geotransform;
  GDALSetGeoTransform(dataset, geotransform.data());
  if (fields.epsg != 0 || fields.system != nullptr) {
    const OGRSpatialReferenceH reference = OSRNewSpatialReference(nullptr);
    if (fields.system != nullptr)
      OSRSetFromUserInput(reference, fields.system);
    else
      OSRImportFromEPSG(reference, fields.epsg);
    OSRSetAxisMappingStrategy(reference, OAMS_TRADITIONAL_GIS_ORDER);
    GDALSetSpatialRef(dataset, reference);
    OSRDestroySpatialReference(reference);
  }
  const GDALRasterBandH band = GDALGetRasterBand(dataset, 1);
  if (fields.void_value) GDALSetRasterNoDataValue(band, *fields.void_value);
  if (fields.unit != nullptr) GDALSetRasterUnitType(band, fields.unit);
  if (fields.scale != 1.0) GDALSetRasterScale(band, fields.scale);
  if (fields.offset != 0.0) GDALSetRasterOffset(band, fields.offset);
  std::vector<double> line(static_cast<std::size_t>(fields.columns));
  for (int row = 0; row < fields.rows; ++row) {
    for (int column = 0; column < fields.columns; ++column)
      line[static_cast<std::size_t>(column)] = height(row, column);
    if (GDALRasterIO(band, GF_Write, 0, row, fields.columns, 1, line.data(), fields.columns, 1, GDT_Float64, 0, 0) !=
        CE_None)
      std::abort();
  }
  std::vector<char*> options;
  char reversible[] = "REVERSIBLE=YES";
  char quality[] = "QUALITY=100";
  if (std::string_view(fields.driver) == "JP2OpenJPEG") options = {reversible, quality};
  options.push_back(nullptr);
  GDALDriverH driver = GDALGetDriverByName(fields.driver);
  if (driver == nullptr) std::abort();
  GDALDatasetH copy = GDALCreateCopy(driver, path.c_str(), dataset, 0, options.data(), nullptr, nullptr);
  if (copy == nullptr) std::abort();
  GDALClose(copy);
  GDALClose(dataset);
}

}  // namespace yars::test
