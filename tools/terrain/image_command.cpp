#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lib/geo/earth.hpp"
#include "lib/geo/quantity.hpp"
#include "lib/imageio/png.hpp"
#include "model/terrain/formats/cell.hpp"
#include "model/terrain/formats/culture.hpp"
#include "model/terrain/sampling/cell_view.hpp"
#include "model/terrain/store/cell_files.hpp"
#include "tools/command/command.hpp"
#include "tools/command/output.hpp"

namespace yars::tools {

// Hill-shaded map of elevation, lit from the north-west, coloured by height or by surface material. Sea, voids and
// absent cells have fixed colours. Projection: plate carree (x proportional to longitude, y to latitude), scaled so
// that shapes are true at the middle parallel.

struct MapFrame {
  double south_deg = 0.0, north_deg = 0.0, west_deg = 0.0, east_deg = 0.0;
  int width = 0, height = 0;  // [pixels]
};

// Frame of the given width [pixels]. The height, 1 to 16384 pixels, gives true shapes at the middle parallel.
MapFrame map_frame(double south_deg, double north_deg, double west_deg, double east_deg, int width);

// RGB image filled with the colour of absent cells.
imageio::Image blank_map(const MapFrame& frame);

// Paints the pixels whose centre is in the cell. `culture` may be null.
void paint_cell(const model::terrain::Cell& cell, const model::terrain::Culture* culture, const MapFrame& frame,
                imageio::Image& image);

namespace {

using model::terrain::Cell;
using model::terrain::Culture;
using model::terrain::Material;
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

struct Ground {
  const Cell& cell;
  const Culture* culture;  // may be null
};

// Colour of the surface material. Where culture is absent or has code 0 (none): colour by height. `north_deg` and
// `east_deg` count from the cell's south-west corner.
Colour cover_of(const Ground& ground, double north_deg, double east_deg, double height_m) {
  const std::uint8_t code = ground.culture != nullptr ? ground.culture->nearest(north_deg, east_deg) : 0;
  if (code == static_cast<std::uint8_t>(Material::none)) return tint(height_m);
  const auto colour = model::terrain::material_colour(code);
  return {static_cast<double>(colour[0]), static_cast<double>(colour[1]), static_cast<double>(colour[2])};
}

Colour colour_at(const Ground& ground, double north_deg, double east_deg, PixelStep step, double east_m_per_deg) {
  const Cell& cell = ground.cell;
  const model::terrain::Surface here = model::terrain::interpolate(cell, north_deg, east_deg);
  if (std::isnan(here.elevation_m)) return kVoid;
  if (here.water > 0.5) return kSea;
  // The slope is a difference over two pixels or two post spacings, whichever is wider, clipped at the cell's edges.
  const double offset_north_deg = std::max(step.north_deg, 1.0 / (cell.rows() - 1));
  const double offset_east_deg = std::max(step.east_deg, 1.0 / (cell.columns() - 1));
  const double north = std::min(1.0, north_deg + offset_north_deg);
  const double south = std::max(0.0, north_deg - offset_north_deg);
  const double east = std::min(1.0, east_deg + offset_east_deg);
  const double west = std::max(0.0, east_deg - offset_east_deg);
  const auto rise = [&](double from_north, double from_east, double to_north, double to_east) {
    const double difference = model::terrain::interpolate(cell, to_north, to_east).elevation_m -
                              model::terrain::interpolate(cell, from_north, from_east).elevation_m;
    return std::isnan(difference) ? 0.0 : difference;
  };
  const double shade = light(rise(north_deg, west, north_deg, east) / ((east - west) * east_m_per_deg),
                             rise(south, east_deg, north, east_deg) / ((north - south) * geo::kMetresPerDegree));
  Colour colour = cover_of(ground, north_deg, east_deg, here.elevation_m);
  for (double& channel : colour) channel *= shade;
  return colour;
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
  const PixelStep step{(frame.north_deg - frame.south_deg) / frame.height,
                       (frame.east_deg - frame.west_deg) / frame.width};
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
    const double east_m_per_deg =
        geo::kMetresPerDegree * std::max(0.01, std::cos(latitude_deg * geo::kRadiansPerDegree));
    for (int x = left; x < frame.width; ++x) {
      const double longitude_deg = frame.west_deg + (x + 0.5) * step.east_deg;
      if (longitude_deg >= west_deg + 1.0) break;
      put(image, x, y,
          colour_at({cell, culture}, latitude_deg - cell.corner().south_deg, longitude_deg - west_deg, step,
                    east_m_per_deg));
    }
  }
}

// `yars terrain image`: writes a hill-shaded map of a directory of elevation cells as PNG.

namespace {

using namespace model::terrain;

struct TerrainImageOptions {
  std::string directory;
  std::string out;
  std::optional<double> south_deg, north_deg, west_deg, east_deg;  // nullopt: edge of the directory's coverage
  int width = 1024;
  bool culture = false;
};

MapFrame frame_of(const TerrainImageOptions& options, const DirectoryIndex& index) {
  const Coverage all = coverage_of(index);
  const double south_deg = options.south_deg.value_or(all.south_deg);
  const double north_deg = options.north_deg.value_or(all.north_deg);
  const double west_deg = options.west_deg.value_or(all.west_deg);
  const double east_deg = options.east_deg.value_or(all.east_deg);
  if (south_deg >= north_deg || west_deg >= east_deg)
    throw CommandFailed{"yars terrain image: expected south < north and west < east, found an empty region", 2};
  return map_frame(south_deg, north_deg, west_deg, east_deg, options.width);
}

bool overlap(CellCorner corner, const MapFrame& frame) {
  return corner.south_deg < frame.north_deg && corner.south_deg + 1 > frame.south_deg &&
         corner.west_deg < frame.east_deg && corner.west_deg + 1 > frame.west_deg;
}

void print_problem(const error::Error& error) {
  std::fprintf(stderr, "problem: %s\n", error.message().c_str());
}

// Culture of a cell; nullopt if the option is not set, or the file is absent or unreadable.
std::optional<Culture> culture_of(const TerrainImageOptions& options, const CellFile& file, CellCorner corner,
                                  std::size_t& failed) {
  if (!options.culture || !file.culture) return std::nullopt;
  auto culture = read_culture(*file.culture, corner);
  if (culture) return std::move(*culture);
  print_problem(culture.error());
  ++failed;
  return std::nullopt;
}

// Reads and paints the cells one by one, so that only one cell is in memory.
void draw(const TerrainImageOptions& options) {
  check_file_name("--out", options.out, {".png"});
  std::vector<std::string> unusable;
  const auto index = index_directory(options.directory, &unusable);
  if (!index) throw_failure(index.error());
  const MapFrame frame = frame_of(options, *index);
  imageio::Image image = blank_map(frame);
  for (const std::string& problem : unusable) std::fprintf(stderr, "problem: %s\n", problem.c_str());
  std::size_t failed = unusable.size();
  std::size_t painted = 0;
  for (const auto& [slot, file] : *index) {
    if (!overlap(corner_of_slot(slot), frame)) continue;
    const auto reading = read_cell(file, corner_of_slot(slot));
    if (!reading) {
      print_problem(reading.error());
      ++failed;
      continue;
    }
    const std::optional<Culture> culture = culture_of(options, file, corner_of_slot(slot), failed);
    paint_cell(reading->cell, culture ? &*culture : nullptr, frame, image);
    ++painted;
  }
  if (painted + failed == 0)
    throw_failure({options.directory, "cells in the region that is drawn",
                   "none: the folder covers " + coverage_text(*index),
                   "check --south, --north, --west and --east and their signs"});
  if (const auto written = imageio::write_png(options.out, image); !written) throw_failure(written.error());
  if (failed > 0)
    throw CommandFailed{"yars terrain image: expected all cells to be drawn, found " + std::to_string(failed) +
                            " that could not be; see the problems",
                        1};
}

}  // namespace

void add_terrain_image(databuffer::Command terrain) {
  constexpr const char* kEdge = "the edge of the cells";
  const auto options = std::make_shared<TerrainImageOptions>();
  databuffer::Command command = terrain.subcommand("image", "hill-shaded map as PNG; sea blue, voids magenta");
  add_terrain_option(command, options->directory).required();
  command.option("--out", options->out, "PNG file").value_name("FILE").required();
  command.option("--south", options->south_deg, "[deg] south edge of the map").range(-90.0, 90.0).otherwise(kEdge);
  command.option("--north", options->north_deg, "[deg] north edge").range(-90.0, 90.0).otherwise(kEdge);
  command.option("--west", options->west_deg, "[deg] west edge").range(-180.0, 180.0).otherwise(kEdge);
  command.option("--east", options->east_deg, "[deg] east edge").range(-180.0, 180.0).otherwise(kEdge);
  command.option("--width", options->width, "[pixels] width of the picture").range(16, 16384);
  command.flag("--culture", options->culture, "colour by surface material where a cell has a culture file");
  command.callback([options] { draw(*options); });
}

}  // namespace yars::tools
