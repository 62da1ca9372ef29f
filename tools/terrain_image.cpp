// `yars terrain image`: a hill-shaded map of a directory of elevation cells.
#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "model/terrain/coverage.hpp"
#include "model/terrain/culture_reader.hpp"
#include "model/terrain/culture_tile.hpp"
#include "model/terrain/directory_index.hpp"
#include "tools/command.hpp"
#include "tools/output_name.hpp"
#include "tools/terrain_commands.hpp"
#include "tools/terrain_shade.hpp"

namespace yars::tools {

namespace {

using namespace model::terrain;

struct Options {
  std::string directory;
  std::string out;
  std::optional<double> south_deg, north_deg, west_deg, east_deg;  // else what the directory covers
  int width = 1024;
  bool culture = false;
};

MapFrame frame_of(const Options& options, const DirectoryIndex& index) {
  const Coverage all = coverage_of(index);
  const double south_deg = options.south_deg.value_or(all.south_deg);
  const double north_deg = options.north_deg.value_or(all.north_deg);
  const double west_deg = options.west_deg.value_or(all.west_deg);
  const double east_deg = options.east_deg.value_or(all.east_deg);
  if (south_deg >= north_deg || west_deg >= east_deg)
    throw CommandFailed{"yars terrain image: expected south < north and west < east, found an empty region", 2};
  return map_frame(south_deg, north_deg, west_deg, east_deg, options.width);
}

bool overlap(CellPlace place, const MapFrame& frame) {
  return place.south_deg < frame.north_deg && place.south_deg + 1 > frame.south_deg &&
         place.west_deg < frame.east_deg && place.west_deg + 1 > frame.west_deg;
}

void say_problem(const failure::Error& error) {
  std::fprintf(stderr, "problem: %s\n", error.message().c_str());
}

// Nothing where it is not asked for, absent or unreadable.
std::optional<Culture> culture_of(const Options& options, const CellFile& file, CellPlace place, std::size_t& failed) {
  const auto path = options.culture ? find_culture(file.path) : std::nullopt;
  if (!path) return std::nullopt;
  auto culture = read_culture(*path, place);
  if (culture) return std::move(*culture);
  say_problem(culture.error());
  ++failed;
  return std::nullopt;
}

// Cell by cell: no more than one is in memory, whatever the region.
void draw(const Options& options) {
  check_file_name("--out", options.out, {".png"});
  std::vector<std::string> unusable;
  const auto index = index_directory(options.directory, &unusable);
  if (!index) give_up(index.error());
  const MapFrame frame = frame_of(options, *index);
  imageio::Image image = blank_map(frame);
  for (const std::string& problem : unusable) std::fprintf(stderr, "problem: %s\n", problem.c_str());
  std::size_t failed = unusable.size();
  std::size_t painted = 0;
  for (const auto& [slot, file] : *index) {
    if (!overlap(place_of_slot(slot), frame)) continue;
    const auto reading = read_cell(file, place_of_slot(slot));
    if (!reading) {
      say_problem(reading.error());
      ++failed;
      continue;
    }
    const std::optional<Culture> culture = culture_of(options, file, place_of_slot(slot), failed);
    paint_cell(reading->cell, culture ? &*culture : nullptr, frame, image);
    ++painted;
  }
  if (const auto written = imageio::write_png(options.out, image); !written) give_up(written.error());
  if (painted + failed == 0)
    give_up({options.directory, "cells in the region that is drawn", "none: it covers " + coverage_text(*index),
             "check --south, --north, --west and --east and their signs"});
  if (failed > 0)
    throw CommandFailed{"yars terrain image: expected all cells to be drawn, found " + std::to_string(failed) +
                            " that could not be; see the problems",
                        1};
}

}  // namespace

void add_terrain_image(CLI::App& terrain) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = terrain.add_subcommand("image", "hill-shaded map as PNG; sea blue, voids magenta");
  command->add_option("--terrain", options->directory, "folder with DTED or HGT cells")->required();
  command->add_option("--out", options->out, "PNG file")->required();
  command->add_option("--south", options->south_deg, "[deg] edge of the map; else what the folder covers")
      ->check(CLI::Range(-90.0, 90.0));
  command->add_option("--north", options->north_deg, "[deg]")->check(CLI::Range(-90.0, 90.0));
  command->add_option("--west", options->west_deg, "[deg]")->check(CLI::Range(-180.0, 180.0));
  command->add_option("--east", options->east_deg, "[deg]")->check(CLI::Range(-180.0, 180.0));
  command->add_option("--width", options->width, "[pixels]")->check(CLI::Range(16, 16384))->capture_default_str();
  command->add_flag("--culture", options->culture,
                    "colours by surface material where a cell has its culture beside it");
  command->callback([options] { draw(*options); });
}

}  // namespace yars::tools
