#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "lib/text/plain_text.hpp"
#include "model/terrain/formats/cell_reading.hpp"
#include "model/terrain/formats/culture.hpp"
#include "model/terrain/gdal/raster_survey.hpp"
#include "model/terrain/store/cell_files.hpp"
#include "tools/command/command.hpp"

namespace yars::tools {

void add_terrain_command(runtime::Command app, const CommonOptions& /*common*/) {
  runtime::Command terrain = app.subcommand(
      "terrain", "elevation databases: generate, info, image, profile, dump, reduce, convert, pack, cover");
  terrain.require_subcommand();
  add_terrain_generate(terrain);
  add_terrain_info(terrain);
  add_terrain_image(terrain);
  add_terrain_profile(terrain);
  add_terrain_dump(terrain);
  add_terrain_reduce(terrain);
  add_terrain_convert(terrain);
  add_terrain_pack(terrain);
  add_terrain_cover(terrain);
}

// `yars terrain info`: lists the cells of a directory with their posts, heights, voids and problems.

namespace {

using namespace model::terrain;
using nlohmann::ordered_json;

// Statistics of the posts of one cell. `sea`: number of posts at exactly 0 m. The heights [m MSL] are meaningless if
// all posts are void.
struct CellStatistics {
  int columns = 0, rows = 0;
  std::size_t posts = 0, voids = 0, sea = 0;
  double lowest_m = 0.0, highest_m = 0.0;
};

CellStatistics statistics_of(const Cell& cell) {
  return {cell.columns(),   cell.rows(),     cell.post_count(), cell.voids(),
          cell.sea_posts(), cell.lowest_m(), cell.highest_m()};
}

CellStatistics statistics_of(const gdal::RasterCellStatistics& cell) {
  const int rows = cell.columns == 0 ? 0 : static_cast<int>(cell.posts / static_cast<std::size_t>(cell.columns));
  return {cell.columns,
          rows,
          cell.posts,
          cell.voids,
          cell.sea,
          static_cast<double>(cell.lowest_m),
          static_cast<double>(cell.highest_m)};
}

// Height [m] as text with one decimal, or without a decimal if it is within 0.05 m of a whole number.
std::string height_text(double height_m) {
  std::array<char, 32> text{};
  const bool whole = std::abs(height_m - std::round(height_m)) < 0.05;
  std::snprintf(text.data(), text.size(), "%.*f", whole ? 0 : 1, height_m);
  return text.data();
}

struct Totals {
  std::size_t cells = 0;
  std::size_t posts = 0;
  std::size_t voids = 0;
  int south_deg = 90, north_deg = -90, west_deg = 180, east_deg = -180;
  double lowest_m = std::numeric_limits<double>::infinity();
  double highest_m = -std::numeric_limits<double>::infinity();

  void add(CellCorner corner, const CellStatistics& cell) {
    ++cells;
    posts += cell.posts;
    voids += cell.voids;
    south_deg = std::min(south_deg, corner.south_deg);
    north_deg = std::max(north_deg, corner.south_deg + 1);
    west_deg = std::min(west_deg, corner.west_deg);
    east_deg = std::max(east_deg, corner.west_deg + 1);
    if (cell.voids == cell.posts) return;
    lowest_m = std::min(lowest_m, cell.lowest_m);
    highest_m = std::max(highest_m, cell.highest_m);
  }

  // Null for what no post gives.
  nlohmann::ordered_json json() const {
    const bool has_heights = voids < posts;
    return {{"cells", cells},
            {"latitude_deg", cells > 0 ? ordered_json{south_deg, north_deg} : ordered_json(nullptr)},
            {"longitude_deg", cells > 0 ? ordered_json{west_deg, east_deg} : ordered_json(nullptr)},
            {"lowest_m", has_heights ? ordered_json(lowest_m) : ordered_json(nullptr)},
            {"highest_m", has_heights ? ordered_json(highest_m) : ordered_json(nullptr)},
            {"posts", posts},
            {"voids", voids}};
  }

  void print() const {
    const std::string heights =
        voids == posts ? "no heights" : height_text(lowest_m) + " to " + height_text(highest_m) + " m";
    std::printf("%s, latitude %d to %d, longitude %d to %d, %s, %zu of %zu posts void\n",
                text::counted(cells, "cell").c_str(), south_deg, north_deg, west_deg, east_deg, heights.c_str(), voids,
                posts);
  }
};

// The other rasters that are parts of a cell as its file is, without those that only have posts on its edges.
std::vector<std::string> others_of(const CellFile& file) {
  std::vector<std::string> others;
  if (file.is_part())
    for (const std::filesystem::path& other : file.others) others.push_back(other.string());
  return others;
}

void print_cell(CellCorner corner, const CellStatistics& cell, const CellFile& file) {
  const bool empty = cell.voids == cell.posts;
  const std::size_t others = others_of(file).size();
  std::printf("%5d %6d %6d x %-5d %7s %7s %8zu %7.2f  %s%s\n", corner.south_deg, corner.west_deg, cell.columns,
              cell.rows, empty ? "void" : height_text(cell.lowest_m).c_str(),
              empty ? "void" : height_text(cell.highest_m).c_str(), cell.voids,
              100.0 * static_cast<double>(cell.sea) / static_cast<double>(std::max<std::size_t>(1, cell.posts)),
              file.path.c_str(), others == 0 ? "" : (" and " + text::counted(others, "other")).c_str());
}

nlohmann::ordered_json cell_json(CellCorner corner, const CellStatistics& cell, const CellFile& file) {
  const bool empty = cell.voids == cell.posts;
  return {{"south_deg", corner.south_deg},
          {"west_deg", corner.west_deg},
          {"columns", cell.columns},
          {"rows", cell.rows},
          {"lowest_m", empty ? ordered_json(nullptr) : ordered_json(cell.lowest_m)},
          {"highest_m", empty ? ordered_json(nullptr) : ordered_json(cell.highest_m)},
          {"voids", cell.voids},
          {"sea_posts", cell.sea},
          {"file", file.path.string()},
          {"others", others_of(file)}};
}

// Reads all cells of a directory and prints one line for each, then totals and problems; or all as one JSON object.
// Errors: throws CommandFailed if a file is damaged or cannot be used.
class Inspection {
 public:
  Inspection(const std::string& directory, bool json) : json_(json) {
    FileSentences unused;
    auto index = index_directory(directory, &unused);
    if (!index) throw_failure(index.error());
    index_ = std::move(*index);
    failed_ = unused.problems.size();
    notes_.add(std::move(unused));
  }

  void run() {
    survey_rasters();
    if (!json_) std::printf("south   west  columns x rows   min_m   max_m    voids   sea_%%  file\n");
    for (const auto& [slot, file] : index_) inspect_cell(slot, file);
    publish_progress("");
    if (json_) {
      print_json(
          {{"cells", cells_}, {"total", totals_.json()}, {"problems", notes_.problems()}, {"notes", notes_.notes()}},
          JsonLines::many);
    } else {
      if (totals_.cells > 0) totals_.print();
      for (const std::string& problem : notes_.problems()) std::printf("problem: %s\n", problem.c_str());
      for (const std::string& note : notes_.notes()) std::printf("note: %s\n", note.c_str());
    }
    std::fflush(stdout);
    if (failed_ > 0)
      throw CommandFailed{"yars terrain info: expected files without damage, found " + std::to_string(failed_) +
                              " cells or files that cannot be used or are damaged; see the problems",
                          1};
  }

 private:
  // Reads each raster file once instead of once per cell, because a large raster can hold thousands of cells.
  void survey_rasters() {
    std::set<std::filesystem::path> rasters;
    for (const auto& [slot, file] : index_)
      if (file.format == CellFormat::raster && !file.is_part()) rasters.insert(file.path);
    for (const auto& path : rasters) {
      const auto progress = [&](double fraction) {
        publish_progress(path.string() + "  " + std::to_string(std::lround(100 * fraction)) + " %");
      };
      const auto found = gdal::survey_raster(path, progress);
      if (!found) {
        unreadable_[path] = found.error().message();
        continue;
      }
      if (!*found) continue;
      notes_.add_file(path, (*found)->notes, (*found)->impossible);
      if ((*found)->impossible > 0) ++failed_;
      // A cell that may hold the floor of the sea beside land is read as a cell, which finds that out.
      for (const gdal::RasterCellStatistics& cell : (*found)->cells)
        if (!(cell.lowest_m < kLowLand_m && cell.highest_m > 0.0F))
          surveyed_[{path, slot_of({cell.south_deg, cell.west_deg})}] = statistics_of(cell);
    }
  }

  void inspect_cell(std::size_t slot, const CellFile& file) {
    const CellCorner corner = corner_of_slot(slot);
    if (const auto known = surveyed_.find({file.path, slot}); known != surveyed_.end() && !file.is_part())
      return add_cell(corner, known->second, file);
    if (const auto unreadable = unreadable_.find(file.path); unreadable != unreadable_.end()) {
      if (reported_.insert(file.path).second) notes_.add_problem(unreadable->second);
      ++failed_;
      return;
    }
    const auto reading = read_cell(file, corner);
    if (!reading) {
      notes_.add_problem(reading.error().message());
      ++failed_;
      return;
    }
    if (reading->has_problem()) ++failed_;
    notes_.add(file.path, *reading);
    add_cell(corner, statistics_of(reading->cell), file);
    // On a terminal, the printed lines already show the progress.
    if (json_ || isatty(STDOUT_FILENO) == 0)
      publish_progress(std::to_string(totals_.cells) + " of " + std::to_string(index_.size()) + " cells");
  }

  void add_cell(CellCorner corner, const CellStatistics& statistics, const CellFile& file) {
    publish_progress("");
    totals_.add(corner, statistics);
    if (json_)
      cells_.push_back(cell_json(corner, statistics, file));
    else
      print_cell(corner, statistics, file);
    check_culture(corner, file);
  }

  void check_culture(CellCorner corner, const CellFile& file) {
    if (!file.culture || !checked_cultures_.insert(*file.culture).second) return;
    const auto culture = read_culture(*file.culture, corner);
    if (culture) return;
    notes_.add_problem(culture.error().message());
    ++failed_;
  }

  void publish_progress(const std::string& text) { progress_.show(text); }

  bool json_;
  nlohmann::ordered_json cells_ = nlohmann::ordered_json::array();  // for --json
  DirectoryIndex index_;
  AllReadingNotes notes_;
  Totals totals_;
  std::map<std::pair<std::filesystem::path, std::size_t>, CellStatistics> surveyed_;
  std::map<std::filesystem::path, std::string> unreadable_;
  std::set<std::filesystem::path> reported_;
  std::set<std::filesystem::path> checked_cultures_;
  std::size_t failed_ = 0;
  ProgressLine progress_;
};

}  // namespace

void add_terrain_info(runtime::Command terrain) {
  struct InfoOptions {
    std::string directory;
    bool json = false;
  };
  const auto options = std::make_shared<InfoOptions>();
  runtime::Command command = terrain.subcommand("info", "cells of a directory: posts, heights, voids, problems");
  command.option("--terrain,DIR", options->directory, "folder of elevation cells: DTED, HGT, DED, packs, rasters")
      .value_name("DIR")
      .required()
      .in_user_file();
  add_json_flag(command, options->json);
  command.callback([options] { Inspection(options->directory, options->json).run(); });
}

}  // namespace yars::tools
