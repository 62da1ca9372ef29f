// `yars terrain generate`: a made-up landscape as a DTED tree.
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "model/terrain/dted_format.hpp"
#include "model/terrain/dted_writer.hpp"
#include "model/terrain/landscape.hpp"
#include "tools/command.hpp"
#include "tools/terrain_commands.hpp"

namespace yars::tools {

namespace {

using model::terrain::CellPlace;

struct Options {
  using Default = model::terrain::DefaultLandscape;
  std::string out;
  int south_deg = Default::kSouthDeg;
  int west_deg = Default::kWestDeg;
  int cells_latitude = Default::kCellsNorth;
  int cells_longitude = Default::kCellsEast;
  int level = 1;
  std::uint64_t seed = Default::kSeed;
};

void generate(const Options& options) {
  const model::terrain::Landscape landscape(options.seed);
  const int cells = options.cells_latitude * options.cells_longitude;
  int done = 0;
  for (int row = 0; row < options.cells_latitude; ++row)
    for (int column = 0; column < options.cells_longitude; ++column) {
      const int west_deg = (options.west_deg + column + 180) % model::terrain::kCellColumns - 180;
      const CellPlace place{options.south_deg + row, west_deg};
      const model::terrain::Cell cell = landscape.cell(place, model::terrain::dted::kPostsOfLevel[options.level],
                                                       model::terrain::dted_columns(place, options.level));
      const auto path = model::terrain::write_dted(options.out, cell, options.level);
      if (!path) give_up(path.error());
      std::printf("%2d/%d  %s  %d to %d m\n", ++done, cells, path->c_str(), cell.lowest_m(), cell.highest_m());
      std::fflush(stdout);
    }
}

}  // namespace

void add_terrain_generate(CLI::App& terrain) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = terrain.add_subcommand("generate", "a made-up landscape with coasts and ranges, as DTED cells");
  command->add_option("--out", options->out, "folder for the cells")->required();
  command->add_option("--south", options->south_deg, "[deg] south edge")
      ->check(CLI::Range(-90, 89))
      ->capture_default_str();
  command->add_option("--west", options->west_deg, "[deg] west edge")
      ->check(CLI::Range(-180, 179))
      ->capture_default_str();
  command->add_option("--cells-lat", options->cells_latitude, "cells northward")
      ->check(CLI::Range(1, 180))
      ->capture_default_str();
  command->add_option("--cells-lon", options->cells_longitude, "cells eastward")
      ->check(CLI::Range(1, 360))
      ->capture_default_str();
  command->add_option("--level", options->level, "DTED level")->check(CLI::Range(0, 1))->capture_default_str();
  command->add_option("--seed", options->seed, "another seed, another earth")->capture_default_str();
  command->callback([options] {
    if (options->south_deg + options->cells_latitude > 90)
      throw CommandFailed{"--cells-lat: expected an area that ends at the north pole, found one beyond it", 2};
    generate(*options);
  });
}

}  // namespace yars::tools
