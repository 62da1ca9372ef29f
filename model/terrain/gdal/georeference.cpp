#include "model/terrain/gdal/georeference.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>
#include <type_traits>
#include <utility>

#include "model/terrain/gdal/coordinate_operations.hpp"

namespace yars::model::terrain::gdal {

namespace {

constexpr double kNoPosition = std::numeric_limits<double>::quiet_NaN();
constexpr const char* kWarpIt = "warp it with gdalwarp -t_srs EPSG:4326";

std::string well_known_text(OGRSpatialReferenceH reference) {
  char* text = nullptr;
  const std::array<const char*, 2> options{"FORMAT=WKT2_2019", nullptr};
  const bool made = OSRExportToWktEx(reference, &text, options.data()) == OGRERR_NONE && text != nullptr;
  std::string wkt = made ? text : "";
  CPLFree(text);
  return wkt;
}

struct DestroyReference {
  void operator()(OGRSpatialReferenceH reference) const { OSRDestroySpatialReference(reference); }
};
using Reference = std::unique_ptr<std::remove_pointer_t<OGRSpatialReferenceH>, DestroyReference>;

// The coordinate system `system` after OSRDemoteTo2D() (without heights) or OSRPromoteTo3D() (with ellipsoidal
// heights). Null on failure.
using Change = OGRErr (*)(OGRSpatialReferenceH, const char*);
Projection changed(PJ_CONTEXT* context, PJ* system, Change change) {
  const char* const text = proj_as_wkt(context, system, PJ_WKT2_2019, nullptr);
  const Reference reference(OSRNewSpatialReference(text));
  if (text == nullptr || change(reference.get(), nullptr) != OGRERR_NONE) return nullptr;
  return Projection(proj_create(context, well_known_text(reference.get()).c_str()));
}

std::string name_of(PJ* object) {
  const char* name = proj_get_name(object);
  return name == nullptr ? "without a name" : name;
}

bool names_ellipsoid(std::string name) {
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return name.find("ellipsoid") != std::string::npos;
}

struct Axis {
  std::string direction;
  double unit = 1.0;  // size of the axis's unit [m] or [rad]
};

struct Axes {
  int count = 0;
  bool angles = false;  // true: coordinates are latitude and longitude
  std::array<Axis, 3> axes;
};

Axes axes_of(PJ_CONTEXT* context, PJ* system) {
  Axes axes;
  // A bound system has additional parameters of a transformation to WGS84. Its axes are those of its source system.
  const Projection inside(proj_get_type(system) == PJ_TYPE_BOUND_CRS ? proj_get_source_crs(context, system) : nullptr);
  const Projection coordinates(proj_crs_get_coordinate_system(context, inside ? inside.get() : system));
  if (!coordinates) return axes;
  axes.angles = proj_cs_get_type(context, coordinates.get()) == PJ_CS_TYPE_ELLIPSOIDAL;
  axes.count = std::clamp(proj_cs_get_axis_count(context, coordinates.get()), 0, 3);
  for (int axis = 0; axis < axes.count; ++axis) {
    const char* direction = nullptr;
    double unit = 1.0;
    proj_cs_get_axis_info(context, coordinates.get(), axis, nullptr, nullptr, &direction, &unit, nullptr, nullptr,
                          nullptr);
    axes.axes[static_cast<std::size_t>(axis)] = {direction == nullptr ? "" : direction, unit};
  }
  return axes;
}

}  // namespace

error::Expected<Georeference> Georeference::of(GDALDatasetH dataset, const std::string& subject) {
  Georeference georeference;
  const OGRSpatialReferenceH reference = GDALGetSpatialRef(dataset);
  if (GDALGetGeoTransform(dataset, georeference.data_from_pixel_.data()) != CE_None || reference == nullptr)
    return error::fail(subject, "a coordinate system and a geotransform", "none",
                       "add them with gdal_translate -a_srs -a_ullr");
  if (GDALInvGeoTransform(georeference.data_from_pixel_.data(), georeference.pixel_from_data_.data()) == 0)
    return error::fail(subject, "an invertible geotransform", "a singular one", kWarpIt);
  georeference.width_ = GDALGetRasterXSize(dataset);
  georeference.height_ = GDALGetRasterYSize(dataset);
  int count = 0;
  const int* const mapping = OSRGetDataAxisToSRSAxisMapping(reference, &count);
  if (mapping != nullptr && count >= 2 && std::abs(mapping[0]) + std::abs(mapping[1]) == 3)
    georeference.axis_ = {mapping[0], mapping[1]};

  // A raster is opened for each of its cells, and PROJ takes most of that time. So each thread keeps its last result,
  // but none that reads a grid file: the file's position would be common to all children of fork().
  struct Last {
    std::tuple<std::string, std::array<double, 6>, std::array<int, 2>, int, int> key;
    Georeference georeference;
  };
  thread_local std::optional<Last> last;
  auto key = std::tuple(well_known_text(reference), georeference.data_from_pixel_, georeference.axis_,
                        georeference.width_, georeference.height_);
  if (last && last->key == key) return last->georeference;
  georeference.context_ = ProjContext(proj_context_create());
  proj_context_set_enable_network(georeference.context_.get(), 0);
  proj_log_func(georeference.context_.get(), nullptr, [](void*, int, const char*) {});
  if (const auto read = georeference.read_system(std::get<0>(key), subject); !read) return tl::unexpected(read.error());
  const bool has_grid = georeference.geoid_ ||
                        (georeference.to_wgs84_ && proj_coordoperation_get_grid_used_count(
                                                       georeference.context_.get(), georeference.to_wgs84_.get()) > 0);
  if (!has_grid) last = Last{std::move(key), georeference};
  return georeference;
}

error::Expected<void> Georeference::read_system(const std::string& wkt, const std::string& subject) {
  PJ_CONTEXT* const context = context_.get();
  const Projection whole(proj_create(context, wkt.c_str()));
  if (!whole) return error::fail(subject, "a coordinate system that PROJ knows", "an unknown one", kWarpIt);
  Projection horizontal, vertical;
  if (proj_get_type(whole.get()) == PJ_TYPE_COMPOUND_CRS) {
    horizontal.reset(proj_crs_get_sub_crs(context, whole.get(), 0));
    vertical.reset(proj_crs_get_sub_crs(context, whole.get(), 1));
  } else {
    horizontal = changed(context, whole.get(), OSRDemoteTo2D);
  }
  if (!horizontal) return error::fail(subject, "a coordinate system on the earth", name_of(whole.get()), kWarpIt);
  if (auto found = find_operation(horizontal.get(), subject); !found) return found;
  find_period(horizontal.get());
  const Axes axes = axes_of(context, whole.get());
  if (!vertical && axes.count == 3) {
    metres_per_unit_ = axes.axes[2].unit;
    return find_geoid(horizontal.get(), subject);
  }
  return vertical ? read_vertical(vertical.get(), horizontal.get(), subject) : error::Expected<void>{};
}

error::Expected<void> Georeference::read_vertical(PJ* vertical, PJ* horizontal, const std::string& subject) {
  const Axes axes = axes_of(context_.get(), vertical);
  if (axes.count > 0) {
    metres_per_unit_ = axes.axes[0].unit;
    points_down_ = axes.axes[0].direction == "down";
  }
  return names_ellipsoid(name_of(vertical)) ? find_geoid(horizontal, subject) : error::Expected<void>{};
}

error::Expected<void> Georeference::find_geoid(PJ* horizontal, const std::string& subject) {
  const Projection spatial = changed(context_.get(), horizontal, OSRPromoteTo3D);
  const Projection above_sea(proj_create(context_.get(), "EPSG:4326+5773"));
  ChosenOperation found = spatial && above_sea ? operation_between(context_.get(), spatial.get(), above_sea.get(),
                                                                   sample_pixels(), Operations::exact_only)
                                               : ChosenOperation{};
  if (!found.operation)
    return error::fail(subject, "heights above mean sea level",
                       "heights above the ellipsoid, and PROJ has no geoid (EGM96)",
                       "install proj-data, or convert them to heights above mean sea level with gdalwarp -t_srs "
                       "EPSG:4326+5773");
  geoid_ = std::move(found.operation);
  if (!found.warning.empty()) notes_.push_back("heights of " + name_of(horizontal) + ": " + found.warning);
  notes_.push_back("heights above the ellipsoid are converted to heights above mean sea level by the geoid EGM96, " +
                   accuracy_text(context_.get(), geoid_.get()));
  return {};
}

// Sample points over the whole raster, in the axis order and the units of the raster's system.
SamplePoints Georeference::sample_pixels() const {
  constexpr int kSteps = 8;
  SamplePoints points;
  for (int down = 0; down <= kSteps; ++down)
    for (int right = 0; right <= kSteps; ++right) {
      points.x.push_back(0.5 + (width_ - 1.0) * right / kSteps);
      points.y.push_back(0.5 + (height_ - 1.0) * down / kSteps);
    }
  to_system(points.x, points.y);
  if (longitude_first_) std::swap(points.x, points.y);
  return points;
}

error::Expected<void> Georeference::find_operation(PJ* horizontal, const std::string& subject) {
  PJ_CONTEXT* const context = context_.get();
  const Projection wgs84(proj_create(context, "EPSG:4326"));
  if (proj_is_equivalent_to_with_ctx(context, horizontal, wgs84.get(), PJ_COMP_EQUIVALENT_EXCEPT_AXIS_ORDER_GEOGCRS) !=
      0) {
    treat_as_wgs84(axes_of(context, horizontal).axes[0].direction == "east");
    return {};
  }
  ChosenOperation found = operation_between(context, horizontal, wgs84.get(), sample_pixels(), Operations::all);
  if (!found.operation)
    return error::fail(subject, "a raster that lies on the earth",
                       "coordinates of " + name_of(horizontal) + " that PROJ cannot convert to WGS84", kWarpIt);
  to_wgs84_ = std::move(found.operation);
  if (!found.warning.empty()) notes_.push_back(name_of(horizontal) + ": " + found.warning);
  return {};
}

// Treats the degrees of the system as degrees of WGS84, without PROJ. to_system() then gives the latitude first.
void Georeference::treat_as_wgs84(bool longitude_first) {
  to_wgs84_.reset();
  longitude_first_ = longitude_first;
  if (longitude_first) axis_ = {3 - std::abs(axis_[0]), 3 - std::abs(axis_[1])};
}

// Sets middle_x_, and period_ for a raster in degrees, grads or another angle. In a raster in degrees, also measures
// how far the change of datum to WGS84 moves four test pixels. If all move less than kNoPixels, treats the system as
// WGS84.
void Georeference::find_period(PJ* horizontal) {
  middle_x_ = data_from_pixel_[0] + data_from_pixel_[1] * width_ / 2.0 + data_from_pixel_[2] * height_ / 2.0;
  if (!to_wgs84_) {
    period_ = 360.0;
    return;
  }
  const Axes axes = axes_of(context_.get(), horizontal);
  if (!axes.angles || !(axes.axes[0].unit > 0.0)) return;
  period_ = 2.0 * std::numbers::pi / axes.axes[0].unit;
  constexpr double kNoPixels = 1e-3;  // [pixels] a smaller shift makes no difference
  std::vector<double> across{0.5, width_ - 0.5, width_ - 0.5, width_ / 2.0};
  std::vector<double> along{0.5, 0.5, height_ - 0.5, height_ / 2.0};
  const std::vector<double> pixels_across = across, pixels_along = along;
  if (std::abs(period_ - 360.0) > 1e-9) return;
  to_earth(across, along);
  double farthest = 0.0;
  for (std::size_t i = 0; i < across.size(); ++i) {
    const double x = across[i] + 360.0 * std::round((middle_x_ - across[i]) / 360.0);
    const double column = pixel_from_data_[0] + pixel_from_data_[1] * x + pixel_from_data_[2] * along[i];
    const double row = pixel_from_data_[3] + pixel_from_data_[4] * x + pixel_from_data_[5] * along[i];
    farthest = std::max(
        farthest, std::isfinite(column + row) ? std::hypot(column - pixels_across[i], row - pixels_along[i]) : 1.0);
  }
  if (farthest < kNoPixels) treat_as_wgs84(axes.axes[0].direction == "east");
}

// Converts pixel positions to coordinates of the system, in the axis order of the system.
void Georeference::to_system(std::span<double> x, std::span<double> y) const {
  for (std::size_t i = 0; i < x.size(); ++i) {
    const std::array<double, 2> data{data_from_pixel_[0] + data_from_pixel_[1] * x[i] + data_from_pixel_[2] * y[i],
                                     data_from_pixel_[3] + data_from_pixel_[4] * x[i] + data_from_pixel_[5] * y[i]};
    for (std::size_t axis = 0; axis < 2; ++axis)
      (std::abs(axis_[axis]) == 1 ? x : y)[i] = axis_[axis] < 0 ? -data[axis] : data[axis];
  }
}

double Georeference::near_middle(double x) const {
  return period_ > 0.0 ? x + period_ * std::round((middle_x_ - x) / period_) : x;
}

// Converts coordinates of the system to pixel positions. If the coordinates are angles, the longitude is first shifted
// to within half a turn of `near_x`.
void Georeference::from_system(std::span<double> x, std::span<double> y, double near_x) const {
  for (std::size_t i = 0; i < x.size(); ++i) {
    std::array<double, 2> data{};
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const double value = std::abs(axis_[axis]) == 1 ? x[i] : y[i];
      data[axis] = axis_[axis] < 0 ? -value : value;
    }
    if (period_ > 0.0) data[0] += period_ * std::round((near_x - data[0]) / period_);
    x[i] = pixel_from_data_[0] + pixel_from_data_[1] * data[0] + pixel_from_data_[2] * data[1];
    y[i] = pixel_from_data_[3] + pixel_from_data_[4] * data[0] + pixel_from_data_[5] * data[1];
    if (!std::isfinite(x[i]) || !std::isfinite(y[i])) x[i] = y[i] = kNoPosition;
  }
}

void Georeference::to_earth(std::span<double> across, std::span<double> along) const {
  to_system(across, along);
  // WGS84 in PROJ has the latitude first.
  if (to_wgs84_) transform(to_wgs84_.get(), PJ_FWD, across, along, nullptr);
  for (std::size_t i = 0; i < across.size(); ++i) {
    std::swap(across[i], along[i]);
    if (!(std::abs(along[i]) <= 90.5) || !(std::abs(across[i]) <= 1080.0)) across[i] = along[i] = kNoPosition;
  }
}

void Georeference::to_pixels(std::span<double> across, std::span<double> along, EarthPosition reference) const {
  std::array<double, 2> first{reference.latitude_deg, reference.longitude_deg};
  const std::span<double> latitude(&first[0], 1);
  const std::span<double> longitude(&first[1], 1);
  for (std::size_t i = 0; i < across.size(); ++i) std::swap(across[i], along[i]);
  if (to_wgs84_) {
    transform(to_wgs84_.get(), PJ_INV, latitude, longitude, nullptr);
    transform(to_wgs84_.get(), PJ_INV, across, along, nullptr);
  }
  const double reference_x = (axis_[0] < 0 ? -1.0 : 1.0) * first[static_cast<std::size_t>(std::abs(axis_[0]) - 1)];
  from_system(across, along, near_middle(reference_x));
}

std::vector<double> Georeference::above_sea_level_m(std::span<const double> longitudes_deg,
                                                    std::span<const double> latitudes_deg) const {
  std::vector<double> first(latitudes_deg.begin(), latitudes_deg.end());
  std::vector<double> second(longitudes_deg.begin(), longitudes_deg.end());
  std::vector<double> height_m(first.size(), 0.0);
  // Transforms the positions to the raster's system, from which the geoid operation starts. At an ellipsoidal height of
  // 0, the resulting height is the correction.
  if (to_wgs84_) transform(to_wgs84_.get(), PJ_INV, first, second, nullptr);
  if (longitude_first_) std::swap(first, second);
  transform(geoid_.get(), PJ_FWD, first, second, height_m.data());
  for (double& height : height_m)
    if (!std::isfinite(height)) height = kNoPosition;
  return height_m;
}

PostLattice::PostLattice(const Georeference& georeference, const Grid& grid, const PostBox& box)
    : rows_((box.intervals_north + kStep - 1) / kStep + 1),
      columns_((box.intervals_east + kStep - 1) / kStep + 1),
      intervals_north_(box.intervals_north),
      intervals_east_(box.intervals_east) {
  for (int row = 0; row < rows_; ++row)
    for (int column = 0; column < columns_; ++column) {
      const int post_row = box.first_row + std::min(row * kStep, intervals_north_);
      const int post_column = box.first_column + std::min(column * kStep, intervals_east_);
      column_.push_back(grid.west_deg + static_cast<double>(post_column) / (grid.columns - 1));
      row_.push_back(grid.south_deg + static_cast<double>(post_row) / (grid.rows - 1));
    }
  if (georeference.heights_are_ellipsoidal()) above_m_ = georeference.above_sea_level_m(column_, row_);
  // Until here column_ and row_ are longitudes and latitudes [deg].
  georeference.to_pixels(column_, row_, {grid.west_deg + 0.5, grid.south_deg + 0.5});
}

PostLattice::Node PostLattice::node_at(int row, int column) const {
  const auto locate = [](int post, int nodes, int intervals) {
    const int node = std::clamp(post / kStep, 0, std::max(0, nodes - 2));
    const int length = std::max(1, std::min(kStep, intervals - node * kStep));
    return std::pair(node, length);
  };
  const auto [north, north_posts] = locate(row, rows_, intervals_north_);
  const auto [east, east_posts] = locate(column, columns_, intervals_east_);
  return {static_cast<std::size_t>(north) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(east),
          static_cast<double>(row - north * kStep) / north_posts,
          static_cast<double>(column - east * kStep) / east_posts, static_cast<double>(north_posts),
          static_cast<double>(east_posts)};
}

double PostLattice::between(const std::vector<double>& values, const Node& node) const {
  const std::size_t up = rows_ > 1 ? static_cast<std::size_t>(columns_) : 0;
  const std::size_t right = columns_ > 1 ? 1 : 0;
  const double* const at = &values[node.south_west];
  const double south = at[0] + node.east * (at[right] - at[0]);
  const double north = at[up] + node.east * (at[up + right] - at[up]);
  return south + node.north * (north - south);
}

PixelPosition PostLattice::position(int row, int column) const {
  const Node node = node_at(row, column);
  return {between(column_, node), between(row_, node)};
}

PixelStep PostLattice::step(int row, int column) const {
  const Node node = node_at(row, column);
  const std::size_t up = rows_ > 1 ? static_cast<std::size_t>(columns_) : 0;
  const std::size_t right = columns_ > 1 ? 1 : 0;
  const std::size_t at = node.south_west;
  return {(column_[at + up] - column_[at]) / node.north_posts, (row_[at + up] - row_[at]) / node.north_posts,
          (column_[at + right] - column_[at]) / node.east_posts, (row_[at + right] - row_[at]) / node.east_posts};
}

double PostLattice::above_sea_level_m(int row, int column) const {
  return above_m_.empty() ? 0.0 : between(above_m_, node_at(row, column));
}

std::optional<PixelCorners> PostLattice::corners() const {
  const PixelCorners corners{position(0, 0), position(0, intervals_east_), position(intervals_north_, intervals_east_),
                             position(intervals_north_, 0)};
  for (const PixelPosition& corner : corners)
    if (!std::isfinite(corner.column + corner.row)) return std::nullopt;
  return corners;
}

std::optional<PixelBounds> PostLattice::bounds() const {
  std::optional<PixelBounds> bounds;
  for (std::size_t i = 0; i < column_.size(); ++i) {
    if (std::isnan(column_[i])) continue;
    if (!bounds) bounds = PixelBounds{column_[i], column_[i], row_[i], row_[i]};
    bounds->left = std::min(bounds->left, column_[i]);
    bounds->right = std::max(bounds->right, column_[i]);
    bounds->top = std::min(bounds->top, row_[i]);
    bounds->bottom = std::max(bounds->bottom, row_[i]);
  }
  return bounds;
}

}  // namespace yars::model::terrain::gdal
