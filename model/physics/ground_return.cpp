#include "model/physics/ground_return.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lib/geo/geodesy.hpp"
#include "lib/radar/world.hpp"
#include "model/physics/ray.hpp"
#include "model/physics/reflectivity.hpp"

namespace yars::model::physics {

namespace {
constexpr auto kWater = static_cast<std::size_t>(radar::kWaterMaterial);

// Shape of the gamma-distributed texture by material code; 0: no texture; NaN: by angle and area.
std::array<double, radar::kMaterials> texture_shapes(const RadarParameters& parameters) {
  std::array<double, radar::kMaterials> shapes{};
  if (!parameters.noise) return shapes;
  shapes.fill(parameters.world.land.texture);
  for (const radar::Material& material : parameters.world.land.materials) {
    const auto code = static_cast<std::size_t>(material.code);
    if (code < shapes.size()) shapes[code] = material.texture;
  }
  shapes[kWater] = parameters.world.sea.texture;
  return shapes;
}
}  // namespace

LandTextures::LandTextures(const RadarParameters& parameters)
    : levels(TextureSteps::levels().begin(), TextureSteps::levels().end()) {
  static_assert(radar::kMaterials <= 32);
  const auto shapes = texture_shapes(parameters);
  for (std::size_t code = 0; code < shapes.size(); ++code) {
    const std::uint32_t bit = 1U << code;
    if (land_kind(code) == LandKind::even) even |= bit;
    if (!(shapes[code] <= 0.0)) textured |= bit;
    if (std::isnan(shapes[code]) && code != kWater) continue;
    if (!std::isnan(shapes[code])) configured |= bit;
    entry[code] = TextureSteps::entry(0.0);
    if (shapes[code] <= 0.0) continue;
    const double shape = std::isnan(shapes[code]) ? radar::SeaConfiguration::kMapTexture : shapes[code];
    // Codes with equal shapes have equal levels.
    const auto equal = std::find(shapes.begin(), shapes.begin() + static_cast<std::ptrdiff_t>(code), shapes[code]);
    const auto equal_code = static_cast<std::size_t>(equal - shapes.begin());
    entry[code] = equal_code < code ? entry[equal_code] : static_cast<std::int32_t>(levels.size());
    if (equal_code < code) continue;
    const TextureLevels made = make_texture_levels(shape);
    levels.insert(levels.end(), made.begin(), made.end());
  }
}

TextureDrift SeaTexture::drift(const SampleTextures& samples, geo::Duration sim_time) const {
  if (!(life_s > 0.0) || !samples.has_beam()) return {};
  const double time_s = sea_texture_time(sim_time).seconds();
  return make_texture_drift(samples.grid(), north_mps * time_s, east_mps * time_s, time_s / life_s);
}

namespace {
SeaTexture make_sea_texture(const RadarParameters& parameters, const SeaReturn& sea) {
  const double speed_mps = wave_speed(geo::Speed::metres_per_second(sea.wind_mps)).metres_per_second();
  const double from_rad = sea.wind_from.radians();
  return {-speed_mps * std::cos(from_rad), -speed_mps * std::sin(from_rad), parameters.world.sea.texture_life_s};
}
}  // namespace

SurfaceReturn::SurfaceReturn(const RadarParameters& parameters)
    : land_(make_land_return(parameters)), textures_(parameters), samples_(parameters) {
  use_sea(parameters);
}

void SurfaceReturn::use_sea(const RadarParameters& parameters) {
  sea_ = make_sea_return(parameters);
  sea_texture_ = make_sea_texture(parameters, sea_);
}

void SurfaceReturn::use_texture(const TextureSweep& sweep, geo::Duration sim_time) {
  samples_.use(sweep);
  drift_ = sea_texture_.drift(samples_, sim_time);
}

double SurfaceReturn::texture(std::size_t material, const Facet& facet) const {
  const std::uint32_t bit = 1U << material;
  if ((textures_.textured & bit) == 0) return 1.0;
  const TextureDrift drift = material == kWater ? drift_ : TextureDrift{};
  const std::uint32_t level = drifted_bits(samples_.grid(), facet.position, drift) >> 24U;
  const auto factor = [&](std::int32_t entry) {
    return static_cast<double>(textures_.levels[static_cast<std::uint32_t>(entry) + level]);
  };
  const bool by_law = samples_.has_beam() || material != kWater;
  if ((textures_.configured & bit) != 0 || !by_law) return factor(textures_.entry[material]);
  if (material == kWater) {
    const double turn = TextureSteps::kMinShape * sea_turn(std::cos((facet.azimuth - sea_.wind_from).radians()));
    return factor(TextureSteps::entry(std::exp2(samples_.sea()[facet.sample] / TextureSteps::kPerOctave) * turn));
  }
  return factor(samples_.land((textures_.even & bit) != 0 ? LandKind::even : LandKind::rural)[facet.sample]);
}

SurfaceReturn::Reflectivity SurfaceReturn::at(const Facet& facet) const {
  const std::size_t material = facet.material < radar::kMaterials ? facet.material : 0;
  const double water = material == kWater ? 1.0 : facet.water;
  Reflectivity found;
  if (water < 1.0) {
    found.gamma = (1.0 - water) * land_.gamma[material] * texture(material, facet);
    if (land_.cardinal[material] > 0.0) {
      const double off_deg = off_street_deg(facet.azimuth.degrees(), street_bearing_deg(facet.position));
      found.gamma *= cardinal_gain(land_.cardinal[material], off_deg, land_.cardinal_width_deg);
    }
  }
  if (water > 0.0 && facet.sin_grazing > 0.0)
    found.sigma0 = water * sea_sigma0(sea_, facet.sin_grazing, facet.azimuth) * texture(kWater, facet);
  return found;
}

namespace {

struct Direction {
  double north, east;
};

// Direction of the ray at half the range, on a sphere. Error at most 0.01 degrees for 160 NM.
// Source: Clairaut's relation; Karney 2013, "Algorithms for geodesics", eq. 10.
Direction middle_direction(const SweepGeometry& geometry) {
  const double arc_rad = 0.5 * geometry.range.metres() / geo::kMeanEarthRadius_m;
  const double latitude_rad = geometry.apex.latitude_deg * geo::kRadiansPerDegree;
  const double azimuth_rad = geometry.azimuth.radians();
  const double cos_latitude = std::cos(latitude_rad);
  const double east = std::sin(azimuth_rad) * cos_latitude;
  const double north =
      std::cos(azimuth_rad) * cos_latitude * std::cos(arc_rad) - std::sin(latitude_rad) * std::sin(arc_rad);
  const double length = std::sqrt(north * north + east * east);
  // The length is 0 only if the middle is a pole, where any direction is correct.
  return length > 0.0 ? Direction{north / length, east / length} : Direction{1.0, 0.0};
}
}  // namespace

Ground::Ground(const RadarParameters& parameters, std::size_t samples)
    : land_(make_land_return(parameters)),
      sigma0_(sea_.across.size() + terrain::kRunSlack),
      textures_(parameters),
      samples_(parameters),
      codes_(samples + kPairSlack),
      wall_gain_(codes_.size(), 1.0F),
      land_gamma_(codes_.size()),
      sea_sigma0_(codes_.size()) {
  use_sea(parameters);
  std::transform(land_.gamma.begin(), land_.gamma.end(), tables_.gamma.begin(),
                 [](double gamma) { return static_cast<float>(gamma); });
  for (std::size_t code = 0; code < radar::kMaterials; ++code)
    if (land_.cardinal[code] > 0.0) inputs_.walled |= 1U << code;
  tables_.entry = textures_.entry;
  inputs_.levels = textures_.levels.data();
  inputs_.sea_entry = textures_.entry[kWater];
  inputs_.configured = textures_.configured;
  inputs_.even_kinds = textures_.even;
  inputs_.textured_sea = (textures_.textured >> kWater & 1U) != 0;
}

void Ground::use_sea(const RadarParameters& parameters) {
  const SeaReturn sea = make_sea_return(parameters);
  sea_ = make_sea_table(sea);
  sea_texture_ = make_sea_texture(parameters, sea);
  inputs_.glint = 0.0F;
  if (sea.slope_variance > 0.0) {
    inputs_.glint = static_cast<float>(kSeaReflection / sea.slope_variance);
    inputs_.glint_octaves = static_cast<float>(std::numbers::log2e / sea.slope_variance);
  }
  const double wind_rad = sea.wind_from.radians();
  wind_north_ = std::cos(wind_rad);
  wind_east_ = std::sin(wind_rad);
}

void Ground::resize(std::size_t samples) {
  samples_.resize(samples);
  codes_.assign(samples + kPairSlack, 0);
  wall_gain_.assign(codes_.size(), 1.0F);
  land_gamma_.assign(codes_.size(), 0.0F);
  sea_sigma0_.assign(codes_.size(), 0.0F);
}

void Ground::use_texture(const TextureSweep& sweep, geo::Duration sim_time) {
  samples_.use(sweep);
  inputs_.drift = sea_texture_.drift(samples_, sim_time);
  const bool sea_law = sweep.has_beam() && (textures_.configured >> kWater & 1U) == 0;
  inputs_.sea_steps = sea_law ? samples_.sea() : nullptr;
  const std::uint32_t by_law = sweep.has_beam() ? ~0U : textures_.configured;
  inputs_.textured = textures_.textured & by_law & ~(1U << kWater);
}

const simd::GroundInputs* Ground::prepare(const SweepGeometry& geometry, const terrain::PositionRun& positions,
                                          const float* water, bool materials) {
  const std::size_t count = positions.north_deg.size();
  if (!materials && (inputs_.textured & 1U) == 0 && !simd::any_positive(count, water)) return nullptr;
  const Direction azimuth = middle_direction(geometry);
  if (materials) compute_wall_gain(positions, geo::Bearing::radians(std::atan2(azimuth.east, azimuth.north)));
  inputs_.tables = &tables_;
  inputs_.positions = positions;
  inputs_.water = water;
  inputs_.material = materials ? codes_.data() : nullptr;
  inputs_.wall_gain = wall_gain_.data();
  inputs_.sea = &sea_;
  inputs_.upwind = static_cast<float>(azimuth.north * wind_north_ + azimuth.east * wind_east_);
  inputs_.sea_turn =
      static_cast<float>(TextureSteps::kPerOctave * std::log2(sea_turn(static_cast<double>(inputs_.upwind))));
  inputs_.sigma0 = sigma0_.data();
  inputs_.grid = &samples_.grid();
  inputs_.rural = samples_.land(LandKind::rural);
  inputs_.even = samples_.land(LandKind::even);
  return &inputs_;
}

Ground::Sample Ground::reflect(const SweepGeometry& geometry, const terrain::PositionRun& positions, const float* water,
                               const float* sin_grazing, bool materials) {
  const simd::GroundInputs* const ground = prepare(geometry, positions, water, materials);
  if (ground == nullptr) return {};
  simd::reflect(positions.north_deg.size(), *ground, sin_grazing, land_gamma_.data(), sea_sigma0_.data());
  return {land_gamma_.data(), sea_sigma0_.data()};
}

// Sets wall_gain_ to the cardinal effect at the samples with walls. These samples are few and computed one by one.
void Ground::compute_wall_gain(const terrain::PositionRun& positions, geo::Bearing azimuth) {
  const std::size_t count = positions.north_deg.size();
  const auto next = [&](std::size_t from) {
    return simd::next_sample_with_material(count, inputs_.walled, codes_.data(), from);
  };
  // The gain is reused while material and street direction stay equal.
  double last_street_deg = -1.0;
  std::int32_t last_code = -1;
  float gain = 1.0F;
  for (std::size_t i = next(0); i < count; i = next(i + 1)) {
    const double street_deg = streets_.bearing_deg(terrain::position_of(positions, i));
    if (codes_[i] != last_code || street_deg != last_street_deg) {
      const double off_deg = off_street_deg(azimuth.degrees(), street_deg);
      const double cardinal = land_.cardinal[static_cast<std::size_t>(codes_[i])];
      gain = static_cast<float>(cardinal_gain(cardinal, off_deg, land_.cardinal_width_deg));
      last_code = codes_[i];
      last_street_deg = street_deg;
    }
    wall_gain_[i] = gain;
  }
}

}  // namespace yars::model::physics
