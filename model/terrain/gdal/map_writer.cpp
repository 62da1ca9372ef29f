#include "model/terrain/gdal/map_writer.hpp"

#include <array>
#include <atomic>
#include <cstdio>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <type_traits>

#include "lib/file/output_file.hpp"
#include "model/terrain/gdal/gdal_library.hpp"
#include "model/terrain/gdal/open_raster.hpp"

namespace yars::model::terrain::gdal {

namespace {

struct DestroySpatialReference {
  void operator()(OGRSpatialReferenceH reference) const { OSRDestroySpatialReference(reference); }
};
using SpatialReference = std::unique_ptr<std::remove_pointer_t<OGRSpatialReferenceH>, DestroySpatialReference>;

// File in GDAL's in-memory file system (/vsimem), deleted with the object. To write a map, GDAL thus opens no path
// on disk.
class MemoryFile {
 public:
  MemoryFile() {
    static std::atomic<int> count{0};
    name_ = "/vsimem/yars_map_" + std::to_string(++count) + ".tif";
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  ~MemoryFile() { VSIUnlink(name_.c_str()); }
  const std::string& name() const { return name_; }
  std::span<const std::byte> bytes() const {
    vsi_l_offset size = 0;
    const GByte* first = VSIGetMemFileBuffer(name_.c_str(), &size, FALSE);
    return std::as_bytes(std::span(first, first == nullptr ? 0 : static_cast<std::size_t>(size)));
  }

 private:
  std::string name_;
};

// Azimuthal equidistant projection on WGS84 about the given point: x east, y north [m]. Null on a GDAL error.
SpatialReference local_projection(double latitude_deg, double longitude_deg) {
  SpatialReference projection(OSRNewSpatialReference(nullptr));
  std::array<char, 160> text{};
  std::snprintf(text.data(), text.size(),
                "+proj=aeqd +lat_0=%.12f +lon_0=%.12f +x_0=0 +y_0=0 +datum=WGS84 +units=m +no_defs", latitude_deg,
                longitude_deg);
  if (OSRImportFromProj4(projection.get(), text.data()) != OGRERR_NONE) projection.reset();
  return projection;
}

// Writes projection, geotransform, band description and pixels. Returns false at the first error, about which GDAL
// sends a message.
bool write_dataset(GDALDatasetH dataset, const MapPicture& picture) {
  const SpatialReference projection = local_projection(picture.origin_latitude_deg, picture.origin_longitude_deg);
  std::array<double, 6> geotransform = picture.plane_from_pixel;
  if (!projection || GDALSetSpatialRef(dataset, projection.get()) != CE_None ||
      GDALSetGeoTransform(dataset, geotransform.data()) != CE_None)
    return false;
  GDALRasterBandH const band = GDALGetRasterBand(dataset, 1);
  GDALSetDescription(band, picture.description.c_str());
  const auto write = [&](const auto& pixels, GDALDataType type) {
    auto* const values = const_cast<void*>(static_cast<const void*>(pixels.data()));  // not changed by GF_Write
    return GDALRasterIO(band, GF_Write, 0, 0, picture.columns, picture.rows, values, picture.columns, picture.rows,
                        type, 0, 0) == CE_None;
  };
  if (const auto* bytes = std::get_if<std::vector<std::uint8_t>>(&picture.pixels)) return write(*bytes, GDT_Byte);
  if (GDALSetRasterNoDataValue(band, std::numeric_limits<double>::quiet_NaN()) != CE_None) return false;
  return write(std::get<std::vector<float>>(picture.pixels), GDT_Float32);
}

}  // namespace

error::Expected<void> write_map(const std::filesystem::path& path, const MapPicture& picture) {
  if (const auto loaded = load_gdal(path.string()); !loaded) return tl::unexpected(loaded.error());
  const MessageCapture messages;
  GDALDriverH const driver = GDALGetDriverByName("GTiff");
  const bool bytes = std::holds_alternative<std::vector<std::uint8_t>>(picture.pixels);
  const MemoryFile memory;
  std::array<const char*, 2> creation{"COMPRESS=DEFLATE", nullptr};
  Dataset dataset(driver != nullptr ? GDALCreate(driver, memory.name().c_str(), picture.columns, picture.rows, 1,
                                                 bytes ? GDT_Byte : GDT_Float32, const_cast<char**>(creation.data()))
                                    : nullptr);
  const bool filled = dataset != nullptr && write_dataset(dataset.get(), picture);
  dataset.reset();  // GDALClose() flushes the pixels to memory
  if (filled && messages.first_or("").empty()) return file::write_file(path, memory.bytes());
  return error::fail(path.string(), "a GeoTIFF that can be made", messages.first_or("a failure of GDAL"));
}

}  // namespace yars::model::terrain::gdal
