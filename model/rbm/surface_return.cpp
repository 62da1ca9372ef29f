#include "model/rbm/surface_return.hpp"

#include <algorithm>

#include "model/terrain/street_grid.hpp"

namespace yars::model::rbm {

namespace {
constexpr auto kWater = static_cast<std::size_t>(radar::kWaterMaterial);

// Shape of each material's texture; 0 = none.
std::array<double, radar::kMaterials> texture_shapes(const radar::RadarConfiguration& configuration) {
  std::array<double, radar::kMaterials> shapes{};
  if (!configuration.fidelity.noise) return shapes;
  shapes.fill(configuration.world.land.texture);
  for (const radar::Material& material : configuration.world.land.materials) {
    const auto code = static_cast<std::size_t>(material.code);
    if (code < shapes.size()) shapes[code] = material.texture;
  }
  shapes[kWater] = configuration.world.sea.texture;
  return shapes;
}
}  // namespace

SurfaceReturn::SurfaceReturn(const radar::RadarConfiguration& configuration)
    : land_(reflectivity::make_land_return(configuration)), sea_(reflectivity::make_sea_return(configuration)) {
  const auto shapes = texture_shapes(configuration);
  for (std::size_t code = 0; code < shapes.size(); ++code) {
    textured_[code] = shapes[code] > 0.0;
    // Equal shapes share their work.
    const auto twin = static_cast<std::size_t>(std::find(shapes.begin(), shapes.end(), shapes[code]) - shapes.begin());
    texture_[code] = twin < code ? texture_[twin] : reflectivity::make_texture_levels(shapes[code]);
  }
}

void SurfaceReturn::use_resolution(double pulse_length_m, double spacing_m) {
  const double cell_m = reflectivity::texture_cell_m(pulse_length_m, spacing_m);
  if (cell_m == cell_m_) return;
  cell_m_ = cell_m;
  grid_ = reflectivity::make_ground_grid(cell_m);
}

double SurfaceReturn::texture(std::size_t material, geo::GeoPoint place) const {
  if (!textured_[material]) return 1.0;
  return static_cast<double>(texture_[material][reflectivity::ground_bits(grid_, place) >> 24U]);
}

double SurfaceReturn::cross_section_m2(const Receiver& receiver, const Facet& facet) const {
  const std::size_t material = facet.material < radar::kMaterials ? facet.material : 0;
  const double water = material == kWater ? 1.0 : facet.water;
  double total_m2 = 0.0;
  if (water < 1.0) {
    double gamma = land_.gamma[material];
    if (land_.cardinal[material] > 0.0) {
      const double off_deg =
          reflectivity::off_street_deg(facet.look.degrees(), terrain::street_bearing_deg(facet.place));
      gamma *= reflectivity::cardinal_gain(land_.cardinal[material], off_deg, land_.street_width_deg);
    }
    total_m2 += (1.0 - water) * gamma * facet.sin_local * texture(material, facet.place) *
                illuminated_area_m2(receiver, facet.slant_range_m, facet.sin_local);
  }
  if (water > 0.0 && facet.sin_grazing > 0.0) {
    total_m2 += water * reflectivity::sea_sigma0(sea_, facet.sin_grazing, facet.look) * texture(kWater, facet.place) *
                illuminated_area_m2(receiver, facet.slant_range_m, facet.sin_grazing);
  }
  return total_m2;
}

}  // namespace yars::model::rbm
