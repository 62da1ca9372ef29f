// `yars terrain info`: what a directory of elevation cells holds.
#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "model/terrain/directory_index.hpp"
#include "tools/command.hpp"
#include "tools/terrain_commands.hpp"

namespace yars::tools {

namespace {

using namespace model::terrain;

struct Totals {
  std::size_t cells = 0;
  std::size_t posts = 0;
  std::size_t voids = 0;
  int south_deg = 90, north_deg = -90, west_deg = 180, east_deg = -180;
  int lowest_m = 32767, highest_m = -32768;

  void add(const Cell& cell) {
    ++cells;
    posts += cell.post_count();
    voids += cell.voids();
    south_deg = std::min(south_deg, cell.place().south_deg);
    north_deg = std::max(north_deg, cell.place().south_deg + 1);
    west_deg = std::min(west_deg, cell.place().west_deg);
    east_deg = std::max(east_deg, cell.place().west_deg + 1);
    if (cell.voids() == cell.post_count()) return;
    lowest_m = std::min<int>(lowest_m, cell.lowest_m());
    highest_m = std::max<int>(highest_m, cell.highest_m());
  }
};

void print_cell(const Cell& cell, const CellFile& file) {
  const double percent = 100.0 / static_cast<double>(cell.post_count());
  std::printf("%5d %6d %6d x %-5d %6d %6d %8zu %7.2f  %s\n", cell.place().south_deg, cell.place().west_deg,
              cell.columns(), cell.rows(), cell.lowest_m(), cell.highest_m(), cell.voids(),
              percent * static_cast<double>(cell.sea_posts()), file.path.c_str());
}

void info(const std::string& directory) {
  std::vector<std::string> problems;
  const auto index = index_directory(directory, &problems);
  if (!index) give_up(index.error());
  Totals totals;
  std::printf("south   west  columns x rows  min_m  max_m    voids   sea_%%  file\n");
  for (const auto& [slot, file] : *index) {
    const auto reading = read_cell(file, place_of_slot(slot));
    if (!reading) {
      problems.push_back(reading.error().message());
      continue;
    }
    for (const std::string& warning : reading->warnings) problems.push_back(file.path.string() + ": " + warning);
    totals.add(reading->cell);
    print_cell(reading->cell, file);
  }
  if (totals.cells > 0)
    std::printf("%zu cells, latitude %d to %d, longitude %d to %d, %d to %d m, %zu of %zu posts void\n", totals.cells,
                totals.south_deg, totals.north_deg, totals.west_deg, totals.east_deg, totals.lowest_m, totals.highest_m,
                totals.voids, totals.posts);
  for (const std::string& problem : problems) std::printf("problem: %s\n", problem.c_str());
}

}  // namespace

void add_terrain_info(CLI::App& terrain) {
  const auto directory = std::make_shared<std::string>();
  CLI::App* command = terrain.add_subcommand("info", "cells of a directory: posts, heights, voids, problems");
  command->add_option("--terrain,directory", *directory, "folder with DTED or HGT cells")->required();
  command->callback([directory] { info(*directory); });
}

}  // namespace yars::tools
