#include "model/rbm/ground.hpp"

#include <algorithm>
#include <cmath>

#include "model/reflectivity/sea.hpp"
#include "model/terrain/street_grid.hpp"

namespace yars::model::rbm {

namespace {
constexpr auto kWater = static_cast<std::size_t>(radar::kWaterMaterial);

void put_texture(lanes::MaterialTables& tables, std::size_t code, double shape) {
  const reflectivity::TextureLevels levels = reflectivity::make_texture_levels(shape);
  std::copy(levels.begin(), levels.end(),
            tables.texture.begin() + static_cast<std::ptrdiff_t>(code * reflectivity::kTextureLevels));
}
}  // namespace

Ground::Ground(const radar::RadarConfiguration& configuration, std::size_t samples)
    : land_(reflectivity::make_land_return(configuration)),
      sea_(reflectivity::make_sea_table(reflectivity::make_sea_return(configuration))),
      wind_from_(reflectivity::make_sea_return(configuration).wind_from),
      sigma0_(sea_.across.size() + terrain::kRunSlack),
      codes_(samples + terrain::kRunSlack),
      level_(codes_.size()),
      everywhere_(codes_.size(), 1.0F),
      land_gamma_(codes_.size()),
      sea_sigma0_(codes_.size()) {
  const radar::WorldConfiguration& world = configuration.world;
  std::transform(land_.gamma.begin(), land_.gamma.end(), tables_.gamma.begin(),
                 [](double gamma) { return static_cast<float>(gamma); });
  static_assert(radar::kMaterials <= 32);
  for (std::size_t code = 0; code < radar::kMaterials; ++code)
    if (land_.cardinal[code] > 0.0) walled_ |= 1U << code;
  tables_.texture.fill(1.0F);
  if (!configuration.fidelity.noise) return;
  textured_sea_ = world.sea.texture > 0.0;
  textured_plain_ = textured_land_ = world.land.texture > 0.0;
  if (textured_plain_)
    for (std::size_t code = 0; code < radar::kMaterials; ++code) put_texture(tables_, code, world.land.texture);
  for (const radar::Material& material : world.land.materials) {
    const auto code = static_cast<std::size_t>(material.code);
    if (code >= radar::kMaterials) continue;
    put_texture(tables_, code, material.texture);
    textured_land_ = textured_land_ || material.texture > 0.0;
  }
  put_texture(tables_, kWater, world.sea.texture);
}

void Ground::use_resolution(double pulse_length_m, double spacing_m) {
  const double cell_m = reflectivity::texture_cell_m(pulse_length_m, spacing_m);
  if (cell_m == cell_m_) return;
  cell_m_ = cell_m;
  grid_ = reflectivity::make_ground_grid(cell_m);
}

Ground::Sample Ground::reflect(const Look& look, const terrain::PlaceRun& places, float* water,
                               const float* sin_grazing, bool materials) {
  const std::size_t count = places.north_deg.size();
  const bool some = materials && lanes::settle_materials(count, codes_.data(), water);
  const bool land = some || textured_plain_;
  const bool wet = lanes::any_positive(count, water);
  Sample sample;
  if (!land && !wet) return sample;
  const geo::Bearing azimuth = geo::GeodesicRay(look.apex, look.azimuth).place(0.5 * look.range).azimuth;
  const bool land_levels = land && textured_land_;
  if (land_levels || textured_sea_)
    lanes::texture_levels(count, grid_, places, land_levels ? everywhere_.data() : water, level_.data());
  if (wet) {
    lanes::fill_sigma0(sea_, static_cast<float>(std::cos((azimuth - wind_from_).radians())), sigma0_.data());
    lanes::sea_return(count, sigma0_.data(), water, sin_grazing,
                      &tables_.texture[kWater * reflectivity::kTextureLevels], textured_sea_ ? level_.data() : nullptr,
                      sea_sigma0_.data());
    sample.sea = sea_sigma0_.data();
  }
  // Without materials there is still less land where there is water.
  if (!materials) std::fill_n(codes_.data(), count, 0);
  lanes::land_return(count, tables_, codes_.data(), water, land_levels ? level_.data() : nullptr, land_gamma_.data());
  if (some) face_walls(places, azimuth);
  sample.land = land_gamma_.data();
  return sample;
}

// The cardinal effect: few samples have walls, so one by one.
void Ground::face_walls(const terrain::PlaceRun& places, geo::Bearing azimuth) {
  const std::size_t count = places.north_deg.size();
  const auto next = [&](std::size_t from) { return lanes::next_in(count, walled_, codes_.data(), from); };
  for (std::size_t i = next(0); i < count; i = next(i + 1)) {
    const double cardinal = land_.cardinal[static_cast<std::size_t>(codes_[i])];
    const double off_deg =
        reflectivity::off_street_deg(azimuth.degrees(), terrain::street_bearing_deg(terrain::place_of(places, i)));
    land_gamma_[i] *= static_cast<float>(reflectivity::cardinal_gain(cardinal, off_deg, land_.street_width_deg));
  }
}

}  // namespace yars::model::rbm
