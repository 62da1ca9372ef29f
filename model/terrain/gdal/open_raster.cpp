#include "model/terrain/gdal/open_raster.hpp"

#include <cpl_conv.h>
#include <cpl_error.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <system_error>
#include <utility>

namespace yars::model::terrain::gdal {

namespace {

// Drivers of plain local files. No VRT and nothing that follows names or addresses in a file.
constexpr std::array<const char*, 12> kDrivers = {"GTiff",   "JP2OpenJPEG",    "HFA", "AAIGrid", "EHdr",    "ENVI",
                                                  "USGSDEM", "GRASSASCIIGrid", "BT",  "DTED",    "SRTMHGT", nullptr};

void register_once() {
  static const bool done = [] {
    CPLSetConfigOption("GDAL_PAM_ENABLED", "NO");  // no .aux.xml beside the user's files
    GDALAllRegister();
    return true;
  }();
  (void)done;
}

bool holds_heights(GDALDatasetH dataset) {
  if (GDALGetRasterCount(dataset) != 1) return false;
  switch (GDALGetRasterDataType(GDALGetRasterBand(dataset, 1))) {
    case GDT_Int16:
    case GDT_UInt16:
    case GDT_Int32:
    case GDT_UInt32:
    case GDT_Float32:
    case GDT_Float64:
      return true;
    default:
      return false;
  }
}

std::string bands_of(GDALDatasetH dataset) {
  const int count = GDALGetRasterCount(dataset);
  if (count == 0) return "no band";
  const GDALDataType type = GDALGetRasterDataType(GDALGetRasterBand(dataset, 1));
  return std::to_string(count) + " of " + GDALGetDataTypeName(type);
}

// Metres of one unit of the band; the coordinate system's where the band does not say.
double metres_of(GDALRasterBandH band, double by_system) {
  constexpr double kFoot = 0.3048;
  constexpr double kSurveyFoot = 1200.0 / 3937.0;
  const std::string_view unit = GDALGetRasterUnitType(band);
  if (unit == "ft" || unit == "foot" || unit == "feet") return kFoot;
  if (unit == "US survey foot" || unit == "ftUS" || unit == "us-ft") return kSurveyFoot;
  return unit.empty() && by_system > 0.0 ? by_system : 1.0;
}

bool is_whole(GDALDataType type) {
  return type == GDT_Int16 || type == GDT_UInt16 || type == GDT_Int32 || type == GDT_UInt32;
}

void describe_numbers(Raster& raster) {
  const Georeference& place = raster.georeference;
  const double metres = metres_of(raster.heights, place.metres_of_a_unit()) * (place.points_down() ? -1.0 : 1.0);
  raster.scale = GDALGetRasterScale(raster.heights, nullptr) * metres;
  raster.offset_m = GDALGetRasterOffset(raster.heights, nullptr) * metres;
  int stated = 0;
  const double number = GDALGetRasterNoDataValue(raster.heights, &stated);
  if (stated != 0) raster.void_number = number;
  raster.masked = (GDALGetMaskFlags(raster.heights) & (GMF_ALL_VALID | GMF_NODATA)) == 0;
  raster.whole_metres = is_whole(GDALGetRasterDataType(raster.heights)) && std::abs(raster.scale) == 1.0 &&
                        raster.offset_m == std::round(raster.offset_m) && !place.heights_are_ellipsoidal();
}

void keep(CPLErr severity, CPLErrorNum /*number*/, const char* text) {
  auto* const first = static_cast<std::string*>(CPLGetErrorHandlerUserData());
  if (severity < CE_Failure || !first->empty()) return;
  *first = std::string("GDAL: ") + text;
  std::replace(first->begin(), first->end(), '\n', ' ');
}

}  // namespace

MessageKeeper::MessageKeeper() {
  register_once();
  CPLPushErrorHandlerEx(keep, &first_);
}
MessageKeeper::~MessageKeeper() {
  CPLPopErrorHandler();
}

failure::Expected<Raster> open_raster(const std::filesystem::path& path) {
  const std::string subject = path.string();
  std::error_code code;
  if (!std::filesystem::is_regular_file(path, code))
    return failure::fail(subject, "a raster of heights in a plain file", code ? code.message() : "not a plain file");
  const MessageKeeper messages;
  // An absolute path: GDAL takes no part of it for a driver's prefix or one of its virtual folders.
  Raster raster;
  raster.dataset.reset(GDALOpenEx(std::filesystem::absolute(path).c_str(),
                                  GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR, kDrivers.data(), nullptr,
                                  nullptr));
  GDALDatasetH const dataset = raster.dataset.get();
  if (dataset == nullptr)
    return failure::fail(subject, "a raster of heights in a plain file (GeoTIFF, JPEG 2000, Erdas Imagine, ...)",
                         messages.first_or("one that GDAL does not open"));
  if (!holds_heights(dataset))
    return failure::fail(subject, "one band of heights, 16 bits or more", bands_of(dataset), "this is a picture");
  raster.subject = subject;
  raster.heights = GDALGetRasterBand(dataset, 1);
  raster.columns = GDALGetRasterXSize(dataset);
  raster.rows = GDALGetRasterYSize(dataset);
  auto georeference = Georeference::of(dataset, subject);
  if (!georeference) return tl::unexpected(georeference.error());
  raster.georeference = std::move(*georeference);
  describe_numbers(raster);
  return raster;
}

}  // namespace yars::model::terrain::gdal
