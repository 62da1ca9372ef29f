#include "model/terrain/gdal/open_raster.hpp"

#include <cpl_conv.h>
#include <cpl_error.h>
#include <ogr_srs_api.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <system_error>
#include <vector>

namespace yars::model::terrain::gdal {

namespace {

// Drivers of plain local files. No VRT and nothing that follows names or addresses in a file.
constexpr std::array<const char*, 12> kDrivers = {"GTiff",   "JP2OpenJPEG",    "HFA", "AAIGrid", "EHdr",    "ENVI",
                                                  "USGSDEM", "GRASSASCIIGrid", "BT",  "DTED",    "SRTMHGT", nullptr};

struct DestroyTransform {
  void operator()(OGRCoordinateTransformationH transform) const { OCTDestroyCoordinateTransformation(transform); }
};
using Transform = std::unique_ptr<std::remove_pointer_t<OGRCoordinateTransformationH>, DestroyTransform>;
struct DestroyReference {
  void operator()(OGRSpatialReferenceH reference) const { OSRDestroySpatialReference(reference); }
};
using Reference = std::unique_ptr<std::remove_pointer_t<OGRSpatialReferenceH>, DestroyReference>;

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

// Longitude and latitude of a place in the raster.
class Locator {
 public:
  Locator(GDALDatasetH dataset, const std::array<double, 6>& geotransform) : geotransform_(geotransform) {
    const OGRSpatialReferenceH own = GDALGetSpatialRef(dataset);
    geographic_ = own != nullptr && OSRIsGeographic(own) != 0;
    if (own == nullptr || geographic_) return;
    const Reference from(OSRClone(own));
    const Reference to(OSRNewSpatialReference(nullptr));
    OSRImportFromEPSG(to.get(), 4326);
    OSRSetAxisMappingStrategy(from.get(), OAMS_TRADITIONAL_GIS_ORDER);
    OSRSetAxisMappingStrategy(to.get(), OAMS_TRADITIONAL_GIS_ORDER);
    transform_.reset(OCTNewCoordinateTransformation(from.get(), to.get()));
  }
  bool geographic() const { return geographic_; }
  bool works() const { return geographic_ || transform_ != nullptr; }

  struct Place {
    double longitude_deg, latitude_deg;
  };
  std::optional<Place> operator()(double column, double row) const {
    double x = geotransform_[0] + column * geotransform_[1] + row * geotransform_[2];
    double y = geotransform_[3] + column * geotransform_[4] + row * geotransform_[5];
    if (transform_ && OCTTransform(transform_.get(), 1, &x, &y, nullptr) == 0) return std::nullopt;
    if (!std::isfinite(x) || !std::isfinite(y) || std::abs(y) > 90.5 || std::abs(x) > 1080.0) return std::nullopt;
    return Place{x, y};
  }

 private:
  std::array<double, 6> geotransform_;
  bool geographic_ = false;
  Transform transform_;
};

double beside(double longitude_deg, double other_deg) {
  return longitude_deg - 360.0 * std::round((longitude_deg - other_deg) / 360.0);
}

// Widens the extent over a net of pixel middles, the rim among them. False where one of them is nowhere on earth.
bool widen(Extent& extent, const Locator& locate, int columns, int rows) {
  constexpr int kSteps = 32;
  const auto middle = locate(columns / 2.0, rows / 2.0);
  if (!middle) return false;
  extent = {90.0, -90.0, middle->longitude_deg, middle->longitude_deg, 0.0, 0.0};
  for (int down = 0; down <= kSteps; ++down)
    for (int right = 0; right <= kSteps; ++right) {
      const auto place = locate(0.5 + (columns - 1.0) * right / kSteps, 0.5 + (rows - 1.0) * down / kSteps);
      if (!place) return false;
      const double longitude_deg =
          locate.geographic() ? place->longitude_deg : beside(place->longitude_deg, middle->longitude_deg);
      extent.south_deg = std::min(extent.south_deg, place->latitude_deg);
      extent.north_deg = std::max(extent.north_deg, place->latitude_deg);
      extent.west_deg = std::min(extent.west_deg, longitude_deg);
      extent.east_deg = std::max(extent.east_deg, longitude_deg);
    }
  const auto right = locate(columns / 2.0 + 1, rows / 2.0);
  const auto below = locate(columns / 2.0, rows / 2.0 + 1);
  if (!right || !below) return false;
  extent.pixel_north_deg = std::max(std::abs(right->latitude_deg - middle->latitude_deg),
                                    std::abs(below->latitude_deg - middle->latitude_deg));
  extent.pixel_east_deg =
      std::max(std::abs(beside(right->longitude_deg, middle->longitude_deg) - middle->longitude_deg),
               std::abs(beside(below->longitude_deg, middle->longitude_deg) - middle->longitude_deg));
  return extent.pixel_north_deg > 0.0 && extent.pixel_east_deg > 0.0;
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
  raster.heights = GDALGetRasterBand(dataset, 1);
  std::array<double, 6> geotransform{};
  if (GDALGetGeoTransform(dataset, geotransform.data()) != CE_None || GDALGetSpatialRef(dataset) == nullptr)
    return failure::fail(subject, "a coordinate system and a geotransform", "none",
                         "give it one with gdal_translate -a_srs -a_ullr");
  const Locator locate(dataset, geotransform);
  raster.geographic = locate.geographic();
  if (!locate.works() || !widen(raster.extent, locate, GDALGetRasterXSize(dataset), GDALGetRasterYSize(dataset)) ||
      (!raster.geographic && raster.extent.east_deg - raster.extent.west_deg > 180.0))
    return failure::fail(subject, "a raster that lies on the earth, over less than half of it when projected",
                         messages.first_or("one whose place cannot be told"), "warp it with gdalwarp -t_srs EPSG:4326");
  return raster;
}

}  // namespace yars::model::terrain::gdal
