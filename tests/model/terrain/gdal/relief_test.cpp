// Between posts, a cell made from a raster has the heights of the raster in its own projection. Bound: the rms height
// difference is at most a quarter of the rms rise of the raster's slopes over half a post spacing.
#include <gtest/gtest.h>
#include <ogr_srs_api.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <future>
#include <random>
#include <string>

#include "model/terrain/gdal/raster.hpp"
#include "model/terrain/sampling/cell_view.hpp"
#include "model/terrain/store/cell_files.hpp"
#include "tests/model/terrain/formats/dted_builder.hpp"
#include "tests/model/terrain/gdal/raster_builder.hpp"
#include "tests/model/terrain/shared_data.hpp"

namespace yars::model::terrain {
namespace {

using test::RasterFields;
using test::write_raster;

constexpr double kBound = 0.25;  // allowed rms difference / rms rise over half a post spacing

// The reference: heights of a raster on its own grid, at positions on WGS84.
class Truth {
 public:
  Truth(const RasterFields& fields, const char* system, std::vector<double> heights_m)
      : fields_(fields), heights_m_(std::move(heights_m)), from_earth_(test::transform_between("EPSG:4326", system)) {}

  struct Ground {
    double height_m, rise_m;  // rise: height difference over one pixel along the steepest slope
  };

  // Bilinear between pixel centres. NaN beyond the outermost pixel centres.
  Ground at(double latitude_deg, double longitude_deg) const {
    double x = longitude_deg;
    double y = latitude_deg;
    if (OCTTransform(from_earth_.get(), 1, &x, &y, nullptr) == 0) return {NAN, NAN};
    const double column = (x - fields_.geotransform[0]) / fields_.geotransform[1] - 0.5;
    const double row = (y - fields_.geotransform[3]) / fields_.geotransform[5] - 0.5;
    if (!(column >= 0 && row >= 0 && column < fields_.columns - 1 && row < fields_.rows - 1)) return {NAN, NAN};
    const int left = static_cast<int>(column);
    const int top = static_cast<int>(row);
    const double u = column - left;
    const double v = row - top;
    const double a = post(top, left), b = post(top, left + 1), c = post(top + 1, left), d = post(top + 1, left + 1);
    const double east_m = (b - a) * (1 - v) + (d - c) * v;
    const double south_m = (c - a) * (1 - u) + (d - b) * u;
    return {(a * (1 - u) + b * u) * (1 - v) + (c * (1 - u) + d * u) * v, std::hypot(east_m, south_m)};
  }

 private:
  double post(int row, int column) const {
    return heights_m_[static_cast<std::size_t>(row) * static_cast<std::size_t>(fields_.columns) +
                      static_cast<std::size_t>(column)];
  }
  RasterFields fields_;
  std::vector<double> heights_m_;
  test::Transform from_earth_;
};

// Mountains [m]: noise averaged over 3 x 3 pixels. On average, one pixel in a hundred is a summit 400 m higher.
std::vector<double> mountains(int columns, int rows, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<double> noise(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  for (double& height_m : noise) height_m = std::uniform_real_distribution(0.0, 3000.0)(random);
  std::vector<double> heights_m(noise.size());
  const auto at = [&](int row, int column) {
    return noise[static_cast<std::size_t>(std::clamp(row, 0, rows - 1)) * static_cast<std::size_t>(columns) +
                 static_cast<std::size_t>(std::clamp(column, 0, columns - 1))];
  };
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      double sum = 0.0;
      for (int down = -1; down <= 1; ++down)
        for (int right = -1; right <= 1; ++right) sum += at(row + down, column + right);
      heights_m[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column)] =
          static_cast<float>(sum / 9 + (random() % 100 == 0 ? 400.0 : 0.0));
    }
  return heights_m;
}

// Height differences between a cell and the reference.
struct Result {
  double rms_m = 0.0, slope_rms_m = 0.0, worst_m = 0.0;  // slope_rms_m: rms rise over half a post spacing
  int positions = 0;
};

// Compares at random positions in the cell. `spacing_pixels`: post spacing / pixel size.
Result compare(const Cell& cell, const Truth& truth, double spacing_pixels, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  Result result;
  for (int i = 0; i < 60'000; ++i) {
    // A tenth of the positions lie on the cell's edges.
    const double north_deg = i % 20 == 0 ? std::round(share(random)) : share(random);
    const double east_deg = i % 20 == 1 ? std::round(share(random)) : share(random);
    const Truth::Ground ground = truth.at(cell.corner().south_deg + north_deg, cell.corner().west_deg + east_deg);
    if (std::isnan(ground.height_m)) continue;
    const double height_m = interpolate(cell, north_deg, east_deg).elevation_m;
    EXPECT_FALSE(std::isnan(height_m)) << north_deg << ", " << east_deg;
    const double difference_m = height_m - ground.height_m;
    result.rms_m += difference_m * difference_m;
    result.slope_rms_m += std::pow(ground.rise_m * spacing_pixels / 2, 2);
    result.worst_m = std::max(result.worst_m, std::abs(difference_m));
    ++result.positions;
  }
  result.rms_m = std::sqrt(result.rms_m / result.positions);
  result.slope_rms_m = std::sqrt(result.slope_rms_m / result.positions);
  return result;
}

void print(const char* name, const Result& result) {
  std::printf("%s: rms %.2f m, worst %.1f m; rise over half a post spacing %.2f m: ratio %.3f, %d positions\n", name,
              result.rms_m, result.worst_m, result.slope_rms_m, result.rms_m / result.slope_rms_m, result.positions);
}

struct Projected {
  const char* name;
  const char* system;
  double west_m, north_m, pixel_m;
  int pixels;
  CellCorner corner;
};

class ProjectedRaster : public ::testing::TestWithParam<Projected> {
 protected:
  RasterFields fields() const {
    RasterFields fields{GetParam().pixels,
                        GetParam().pixels,
                        {GetParam().west_m, GetParam().pixel_m, 0, GetParam().north_m, 0, -GetParam().pixel_m}};
    fields.system = GetParam().system;
    fields.type = GDT_Float32;
    return fields;
  }
};

TEST_P(ProjectedRaster, KeepsItsReliefBetweenPosts) {
  const test::TemporaryFolder folder;
  const RasterFields raster = fields();
  const std::vector<double> heights_m = mountains(raster.columns, raster.rows, 16);
  write_raster(folder.path() / "a.tif", raster, [&](int row, int column) {
    return heights_m[static_cast<std::size_t>(row) * static_cast<std::size_t>(raster.columns) +
                     static_cast<std::size_t>(column)];
  });
  const auto index = index_directory(folder.path());
  ASSERT_TRUE(index.has_value()) << index.error().message();
  ASSERT_TRUE(index->contains(slot_of(GetParam().corner)));
  const auto reading = read_cell(index->at(slot_of(GetParam().corner)), GetParam().corner);
  ASSERT_TRUE(reading.has_value()) << reading.error().message();
  const Result result = compare(reading->cell, Truth(raster, GetParam().system, heights_m), 1.0, 4);
  print(GetParam().name, result);
  ASSERT_GT(result.positions, 500);
  EXPECT_LE(result.rms_m, kBound * result.slope_rms_m);
}

TEST_P(ProjectedRaster, SummitsKeepTheirHeight) {
  const test::TemporaryFolder folder;
  const RasterFields raster = fields();
  const auto height_m = [](int row, int column) { return row % 7 == 3 && column % 7 == 3 ? 2000.0 + row : 100.0; };
  write_raster(folder.path() / "a.tif", raster, height_m);
  const auto index = index_directory(folder.path());
  ASSERT_TRUE(index.has_value()) << index.error().message();
  std::size_t summits = 0;
  for (const auto& [slot, file] : *index) {
    const auto reading = read_cell(file, corner_of_slot(slot));
    ASSERT_TRUE(reading.has_value()) << reading.error().message();
    for (const std::int16_t post : reading->cell.posts())
      if (post != kVoidPost && post * reading->cell.unit_m() >= 2000.0) ++summits;
  }
  std::size_t expected = 0;
  for (int row = 3; row < raster.rows; row += 7)
    for (int column = 3; column < raster.columns; column += 7) ++expected;
  EXPECT_GE(summits, expected) << "each summit is a post, on the edge of two cells twice";
}

// UTM zones 11 and 60 north (EPSG:32611, 32660); polar stereographic, north (EPSG:3413) and south (EPSG:3031); Lambert
// azimuthal equal area, Europe (EPSG:3035).
INSTANTIATE_TEST_SUITE_P(
    Projections, ProjectedRaster,
    ::testing::Values(Projected{"Utm", "EPSG:32611", 225'000, 4'110'000, 232, 560, {36, -119}},
                      Projected{"UtmRim", "EPSG:32611", 260'000, 4'060'000, 232, 200, {36, -120}},
                      Projected{"PolarStereographic", "EPSG:3413", 100'000, -400'000, 500, 700, {84, -28}},
                      Projected{"RoundThePole", "EPSG:3413", -75'000, 75'000, 1000, 150, {89, 17}},
                      Projected{"SouthPole", "EPSG:3031", -75'000, 75'000, 1000, 150, {-90, -180}},
                      Projected{"Antimeridian", "EPSG:32660", 600'000, 7'300'000, 300, 500, {65, 179}},
                      Projected{"AzimuthalEqualArea", "EPSG:3035", 4'060'000, 2'900'000, 400, 350, {48, 8}}),
    [](const auto& each) { return std::string(each.param.name); });

// A thread keeps what PROJ has found for the raster that it opened last.
TEST(ProjectedRasters, HaveEqualHeightsWhateverTheirThreadHasReadBefore) {
  const test::TemporaryFolder folder;
  RasterFields first{100, 100, {260'000, 500, 0, 4'060'000, 0, -500}};
  first.system = "EPSG:32611";
  RasterFields moved = first, other_datum = first;
  moved.geotransform[0] += 200;
  other_datum.system = "EPSG:26711";
  std::vector<std::filesystem::path> paths;
  for (const RasterFields& fields : {first, moved, other_datum}) {
    paths.push_back(folder.path() / (std::to_string(paths.size()) + ".tif"));
    write_raster(paths.back(), fields, [](int row, int column) { return 100 + 7 * row + 3 * column; });
  }
  const auto posts_of = [](const std::filesystem::path& path) {
    const auto reading = read_cell({path, CellFormat::raster}, {36, -120});
    return reading ? reading->cell.posts() : std::vector<std::int16_t>{};
  };
  std::vector<std::vector<std::int16_t>> alone;
  for (const auto& path : paths) alone.push_back(std::async(std::launch::async, [&] { return posts_of(path); }).get());
  EXPECT_NE(alone[0], alone[1]);
  EXPECT_NE(alone[0], alone[2]);
  for (const std::size_t raster : {0, 1, 0, 2, 2, 0}) EXPECT_EQ(posts_of(paths[raster]), alone[raster]) << raster;
}

TEST(DegreeRaster, WithPixelCentresBesideThePostsKeepsItsRelief) {
  const test::TemporaryFolder folder;
  // As in rasters of the whole earth, pixel edges lie on whole degrees; pixel centres lie half a pixel inside.
  const RasterFields raster{240, 240, {19.5, 1.0 / 120, 0, 11.5, 0, -1.0 / 120}};
  const std::vector<double> heights_m = mountains(240, 240, 5);
  RasterFields whole = raster;
  whole.type = GDT_Float32;
  write_raster(folder.path() / "a.tif", whole,
               [&](int row, int column) { return heights_m[static_cast<std::size_t>(row * 240 + column)]; });
  const auto index = index_directory(folder.path());
  const auto reading = read_cell(index->at(slot_of({10, 20})), {10, 20});
  ASSERT_TRUE(reading.has_value());
  EXPECT_EQ(reading->cell.rows(), 241);
  const Result result = compare(reading->cell, Truth(raster, "EPSG:4326", heights_m), 1.0, 4);
  print("half a pixel off", result);
  EXPECT_LE(result.worst_m, 0.051) << "posts at pixel centres and half-way between: only rounding remains";
}

TEST(RealRasters, SanFranciscoKeepsItsReliefBetweenPosts) {
  YARS_NEEDS_SHARED_DATA();
  GDALAllRegister();
  const auto path = test::shared_data() / "geotiff/sanfrancisco_6m_epsg3857.tif";
  const GDALDatasetH dataset = GDALOpen(path.c_str(), GA_ReadOnly);
  ASSERT_NE(dataset, nullptr);
  RasterFields fields{GDALGetRasterXSize(dataset), GDALGetRasterYSize(dataset), {}};
  GDALGetGeoTransform(dataset, fields.geotransform.data());
  std::vector<double> heights_m(static_cast<std::size_t>(fields.columns) * static_cast<std::size_t>(fields.rows));
  ASSERT_EQ(GDALRasterIO(GDALGetRasterBand(dataset, 1), GF_Read, 0, 0, fields.columns, fields.rows, heights_m.data(),
                         fields.columns, fields.rows, GDT_Float64, 0, 0),
            CE_None);
  GDALClose(dataset);
  const auto index = index_file(path);
  ASSERT_TRUE(index.has_value()) << index.error().message();
  const auto reading = read_cell(index->begin()->second, {37, -123});
  ASSERT_TRUE(reading.has_value()) << reading.error().message();
  const Truth truth(fields, "EPSG:3857", heights_m);
  // The raster covers 0.07 % of the cell; positions outside the raster are skipped.
  std::mt19937_64 random(3);
  Result result;
  const Cell& cell = reading->cell;
  const double pixel_m = fields.geotransform[1] * std::cos(37.75 * 0.0174533);
  const double spacing_pixels = 111'000.0 / (cell.rows() - 1) / pixel_m;
  for (int i = 0; i < 2'000'000; ++i) {
    const double north_deg = std::uniform_real_distribution(0.0, 1.0)(random);
    const double east_deg = std::uniform_real_distribution(0.0, 1.0)(random);
    const Truth::Ground ground = truth.at(37 + north_deg, -123 + east_deg);
    if (std::isnan(ground.height_m) || ground.height_m < -100) continue;
    const double difference_m = interpolate(cell, north_deg, east_deg).elevation_m - ground.height_m;
    if (std::isnan(difference_m)) continue;
    result.rms_m += difference_m * difference_m;
    result.slope_rms_m += std::pow(ground.rise_m * spacing_pixels / 2, 2);
    result.worst_m = std::max(result.worst_m, std::abs(difference_m));
    ++result.positions;
  }
  ASSERT_GT(result.positions, 1000);
  result.rms_m = std::sqrt(result.rms_m / result.positions);
  result.slope_rms_m = std::sqrt(result.slope_rms_m / result.positions);
  print("San Francisco", result);
  EXPECT_LE(result.rms_m, kBound * result.slope_rms_m);
}

}  // namespace
}  // namespace yars::model::terrain
