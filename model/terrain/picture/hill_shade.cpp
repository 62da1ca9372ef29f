#include "model/terrain/picture/hill_shade.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>

#include "lib/geo/geodesy.hpp"
#include "model/terrain/sampling/cell_view.hpp"

namespace yars::model::terrain {

namespace {

using Colour = std::array<double, 3>;

constexpr double kExaggeration = 1.6;  // factor on slopes, for visible shading of gentle slopes
constexpr Colour kSea{38, 66, 112};
constexpr Colour kVoid{200, 60, 160};
constexpr Colour kAbsent{24, 34, 56};

struct Tint {
  double height_m;
  Colour colour;
};
constexpr Tint kTints[] = {{-500, {92, 128, 84}},  {0, {104, 142, 88}},     {300, {150, 162, 104}},
                           {900, {186, 166, 118}}, {1800, {160, 134, 110}}, {2800, {206, 200, 196}},
                           {4000, {250, 250, 250}}};

Colour tint(double height_m) {
  const Tint* above = std::begin(kTints);
  while (above != std::end(kTints) && above->height_m < height_m) ++above;
  if (above == std::begin(kTints)) return above->colour;
  if (above == std::end(kTints)) return std::prev(above)->colour;
  const Tint* below = std::prev(above);
  const double t = (height_m - below->height_m) / (above->height_m - below->height_m);
  Colour mixed{};
  for (std::size_t i = 0; i < mixed.size(); ++i)
    mixed[i] = below->colour[i] + t * (above->colour[i] - below->colour[i]);
  return mixed;
}

// Brightness factor by Lambert's cosine law. Slopes [m/m]: rise toward east and north positive. Light comes from the
// north-west, 40 deg above the horizontal. 0.25 is ambient light. The factor 1.15 gives level ground a brightness of
// 0.99.
double light(double slope_east, double slope_north) {
  constexpr double kEast = -0.542, kNorth = 0.542, kUp = 0.643;
  const double east = -slope_east * kExaggeration;
  const double north = -slope_north * kExaggeration;
  const double cosine = (east * kEast + north * kNorth + kUp) / std::sqrt(east * east + north * north + 1.0);
  return 0.25 + 1.15 * std::max(0.0, cosine);
}

// Size of a pixel [deg].
struct PixelStep {
  double north_deg, east_deg;
};

PixelStep step_of(const MapFrame& frame) {
  return {(frame.north_deg - frame.south_deg) / frame.height, (frame.east_deg - frame.west_deg) / frame.width};
}

double east_m_per_deg_at(double latitude_deg) {
  return geo::kMetresPerDegree * std::max(0.01, std::cos(latitude_deg * geo::kRadiansPerDegree));
}

struct Ground {
  const Cell& cell;
  const Culture* culture;  // may be null
};

// Colour of a surface material; of code 0 (none), colour by height.
Colour cover_of(std::uint8_t material, double height_m) {
  if (material == static_cast<std::uint8_t>(Material::none)) return tint(height_m);
  const auto colour = material_colour(material);
  return {static_cast<double>(colour[0]), static_cast<double>(colour[1]), static_cast<double>(colour[2])};
}

// Colour of land. Slopes [m/m]: rise toward east and north positive.
Colour lit_cover(std::uint8_t material, double height_m, double slope_east, double slope_north) {
  Colour colour = cover_of(material, height_m);
  for (double& channel : colour) channel *= light(slope_east, slope_north);
  return colour;
}

double rise_or_level(double difference_m) {
  return std::isnan(difference_m) ? 0.0 : difference_m;
}

Colour colour_at(const Ground& ground, double north_deg, double east_deg, PixelStep step, double east_m_per_deg) {
  const Cell& cell = ground.cell;
  const Surface here = interpolate(cell, north_deg, east_deg);
  const Cover cover = ground.culture != nullptr ? ground.culture->nearest(north_deg, east_deg) : Cover{};
  if (cover.water.value_or(here.water) > 0.5) return kSea;
  if (std::isnan(here.elevation_m)) return kVoid;
  // The slope is a difference over two pixels or two post spacings, whichever is wider, clipped at the cell's edges.
  const double offset_north_deg = std::max(step.north_deg, 1.0 / (cell.rows() - 1));
  const double offset_east_deg = std::max(step.east_deg, 1.0 / (cell.columns() - 1));
  const double north = std::min(1.0, north_deg + offset_north_deg);
  const double south = std::max(0.0, north_deg - offset_north_deg);
  const double east = std::min(1.0, east_deg + offset_east_deg);
  const double west = std::max(0.0, east_deg - offset_east_deg);
  const auto rise = [&](double from_north, double from_east, double to_north, double to_east) {
    return rise_or_level(interpolate(cell, to_north, to_east).elevation_m -
                         interpolate(cell, from_north, from_east).elevation_m);
  };
  return lit_cover(cover.material, here.elevation_m,
                   rise(north_deg, west, north_deg, east) / ((east - west) * east_m_per_deg),
                   rise(south, east_deg, north, east_deg) / ((north - south) * geo::kMetresPerDegree));
}

// `offset`: half the width of the difference that gives the slope.
Colour colour_at(const TerrainView& view, geo::GeoPoint point, PixelStep offset, double east_m_per_deg) {
  const Surface here = view.surface_at(point);
  if (!here.loaded) return kAbsent;
  if (here.water > 0.5) return kSea;
  if (std::isnan(here.elevation_m)) return kVoid;
  const auto height_m = [&](double north, double east) {
    return view.elevation_m({point.latitude_deg + north, point.longitude_deg + east});
  };
  const double east_m = rise_or_level(height_m(0.0, offset.east_deg) - height_m(0.0, -offset.east_deg));
  const double north_m = rise_or_level(height_m(offset.north_deg, 0.0) - height_m(-offset.north_deg, 0.0));
  return lit_cover(here.material, here.elevation_m, east_m / (2.0 * offset.east_deg * east_m_per_deg),
                   north_m / (2.0 * offset.north_deg * geo::kMetresPerDegree));
}

void put(imageio::Image& image, int x, int y, const Colour& colour) {
  std::uint8_t* pixel = &image.pixels[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                                           static_cast<std::size_t>(x))];
  for (std::size_t i = 0; i < colour.size(); ++i)
    pixel[i] = static_cast<std::uint8_t>(std::clamp(colour[i], 0.0, 255.0));
}

}  // namespace

MapFrame map_frame(double south_deg, double north_deg, double west_deg, double east_deg, int width) {
  const double middle = 0.5 * (south_deg + north_deg) * geo::kRadiansPerDegree;
  const double shape = (north_deg - south_deg) / ((east_deg - west_deg) * std::max(0.05, std::cos(middle)));
  return {south_deg, north_deg, west_deg,
          east_deg,  width,     static_cast<int>(std::clamp(std::round(width * shape), 1.0, 16384.0))};
}

imageio::Image blank_map(const MapFrame& frame) {
  imageio::Image image{frame.width, frame.height, 3, {}};
  image.pixels.resize(static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height) * 3);
  for (int y = 0; y < frame.height; ++y)
    for (int x = 0; x < frame.width; ++x) put(image, x, y, kAbsent);
  return image;
}

void paint_cell(const Cell& cell, const Culture* culture, const MapFrame& frame, imageio::Image& image) {
  const PixelStep step = step_of(frame);
  const double west_deg = cell.corner().west_deg;
  const double north_deg = cell.corner().south_deg + 1.0;
  // Clamped before the conversion to int: in a strongly magnified map a cell may begin billions of pixels outside.
  const auto first_pixel = [](double off_deg, double step_deg, int pixels) {
    return static_cast<int>(std::clamp(std::ceil(off_deg / step_deg - 0.5), 0.0, 1.0 * pixels));
  };
  const int left = first_pixel(west_deg - frame.west_deg, step.east_deg, frame.width);
  const int top = first_pixel(frame.north_deg - north_deg, step.north_deg, frame.height);
  for (int y = top; y < frame.height; ++y) {
    const double latitude_deg = frame.north_deg - (y + 0.5) * step.north_deg;
    if (latitude_deg < north_deg - 1.0) break;
    const double east_m_per_deg = east_m_per_deg_at(latitude_deg);
    for (int x = left; x < frame.width; ++x) {
      const double longitude_deg = frame.west_deg + (x + 0.5) * step.east_deg;
      if (longitude_deg >= west_deg + 1.0) break;
      put(image, x, y,
          colour_at({cell, culture}, latitude_deg - cell.corner().south_deg, longitude_deg - west_deg, step,
                    east_m_per_deg));
    }
  }
}

imageio::Image map_of(const TerrainView& view, const MapFrame& frame) {
  imageio::Image image = blank_map(frame);
  const PixelStep step = step_of(frame);
  const double post_deg = view.post_spacing_m() / geo::kMetresPerDegree;
  const PixelStep offset{std::max(step.north_deg, post_deg), std::max(step.east_deg, post_deg)};
  for (int y = 0; y < frame.height; ++y) {
    const double latitude_deg = frame.north_deg - (y + 0.5) * step.north_deg;
    if (std::abs(latitude_deg) > 90.0) continue;
    const double east_m_per_deg = east_m_per_deg_at(latitude_deg);
    for (int x = 0; x < frame.width; ++x) {
      const geo::GeoPoint point{latitude_deg, frame.west_deg + (x + 0.5) * step.east_deg};
      put(image, x, y, colour_at(view, point, offset, east_m_per_deg));
    }
  }
  return image;
}

}  // namespace yars::model::terrain
