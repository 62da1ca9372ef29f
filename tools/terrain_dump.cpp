// `yars terrain dump`: the posts of one cell, as CSV.
#include <cstdio>
#include <memory>
#include <string>

#include "model/terrain/coverage.hpp"
#include "model/terrain/directory_index.hpp"
#include "model/terrain/reading_notes.hpp"
#include "tools/command.hpp"
#include "tools/terrain_commands.hpp"

namespace yars::tools {

namespace {

using namespace model::terrain;

struct DumpOptions {
  std::string directory;
  int south_deg = 0;
  int west_deg = 0;
};

void dump(const DumpOptions& options) {
  const auto index = index_directory(options.directory);
  if (!index) give_up(index.error());
  const CellPlace place{options.south_deg, options.west_deg};
  const auto file = index->find(slot_of(place));
  if (file == index->end())
    give_up({options.directory, "the cell that --south and --west name", "none: it covers " + coverage_text(*index),
             "check the numbers and their signs"});
  const auto reading = read_cell(file->second, place);
  if (!reading) give_up(reading.error());
  ReadingNotes notes;
  for (const std::string& sentence : notes.heard(file->second.path, *reading))
    std::fprintf(stderr, "problem: %s\n", sentence.c_str());
  const Cell& cell = reading->cell;
  const int decimals = cell.unit_m() < 1.0 ? 1 : 0;
  std::printf("latitude_deg,longitude_deg,elevation_m\n");
  for (int row = 0; row < cell.rows(); ++row)
    for (int column = 0; column < cell.columns(); ++column) {
      std::printf("%.7f,%.7f,", place.south_deg + static_cast<double>(row) / (cell.rows() - 1),
                  place.west_deg + static_cast<double>(column) / (cell.columns() - 1));
      // A void is an empty field.
      if (cell.post(row, column) == kVoidPost)
        std::printf("\n");
      else
        std::printf("%.*f\n", decimals, cell.post(row, column) * cell.unit_m());
    }
}

}  // namespace

void add_terrain_dump(CLI::App& terrain) {
  const auto options = std::make_shared<DumpOptions>();
  CLI::App* command = terrain.add_subcommand("dump", "posts of one cell as CSV, from the south-west, row by row");
  command->add_option("--terrain", options->directory, "folder with DTED or HGT cells")->required();
  command->add_option("--south", options->south_deg, "[deg] the cell's south edge")
      ->check(CLI::Range(-90, 89))
      ->required();
  command->add_option("--west", options->west_deg, "[deg] the cell's west edge")
      ->check(CLI::Range(-180, 179))
      ->required();
  command->callback([options] { dump(*options); });
}

}  // namespace yars::tools
