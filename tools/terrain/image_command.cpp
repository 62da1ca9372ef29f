// `yars terrain image`: writes a hill-shaded map of a directory of elevation cells as PNG.

#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lib/imageio/png.hpp"
#include "lib/text/plain_text.hpp"
#include "model/terrain/picture/hill_shade.hpp"
#include "model/terrain/store/cell_files.hpp"
#include "tools/command/command.hpp"

namespace yars::tools {

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
  FileSentences unused;
  const auto index = index_directory(options.directory, &unused);
  if (!index) throw_failure(index.error());
  const MapFrame frame = frame_of(options, *index);
  imageio::Image image = blank_map(frame);
  std::size_t failed = unused.problems.size();
  AllReadingNotes notes;
  notes.add(std::move(unused));
  std::size_t painted = 0, damaged = 0;
  for (const auto& [slot, file] : *index) {
    if (!overlap(corner_of_slot(slot), frame)) continue;
    const auto reading = read_cell(file, corner_of_slot(slot));
    if (!reading) {
      print_problem(reading.error());
      ++failed;
      continue;
    }
    notes.add(file.path, *reading);
    if (reading->has_problem()) ++damaged;
    const std::optional<Culture> culture = culture_of(options, file, corner_of_slot(slot), failed);
    paint_cell(reading->cell, culture ? &*culture : nullptr, frame, image);
    ++painted;
  }
  for (const std::string& problem : notes.problems()) std::fprintf(stderr, "problem: %s\n", problem.c_str());
  for (const std::string& note : notes.notes()) std::fprintf(stderr, "note: %s\n", note.c_str());
  if (painted + failed == 0)
    throw_failure({options.directory, "cells in the region that is drawn",
                   "none: the folder covers " + coverage_text(*index),
                   "check --south, --north, --west and --east and their signs"});
  if (const auto written = imageio::write_png(options.out, image); !written) throw_failure(written.error());
  if (failed > 0)
    throw CommandFailed{"yars terrain image: expected all cells to be drawn, found " + std::to_string(failed) +
                            " that could not be; see the problems",
                        1};
  if (damaged > 0)
    throw CommandFailed{"yars terrain image: expected cells without damage, found " + text::counted(damaged, "cell") +
                            " with it; see the problems",
                        1};
}

}  // namespace

void add_terrain_image(runtime::Command terrain) {
  constexpr const char* kEdge = "the edge of the cells";
  const auto options = std::make_shared<TerrainImageOptions>();
  runtime::Command command = terrain.subcommand("image", "hill-shaded map as PNG; sea blue, voids magenta");
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
