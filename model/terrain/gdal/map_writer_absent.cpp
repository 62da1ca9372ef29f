// In place of map_writer.cpp in a build without GDAL.
#include "model/terrain/gdal/map_writer.hpp"

namespace yars::model::terrain::gdal {

failure::Expected<void> write_map(const std::filesystem::path& path, const MapPicture& /*picture*/) {
  return failure::fail(path.string(), "a YARS built with GDAL to write a GeoTIFF", "one built without it",
                       "run `scripts/setup --gdal` and build again, or write a .png");
}

}  // namespace yars::model::terrain::gdal
