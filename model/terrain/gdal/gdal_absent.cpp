#include "model/terrain/gdal/land_cover.hpp"
#include "model/terrain/gdal/map_writer.hpp"
#include "model/terrain/gdal/raster.hpp"
#include "model/terrain/gdal/raster_survey.hpp"

namespace yars::model::terrain::gdal {

// Replaces the other sources of this folder in a build without GDAL.

namespace {

tl::unexpected<error::Error> built_without(const std::filesystem::path& path) {
  return error::fail(path.string(), "a YARS built with GDAL to read this raster", "one built without it",
                     "run `scripts/setup --gdal` and build again");
}

}  // namespace

bool available() {
  return false;
}

error::Expected<RasterSummary> describe_raster(const std::filesystem::path& path) {
  return built_without(path);
}

error::Expected<RasterPosts> read_raster(const std::vector<std::filesystem::path>& rasters, int /*south_deg*/,
                                         int /*west_deg*/, int /*posts_per_degree_north*/,
                                         int /*posts_per_degree_east*/) {
  return built_without(rasters.front());
}

error::Expected<std::optional<RasterStatistics>> survey_raster(const std::filesystem::path& path,
                                                               const std::function<void(double)>& /*progress*/) {
  return built_without(path);
}

error::Expected<CoverSummary> describe_cover(const std::filesystem::path& path) {
  return built_without(path);
}

error::Expected<CoverPosts> read_cover(const std::vector<std::filesystem::path>& rasters,
                                       const std::vector<PixelClass>& /*legend*/, int /*south_deg*/, int /*west_deg*/,
                                       int /*posts_per_degree_north*/, int /*posts_per_degree_east*/) {
  return built_without(rasters.front());
}

error::Expected<void> write_map(const std::filesystem::path& path, const MapPicture& /*picture*/) {
  return error::fail(path.string(), "a YARS built with GDAL to write a GeoTIFF", "one built without it",
                     "run `scripts/setup --gdal` and build again, or write a .png");
}

}  // namespace yars::model::terrain::gdal
