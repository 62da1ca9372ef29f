// Shadow of terrain on patch maps, against brute force over the finest posts. Brute force samples the ground in steps
// of a tenth of the post spacing, along the exact geodesic on the exact effective earth. A point of the polar grid is
// dark if any nearer ground has an equal or greater tangent of elevation.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "lib/radar/configuration.hpp"
#include "lib/values/presets.hpp"
#include "model/hrm/patch_geometry.hpp"
#include "model/hrm/polar_ground.hpp"
#include "model/hrm/reference.hpp"
#include "model/terrain/sampling/cell_view.hpp"
#include "model/terrain/store/directory_store.hpp"
#include "tests/model/bounds/lines_of_posts.hpp"
#include "tests/model/bounds/made_up_coast.hpp"
#include "tests/model/hrm/patch_maker.hpp"
#include "tests/model/terrain/formats/dted_builder.hpp"
#include "tests/model/terrain/sampling/rough_cell.hpp"
#include "tests/model/terrain/shared_data.hpp"

namespace yars::test {
namespace {

namespace terrain = model::terrain;

constexpr double kNoTangent = -std::numeric_limits<double>::infinity();  // without ground
constexpr double kAllWindows_nm[] = {0.67, 1.3, 2.0, 3.3, 4.7, 10.0, 20.0, 40.0, 80.0};
constexpr double kSomeWindows_nm[] = {0.67, 4.7, 20.0, 80.0};
constexpr int kColumns = 8;           // compared columns of a map
constexpr int kReferencePixels = 64;  // per side, for `reference`: fewer rows do not make its shadow coarser

struct Country {
  std::string name;
  std::filesystem::path folder;
  geo::GeoPoint centre;
  double from_deg = 180.0;  // true bearing from the centre to the aircraft
  double altitude_ft = 15000.0;
};

hrm::PatchOrder order_of(const Country& country, double window_nm) {
  // At least 10 NM and 1.2 windows, for small grazing angles as in low flight.
  const double distance_nm = std::max(10.0, 1.2 * window_nm);
  hrm::PatchOrder order;
  order.centre = country.centre;
  order.apex = geo::geodesic_direct(country.centre, geo::Bearing::degrees(country.from_deg),
                                    geo::Length::nautical_miles(distance_nm));
  order.altitude = geo::AltitudeMsl::feet(country.altitude_ft);
  order.ground_speed = geo::Speed::knots(480.0);
  order.window = geo::Length::nautical_miles(window_nm);
  return order;
}

// Polar grid of a map with the ground heights, horizons and crests that a preset computes.
struct PresetGround {
  hrm::PatchGeometry geometry;
  hrm::PolarGrid grid;
  std::vector<hrm::SurfacePoint> surface;
  std::vector<float> horizon, crest_m;
  hrm::CrestsBetweenRows crests{};
  hrm::PatchData data{1};                       // data of `reference`
  std::shared_ptr<hrm::Reference> reference{};  // null for other algorithms

  // Light (true) or shadow (false) of a column, by row.
  std::vector<bool> lit(int column) const {
    std::vector<bool> lit_rows;
    for (int row = 0; reference && row < grid.rows; ++row) lit_rows.push_back(reference->lit(column, row));
    if (reference) return lit_rows;
    double highest = static_cast<double>(horizon[static_cast<std::size_t>(column)]);
    for (int row = 0; row < grid.rows; ++row) {
      const std::size_t at = grid.at(column, row);
      const double distance_m = grid.distance_m(row);
      const auto tangent = [&](float height_m) {
        return (static_cast<double>(height_m) - geometry.above_plane_m(distance_m)) /
               geometry.sight_distance_m(distance_m);
      };
      if (crests.any()) highest = std::max(highest, tangent(crest_m[at]));
      lit_rows.push_back(tangent(surface[at].height_m) > highest);
      highest = std::max(highest, tangent(surface[at].height_m));
    }
    return lit_rows;
  }
};

// Reads the terrain in the steps of hrm::PatchFormation.
std::unique_ptr<PresetGround> compute_ground(const radar::RadarConfiguration& configuration,
                                             const hrm::PatchOrder& order, const terrain::TerrainViewPointer& window,
                                             const terrain::TerrainViewPointer& path) {
  const double elevation_m = window->elevation_m(order.centre);
  const hrm::PatchGeometry geometry(order, configuration, std::isnan(elevation_m) ? 0.0 : elevation_m);
  const int pixels = configuration.fidelity.map_size;
  const bool exact = configuration.fidelity.algorithm == radar::Algorithm::reference;
  const int cells = exact ? hrm::kReferenceCells : configuration.fidelity.map_oversampling;
  const hrm::PolarGrid grid = hrm::make_polar_grid(geometry, pixels, cells, {});
  auto computed = std::make_unique<PresetGround>(
      PresetGround{geometry, grid, std::vector<hrm::SurfacePoint>(grid.size()),
                   std::vector<float>(static_cast<std::size_t>(grid.columns)), std::vector<float>(grid.size())});
  const auto smooth =
      configuration.fidelity.map_smooth_ground
          ? terrain::smooth_between_posts(window, hrm::smoothing_parameters(geometry, grid, configuration.fidelity, {}))
          : window;
  if (exact) {
    computed->data.geometry = geometry;
    computed->data.grid = grid;
    computed->reference = std::make_shared<hrm::Reference>(configuration);
    computed->reference->begin(computed->data);
    computed->reference->read_terrain({order, {smooth, path, nullptr}, {}}, computed->data);
    return computed;
  }
  computed->crests = hrm::crests_between_rows(grid, *window, smooth != window);
  hrm::PolarGround ground(configuration);
  ground.begin(geometry, grid, *path);
  ground.fill(order, geometry, grid, {smooth.get(), path.get(), computed->crests}, nullptr, 0, grid.columns,
              {computed->surface.data(), computed->horizon.data(),
               computed->crests.any() ? computed->crest_m.data() : nullptr});
  return computed;
}

// Brute force along one column: sampled distances in ascending order, and for each the greatest tangent of elevation up
// to this distance.
class Truth {
 public:
  Truth(const PresetGround& computed, const hrm::PatchOrder& order, const terrain::TerrainView& path,
        const terrain::TerrainView& window, int column)
      : geometry_(computed.geometry),
        altitude_m_(order.altitude.metres()),
        window_(window),
        ray_(order.apex, computed.geometry.up() + geo::Angle::radians(std::atan(computed.grid.tangent(column)))) {
    const double step_m = 0.1 * path.post_spacing_m();
    const double first_m = computed.grid.first_distance_m;
    // Step on the path: 0.3 of the row spacing, but between 0.01 and 0.1 of the post spacing.
    const double path_step_m = std::clamp(0.3 * computed.grid.spacing_m, 0.1 * step_m, step_m);
    const int path_steps = static_cast<int>(std::ceil(first_m / path_step_m));
    for (int step = 1; step < path_steps; ++step) {
      add_lines_of_posts(path, (step - 1) * path_step_m, step * path_step_m);
      add(path, step * path_step_m);
    }
    // `reference` is nearer to the summits between the nodes of smooth ground than steps of a tenth of the posts.
    const double row_step_m = computed.reference ? 0.1 * step_m : step_m;
    const int steps = static_cast<int>(std::ceil(computed.grid.spacing_m / row_step_m));
    const auto row_m = [&](int row, int step) {
      return computed.grid.distance_m(row + static_cast<double>(step) / steps);
    };
    for (int row = 0; row + 1 < computed.grid.rows; ++row)
      for (int step = 0; step < steps; ++step) {
        if (step > 0) add_lines_of_posts(window, row_m(row, step - 1), row_m(row, step));
        add(window, row_m(row, step));
      }
  }
  double own_tangent(double distance_m) const { return tangent(window_, distance_m); }
  double horizon_before(double distance_m) const {
    const auto behind = std::lower_bound(distance_m_.begin(), distance_m_.end(), distance_m - 1e-3);
    return behind == distance_m_.begin() ? kNoTangent
                                         : highest_[static_cast<std::size_t>(behind - distance_m_.begin()) - 1];
  }

 private:
  void add_lines_of_posts(const terrain::TerrainView& view, double from_m, double to_m) {
    for (const double line_m : lines_of_posts_m(view, ray_, from_m, to_m)) add(view, line_m);
  }
  void add(const terrain::TerrainView& view, double distance_m) {
    const double before = highest_.empty() ? kNoTangent : highest_.back();
    distance_m_.push_back(distance_m);
    highest_.push_back(std::max(before, tangent(view, distance_m)));
  }
  double tangent(const terrain::TerrainView& view, double distance_m) const {
    const double height_m = view.elevation_m(ray_.position(geo::Length::metres(distance_m)));
    return std::isnan(height_m) ? kNoTangent : geometry_.earth().sight(altitude_m_, distance_m, height_m).tangent;
  }

  const hrm::PatchGeometry& geometry_;
  double altitude_m_;
  const terrain::TerrainView& window_;
  geo::GeodesicRay ray_;
  std::vector<double> distance_m_, highest_;
};

struct Counts {
  double wrong = 0.0, dark = 0.0, points = 0.0;
};

Counts compare(std::string_view preset, const Country& country, double window_nm, terrain::TerrainStore& store) {
  radar::RadarConfiguration configuration;
  configuration.fidelity = *radar::fidelity_preset(preset);
  const bool exact = configuration.fidelity.algorithm == radar::Algorithm::reference;
  if (exact) configuration.fidelity.map_size = kReferencePixels;
  const hrm::PatchOrder order = order_of(country, window_nm);
  const hrm::PatchNeed need = hrm::patch_need(order, configuration.fidelity);
  const auto window = store.prepare(need.window), path = store.prepare(need.path);
  const std::unique_ptr<PresetGround> made = compute_ground(configuration, order, window, path);
  const PresetGround& computed = *made;
  const geo::Length reach = geo::Length::metres(1.5 * computed.grid.distance_m(computed.grid.rows - 1));
  const auto finest = store.prepare({order.apex, reach.metres(), 0});
  // Smoothed ground, that of `reference` itself, else with at least 10 nodes per post interval.
  terrain::SmoothParameters finer =
      hrm::smoothing_parameters(computed.geometry, computed.grid, configuration.fidelity, {});
  if (!exact) finer.min_parts = std::max(finer.min_parts, 10);
  const auto ground = configuration.fidelity.map_smooth_ground ? terrain::smooth_between_posts(finest, finer) : finest;
  Counts counts;
  const int columns = exact && std::getenv("YARS_TEST_FULL") != nullptr ? 3 * kColumns : kColumns;
  for (int i = 0; i < columns; ++i) {
    const int column = static_cast<int>((i + 0.37) / columns * computed.grid.columns);
    const Truth truth(computed, order, *finest, *ground, column);
    const std::vector<bool> lit = computed.lit(column);
    for (int row = 0; row < computed.grid.rows; ++row) {
      const double own = truth.own_tangent(computed.grid.distance_m(row));
      if (!(own > kNoTangent)) continue;
      const bool truly_lit = own > truth.horizon_before(computed.grid.distance_m(row));
      counts.points += 1.0;
      counts.dark += truly_lit ? 0.0 : 1.0;
      counts.wrong += truly_lit == lit[static_cast<std::size_t>(row)] ? 0.0 : 1.0;
    }
  }
  return counts;
}

// Compares all presets. Returns the largest fraction of dark points of a map.
double expect_within_bounds(const Country& country, std::span<const double> windows_nm = kAllWindows_nm) {
  auto store = terrain::open_terrain({country.folder.string(), true});
  EXPECT_TRUE(store) << store.error().message();
  if (!store) return 0.0;
  double most_dark = 0.0;
  for (const double window_nm : windows_nm)
    for (const auto& preset : values::kComparablePresets) {
      const Counts counts = compare(preset.name, country, window_nm, **store);
      if (counts.points == 0.0) continue;
      const double wrong = counts.wrong / counts.points;
      most_dark = std::max(most_dark, counts.dark / counts.points);
      EXPECT_LE(wrong, preset.max_wrong_shadow + 1.0 / counts.points)
          << country.name << ", " << preset.name << ", " << window_nm << " NM";
      std::printf("%s, %s, %g NM: %.0f points, %.1f %% dark, %.3f %% differ\n", country.name.c_str(),
                  preset.name.data(), window_nm, counts.points, 100.0 * counts.dark / counts.points, 100.0 * wrong);
    }
  return most_dark;
}

// A wall as wide as one post, far narrower than a row, shadows the ground behind it on the finished map.
TEST(PatchShadow, OfAWallBetweenRowsIsOnTheMap) {
  auto view = std::make_shared<terrain::CellView>(1, terrain::Absence::none);
  for (const int south : {36, 37, 38})
    view->add(std::make_shared<const terrain::Cell>(
        cell_of({south, -123}, 1201, 1201, [&](int row, int) { return south == 37 && row == 601 ? 1000 : 10; })));
  for (const auto algorithm : {radar::Algorithm::standard, radar::Algorithm::reference})
    for (const double window_nm : {20.0, 40.0}) {
      radar::RadarConfiguration configuration = bare_map(48);
      configuration.fidelity.algorithm = algorithm;
      hrm::PatchOrder order;
      order.centre = {37.5, -122.5};
      order.apex = {36.6, -122.5};
      order.altitude = geo::AltitudeMsl::metres(5000.0);
      order.ground_track = geo::Bearing::degrees(90.0);
      order.window = geo::Length::nautical_miles(window_nm);
      const auto process = make_patch(configuration, order, view);
      const hrm::MapImage& image = process.image();
      const double pixel_m = process.geometry().window_m() / image.size;
      // The wall stands 93 m beyond the centre; its shadow is 25 km long.
      for (int row = 0; row < image.size; ++row) {
        const double beyond_m = 0.5 * process.geometry().window_m() - (row + 0.5) * pixel_m - 93.0;
        if (std::abs(beyond_m) < 2.0 * pixel_m || beyond_m > 20000.0) continue;
        EXPECT_EQ(image.power[image.at(image.size / 2, row)] > 0.0F, beyond_m < 0.0)
            << window_nm << " NM, " << beyond_m << " m behind the wall";
      }
    }
}

TEST(PatchShadowBound, HoldsOverTheMadeUpCoast) {
  const Country coast{"made-up coast", made_up_coast(), {37.5, -122.45}, 200.0, 5000.0};
  EXPECT_GT(expect_within_bounds(coast, kSomeWindows_nm), 0.02);
}

TEST(PatchShadowBound, HoldsOverRealMountains) {
  YARS_NEEDS_SHARED_DATA();
  EXPECT_GT(expect_within_bounds({"Nevada", shared_data() / "srtm", {38.9, -114.3}, 200.0, 15000.0}), 0.3);
}

TEST(PatchShadowBound, HoldsOverRealHills) {
  YARS_NEEDS_SHARED_DATA();
  EXPECT_GT(expect_within_bounds({"jungle hills", shared_data() / "dted", {0.4, 6.6}, 120.0, 8000.0}), 0.01);
}

TEST(PatchShadowBound, HoldsOverARealCoast) {
  YARS_NEEDS_SHARED_DATA();
  EXPECT_GT(expect_within_bounds({"Big Sur", shared_data() / "srtm", {36.25, -121.7}, 250.0, 6000.0}), 0.1);
}

}  // namespace
}  // namespace yars::test
