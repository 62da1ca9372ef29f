// Rows of the ground along a ray: its power, which is a sum over all visible ground, and its shadow. The sum is made by
// this file's own walk of 9 m over its own reading of the posts.
#include <GeographicLib/Geodesic.hpp>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "lib/radar/configuration.hpp"
#include "model/kernel/tick_inputs.hpp"
#include "model/physics/receiver.hpp"
#include "model/rbm/beam.hpp"
#include "model/terrain/sampling/cell_view.hpp"
#include "model/terrain/store/directory_store.hpp"
#include "tests/model/terrain/sampling/rough_cell.hpp"
#include "tests/model/terrain/shapes.hpp"
#include "tests/model/terrain/shared_data.hpp"
#include "tests/truth/ledger.hpp"

namespace yars::truth {
namespace {

constexpr double kRadians = 0.017453292519943295;
constexpr double kVoid = std::numeric_limits<double>::quiet_NaN();

// Elevation posts of SRTM files of 3 arc seconds, bilinear.
class Posts {
 public:
  explicit Posts(std::filesystem::path folder) : folder_(std::move(folder)) {}

  struct Ground {
    double height_m, land;  // land: weight of the posts that are not at exactly 0 m
  };
  Ground at(double latitude_deg, double longitude_deg) {
    const int south = static_cast<int>(std::floor(latitude_deg)), west = static_cast<int>(std::floor(longitude_deg));
    const std::vector<std::uint8_t>& cell = cell_at(south, west);
    if (cell.empty()) return {kVoid, 0.0};
    const double row = (latitude_deg - south) * 1200.0, column = (longitude_deg - west) * 1200.0;
    const int i = std::min(static_cast<int>(row), 1199), j = std::min(static_cast<int>(column), 1199);
    const double u = row - i, v = column - j;
    Ground ground{0.0, 0.0};
    for (const auto& [di, dj, weight] :
         {std::tuple{0, 0, (1 - u) * (1 - v)}, {0, 1, (1 - u) * v}, {1, 0, u * (1 - v)}, {1, 1, u * v}}) {
      const double height_m = post(cell, i + di, j + dj);
      ground.height_m += weight * height_m;
      ground.land += height_m != 0.0 ? weight : 0.0;
    }
    return ground;
  }

 private:
  static double post(const std::vector<std::uint8_t>& cell, int row, int column) {
    const auto at = 2U * (static_cast<std::size_t>(1200 - row) * 1201U + static_cast<std::size_t>(column));
    const auto value = static_cast<std::int16_t>((cell[at] << 8U) | cell[at + 1]);
    return value == -32768 ? kVoid : value;
  }
  const std::vector<std::uint8_t>& cell_at(int south, int west) {
    const auto [found, is_new] = cells_.try_emplace({south, west});
    if (is_new) {
      const auto digits = [](int degrees, std::size_t count) {
        const std::string text = std::to_string(std::abs(degrees));
        return std::string(count - text.size(), '0') + text;
      };
      const std::string name =
          (south < 0 ? "S" : "N") + digits(south, 2) + (west < 0 ? "W" : "E") + digits(west, 3) + ".hgt";
      std::ifstream file(folder_ / name, std::ios::binary);
      found->second.assign(std::istreambuf_iterator<char>(file), {});
    }
    return found->second;
  }

  std::filesystem::path folder_;
  std::map<std::pair<int, int>, std::vector<std::uint8_t>> cells_;
};

struct View {
  double latitude_deg, longitude_deg, altitude_m, azimuth_deg, range_m;
};

// Sum of gamma theta r^2 dtheta over the visible ground, as power of the radar equation with a sensitivity time control
// of (r / 40 NM)^3, per sample; without full scale.
double closed_sum(Posts& posts, const View& view, double pulse_m, double theta_rad, double samples) {
  const GeographicLib::Geodesic& earth = GeographicLib::Geodesic::WGS84();
  const double a = 6378137.0, e2 = 0.00669437999014, sine = std::sin(view.latitude_deg * kRadians);
  const double meridian = a * (1 - e2) / std::pow(1 - e2 * sine * sine, 1.5),
               normal = a / std::sqrt(1 - e2 * sine * sine);
  const double north = std::cos(view.azimuth_deg * kRadians), east = std::sin(view.azimuth_deg * kRadians);
  const double radius_m = 4.0 / 3.0 / (north * north / meridian + east * east / normal);
  double horizon = -1e9, before = kVoid, sum = 0.0;
  constexpr double kStep_m = 9.0, kFullScale_m = 40.0 * 1852.0;
  for (double d = kStep_m; d <= view.range_m; d += kStep_m) {
    double latitude_deg, longitude_deg;
    earth.Direct(view.latitude_deg, view.longitude_deg, view.azimuth_deg, d, latitude_deg, longitude_deg);
    const auto [h, land] = posts.at(latitude_deg, longitude_deg);
    const double angle = d / radius_m;
    const double out = (radius_m + h) * std::sin(angle);
    const double up = (radius_m + h) * std::cos(angle) - radius_m - view.altitude_m;
    const double tangent = up / out;
    if (tangent > horizon) {
      const double r = std::hypot(out, up);
      const double cosine = std::cos(std::atan2(-up, out) - angle);  // of the grazing angle on level ground
      if (!std::isnan(before) && d > 2.0 * view.altitude_m)
        sum += land * theta_rad * r * r * (std::atan(tangent) - std::atan(horizon)) / (view.range_m / samples) *
               pulse_m / cosine / (r * kFullScale_m * kFullScale_m * kFullScale_m);
      horizon = tangent;
    }
    before = h;
  }
  return sum / samples;
}

struct Place {
  std::string name;
  double latitude_deg, longitude_deg, altitude_m;
};
const std::vector<Place>& places() {
  static const std::vector<Place> all{{"Nevada", 38.05, -114.95, 4572.0},
                                      {"Big Sur", 36.05, -121.45, 3000.0},
                                      {"New Hampshire", 44.05, -71.95, 2500.0}};
  return all;
}

radar::RadarConfiguration even_radar(const std::string& preset, int samples) {
  radar::RadarConfiguration configuration;
  configuration.fidelity = *radar::fidelity_preset(preset);
  configuration.fidelity.sub_beams = 1;
  configuration.fidelity.diffraction = false;  // light and shadow are geometric
  configuration.fidelity.earth_radius_factor = 4.0 / 3.0;
  configuration.fidelity.beam = radar::BeamPattern::hard_edge;
  configuration.fidelity.noise = false;
  if (samples > 0) configuration.fidelity.samples = samples;
  configuration.antenna.elevation_beamwidth_deg = 180.0;
  configuration.world.atmosphere.gases = false;
  configuration.world.sea.horizontal = {-300.0, 0.0, 0.0, 0.0, 0.0};  // no return of water
  return configuration;
}

// Sweeps over real ground, 10 degrees apart.
struct Sweeps {
  model::physics::Receiver receiver;
  std::vector<std::vector<float>> power;
};
constexpr double kFirst_deg = 5.0, kStep_deg = 10.0, kEnd_deg = 90.0;

Sweeps sweeps_of(const std::string& preset, const Place& place, double range_nm, int samples = 0) {
  const radar::RadarConfiguration configuration = even_radar(preset, samples);
  const geo::Length range = geo::Length::nautical_miles(range_nm);
  const geo::GeoPoint apex{place.latitude_deg, place.longitude_deg};
  auto store = model::terrain::open_terrain({(test::shared_data() / "srtm").string(), false});
  const auto terrain =
      (*store)->prepare({apex, range.metres(), model::kernel::scan_detail(configuration.fidelity, range)});
  Sweeps found{model::physics::Receivers(configuration).at(range), {}};
  model::rbm::Beam beam(configuration);
  for (double azimuth_deg = kFirst_deg; azimuth_deg < kEnd_deg; azimuth_deg += kStep_deg) {
    found.power.emplace_back(static_cast<std::size_t>(configuration.fidelity.samples));
    beam.measure({apex, geo::AltitudeMsl::metres(place.altitude_m), geo::Bearing::degrees(azimuth_deg),
                  geo::Angle::degrees(-90.0), range},
                 *terrain, found.power.back());
  }
  return found;
}

// Mean power of the sweeps, farther than twice the altitude, over that of the closed sum.
double difference_db(const std::string& preset, const Place& place, double range_nm) {
  const Sweeps found = sweeps_of(preset, place, range_nm);
  Posts posts(test::shared_data() / "srtm");
  double ours = 0.0, outside = 0.0, azimuth_deg = kFirst_deg;
  for (const std::vector<float>& power : found.power) {
    const auto count = static_cast<double>(power.size());
    const double range_m = range_nm * 1852.0;
    for (auto i = static_cast<std::size_t>(2.0 * place.altitude_m / range_m * count); i < power.size(); ++i)
      ours += static_cast<double>(power[i]) / count;
    outside += closed_sum(posts, {place.latitude_deg, place.longitude_deg, place.altitude_m, azimuth_deg, range_m},
                          found.receiver.pulse_length_m, found.receiver.azimuth_cell_rad, count) *
               found.receiver.land_gamma / found.receiver.full_scale;
    azimuth_deg += kStep_deg;
  }
  return 10.0 * std::log10(ours / outside);
}

// The difference of the greatest size over places and ranges.
double worst_db(const std::string& preset) {
  double worst = 0.0;
  for (const Place& place : places())
    for (const double range_nm : {10.0, 20.0, 40.0, 80.0, 160.0}) {
      const double found = difference_db(preset, place, range_nm);
      if (std::abs(found) > std::abs(worst)) worst = found;
    }
  return worst;
}

TEST(Relief, ReturnsTheSumOverTheVisibleGround) {
  YARS_NEEDS_SHARED_DATA();
  for (const auto& [preset, tolerance_db] :
       {std::pair{"reference", 0.3}, {"fine", 0.3}, {"standard", 0.3}, {"draft", 0.8}})
    expect_row({"Relief", std::string("power of sweeps over mountains, ") + preset + ", worst of 10 to 160 NM", 0.0,
                tolerance_db, "dB", "γ θ Σ r² Δε over the visible ground, by a walk of 9 m over shared/data/srtm",
                "the goal; the walk misses crests between its steps"},
               worst_db(preset));
}

// Mean over the samples of a coarse sweep against the mean over those of a fine one.
TEST(Relief, OfReferenceDoesNotDependOnTheNumberOfSamples) {
  YARS_NEEDS_SHARED_DATA();
  double coarse_sum = 0.0, fine_sum = 0.0, squares = 0.0, count = 0.0;
  for (const double range_nm : {40.0, 160.0}) {
    const Sweeps coarse = sweeps_of("reference", places().front(), range_nm, 1024);
    const Sweeps fine = sweeps_of("reference", places().front(), range_nm, 4096);
    for (std::size_t sweep = 0; sweep < coarse.power.size(); ++sweep)
      for (std::size_t i = 0; i < 1024; ++i) {
        double four = 0.0;
        for (std::size_t k = 0; k < 4; ++k) four += 0.25 * static_cast<double>(fine.power[sweep][4 * i + k]);
        const auto one = static_cast<double>(coarse.power[sweep][i]);
        coarse_sum += one;
        fine_sum += four;
        constexpr double kBlack = 3e-5;  // full scale less 45 dB, the range of the picture
        if (one < kBlack && four < kBlack) continue;
        squares += std::pow(10.0 * std::log10(std::max(one, kBlack) / std::max(four, kBlack)), 2.0);
        count += 1.0;
      }
  }
  const char* const why = "the goal; the pulse is smeared in eighths of a sample";
  expect_row({"Relief", "mean power of reference, 1024 samples over 4096", 0.0, 0.02, "dB",
              "convergence: no limit but 0", why},
             10.0 * std::log10(coarse_sum / fine_sum));
  expect_row({"Relief", "RMS difference of reference, 1024 samples to 4096", 0.0, 0.1, "dB",
              "convergence: no limit but 0", why},
             std::sqrt(squares / count));
}

// The line of sight over the edge of a plateau, 31 m ahead and 2 m below the observer, meets the plain 252 m below him.
TEST(Relief, APlateausEdgeNearTheObserverHidesThePlain) {
  constexpr int kPosts = 1201, kEdge = 600;
  model::terrain::CellView view(1, model::terrain::Absence::none);
  view.add(std::make_shared<const model::terrain::Cell>(
      test::cell_of({37, -122}, kPosts, kPosts, [](int row, int) { return row <= kEdge ? 250 : 0; })));
  for (const char* preset : {"reference", "standard"}) {
    radar::RadarConfiguration configuration = even_radar(preset, 1024);
    configuration.fidelity.earth = radar::EarthModel::flat;
    model::rbm::Beam beam(configuration);
    std::vector<float> power(1024);
    std::vector<std::uint8_t> lit(1024);
    const geo::GeoPoint apex =
        geo::geodesic_direct({37.5, -121.5}, geo::Bearing::degrees(180.0), geo::Length::metres(31.0));
    beam.measure({apex, geo::AltitudeMsl::metres(252.0), geo::Bearing::degrees(0.0), geo::Angle::degrees(-4.0),
                  geo::Length::nautical_miles(4.7)},
                 view, power);
    beam.lit(lit);
    std::size_t first = 100;  // far behind the edge
    while (first < lit.size() && lit[first] == 0) ++first;
    expect_row({"Relief", std::string("first lit ground behind an edge 31 m ahead, 2 m below, ") + preset,
                31.0 * 252.0 / 2.0, 9.0, "m", "similar triangles, flat earth", "a sample is 8.5 m long"},
               (static_cast<double>(first) + 0.5) * 4.7 * 1852.0 / 1024.0);
  }
}

// A peak 2,000 m high, 8 NM ahead of an aircraft at 15,000 ft. Behind the peak is shadow.
TEST(Relief, APeakIsAtItsOwnSlantRange) {
  constexpr double kPeak_m = 2000.0, kPeak_nm = 8.0, kRange_nm = 10.0, kAltitude_m = 4572.0, kMile_m = 1852.0;
  constexpr std::size_t kSamples = 480;
  const geo::GeoPoint apex{37.0, -115.0};
  const geo::GeoPoint peak =
      geo::geodesic_direct(apex, geo::Bearing::degrees(0.0), geo::Length::nautical_miles(kPeak_nm));
  const model::terrain::AnalyticTerrain land([peak](geo::GeoPoint position) {
    return std::max(1.0, kPeak_m - 1.5 * geo::geodesic_inverse(peak, position).distance.metres());
  });
  const double radius_m = 4.0 / 3.0 * geo::radius_of_curvature(37.0, geo::Bearing::degrees(0.0)).metres();
  const double half_rad = 0.5 * kPeak_nm * kMile_m / radius_m;
  const double slant_m =
      std::sqrt((kAltitude_m - kPeak_m) * (kAltitude_m - kPeak_m) +
                4.0 * (radius_m + kAltitude_m) * (radius_m + kPeak_m) * std::sin(half_rad) * std::sin(half_rad));
  const double sample_nm = kRange_nm / static_cast<double>(kSamples);
  for (const char* preset : {"reference", "standard"})
    for (const bool slant : {false, true}) {
      radar::RadarConfiguration configuration = even_radar(preset, kSamples);
      configuration.fidelity.pulse_smear = false;
      configuration.fidelity.slant_range = slant;
      model::rbm::Beam beam(configuration);
      std::vector<float> power(kSamples);
      beam.measure({apex, geo::AltitudeMsl::metres(kAltitude_m), geo::Bearing::degrees(0.0), geo::Angle::degrees(-4.0),
                    geo::Length::nautical_miles(kRange_nm)},
                   land, power);
      // The first dark sample beyond the foot of the peak.
      std::size_t end = 350;
      while (end < kSamples && power[end] > 0.0F) ++end;
      expect_row({"Relief",
                  std::string("end of the echo of a peak 2,000 m high at 8 NM, 15,000 ft, ") +
                      (slant ? "slant range, " : "ground range, ") + preset,
                  slant ? slant_m / kMile_m : kPeak_nm, 2.5 * sample_nm, "NM",
                  slant ? "law of cosines, triangle with the centre of the 4/3 earth" : "distance over ground",
                  "a sample is 0.021 NM long"},
                 static_cast<double>(end) * sample_nm);
    }
}

// A cliff returns between the slant ranges of its top and its foot, over the plain before it.
TEST(Relief, ACliffIsLaidOverThePlainBeforeIt) {
  constexpr double kTop_m = 1000.0, kCliff_m = 4.0 * 1852.0, kAltitude_m = 4572.0, kRange_nm = 10.0;
  constexpr std::size_t kSamples = 480;
  const geo::GeoPoint apex{37.0, -115.0};
  const model::terrain::AnalyticTerrain land([apex](geo::GeoPoint position) {
    return 1.0 +
           kTop_m * std::clamp((geo::geodesic_inverse(apex, position).distance.metres() - kCliff_m) / 40.0, 0.0, 1.0);
  });
  const double sample_m = kRange_nm * 1852.0 / static_cast<double>(kSamples);
  for (const char* preset : {"reference", "standard"}) {
    radar::RadarConfiguration configuration = even_radar(preset, kSamples);
    configuration.fidelity.pulse_smear = false;
    configuration.fidelity.slant_range = true;
    configuration.fidelity.earth = radar::EarthModel::flat;
    model::rbm::Beam beam(configuration);
    std::vector<float> power(kSamples), level(kSamples);
    const model::physics::SweepGeometry geometry{apex, geo::AltitudeMsl::metres(kAltitude_m),
                                                 geo::Bearing::degrees(0.0), geo::Angle::degrees(-4.0),
                                                 geo::Length::nautical_miles(kRange_nm)};
    beam.measure(geometry, land, power);
    model::rbm::Beam(configuration)
        .measure(geometry, model::terrain::AnalyticTerrain(model::terrain::flat(1.0)), level);
    // Middle of the echo beyond that of level ground.
    double sum = 0.0, moment = 0.0;
    for (std::size_t i = 0; i < 470; ++i) {
      const double more = std::max(0.0, static_cast<double>(power[i]) - 2.0 * static_cast<double>(level[i]));
      sum += more;
      moment += more * (static_cast<double>(i) + 0.5) * sample_m;
    }
    expect_row({"Relief", std::string("middle of the echo of a cliff of 1,000 m at 4 NM, slant range, ") + preset,
                0.5 * (std::hypot(kCliff_m, kAltitude_m) + std::hypot(kCliff_m, kAltitude_m - kTop_m)), 40.0, "m",
                "Pythagoras, flat earth", "the cliff is 40 m deep, a sample 39 m long"},
               moment / sum);
  }
}

// Fresnel integrals C(v) and S(v), by Simpson's rule.
double exact_knife_edge_db(double v) {
  constexpr int kSteps = 200'000;
  const double h = v / kSteps;
  double c = 0.0, s = 0.0;
  for (int i = 0; i <= kSteps; ++i) {
    const double weight = i == 0 || i == kSteps ? 1.0 : i % 2 == 1 ? 4.0 : 2.0;
    const double phase = 0.5 * std::numbers::pi * (i * h) * (i * h);
    c += weight * std::cos(phase);
    s += weight * std::sin(phase);
  }
  const double real = 0.5 - h / 3.0 * c, imaginary = 0.5 - h / 3.0 * s;
  return -10.0 * std::log10(0.5 * (real * real + imaginary * imaginary));
}

TEST(Relief, AKnifeEdgeTakesSixDecibelsAtTheCrest) {
  for (const double v : {0.0, 1.0, 2.4})
    expect_row({"Relief", "one-way loss by a knife edge, v = " + std::to_string(v).substr(0, 3), exact_knife_edge_db(v),
                0.3, "dB", "Fresnel integrals, P.526-15 eq. 27 to 31", "P.526's formula is an approximation"},
               model::physics::knife_edge_loss_db(v));
}

// Ground that rises gently behind a wall. The power of each sample over that without the wall is the two-way loss.
TEST(Relief, ReferenceBendsRaysOverAWall) {
  constexpr double kWall_m = 4000.0, kTop_m = 100.0, kAltitude_m = 600.0, kRange_nm = 4.7, kWavelength_m = 0.0312284;
  constexpr std::size_t kSamples = 1024;
  const geo::GeoPoint apex{37.0, -115.0};
  const auto rising = [apex](double wall_m) {
    return model::terrain::AnalyticTerrain([apex, wall_m](geo::GeoPoint position) {
      const double distance_m = geo::geodesic_inverse(apex, position).distance.metres();
      const double ground_m = 1.0 + 0.01 * distance_m;
      return std::abs(distance_m - kWall_m) < 10.0 ? std::max(ground_m, wall_m) : ground_m;
    });
  };
  const auto swept = [&](double wall_m, bool diffraction) {
    radar::RadarConfiguration configuration = even_radar("reference", kSamples);
    configuration.fidelity.diffraction = diffraction;
    configuration.fidelity.pulse_smear = false;
    configuration.fidelity.earth = radar::EarthModel::flat;
    std::vector<float> power(kSamples);
    model::rbm::Beam(configuration)
        .measure({apex, geo::AltitudeMsl::metres(kAltitude_m), geo::Bearing::degrees(0.0), geo::Angle::degrees(-4.0),
                  geo::Length::nautical_miles(kRange_nm)},
                 rising(wall_m), power);
    return power;
  };
  const std::vector<float> open = swept(0.0, false), bent = swept(kTop_m, true), shadow = swept(kTop_m, false);
  const double spacing_m = kRange_nm * 1852.0 / static_cast<double>(kSamples);
  // The line of sight over the wall meets the ground here.
  const double edge_m = kWall_m + 10.0, slope = (kTop_m - kAltitude_m) / edge_m;
  const double shadow_m = (kAltitude_m - 1.0) / (0.01 - slope);
  for (const double beyond_m : {-40.0, -20.0, 0.0}) {
    const auto i = static_cast<std::size_t>((shadow_m + beyond_m) / spacing_m);
    const double distance_m = (static_cast<double>(i) + 0.5) * spacing_m;
    const double above_m = kTop_m - (kAltitude_m + (1.0 + 0.01 * distance_m - kAltitude_m) * edge_m / distance_m);
    const double v = above_m * std::sqrt(2.0 * distance_m / (kWavelength_m * edge_m * (distance_m - edge_m)));
    expect_row(
        {"Relief",
         "two-way loss " + std::to_string(static_cast<int>(beyond_m)) + " m beyond the edge of a wall's shadow",
         2.0 * exact_knife_edge_db(v), 1.5, "dB", "Fresnel integrals at the middle of the sample, P.526-15 eq. 26",
         "the loss changes within a sample of 8.5 m; lobes of light are left out by P.526"},
        -10.0 * std::log10(static_cast<double>(bent[i]) / static_cast<double>(open[i])));
    if (beyond_m < 0.0) {
      EXPECT_EQ(shadow[i], 0.0F);
    }
  }
}

}  // namespace
}  // namespace yars::truth
