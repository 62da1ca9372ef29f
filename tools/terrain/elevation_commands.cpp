#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "lib/geo/geodesy.hpp"
#include "lib/radar/world.hpp"
#include "lib/text/plain_text.hpp"
#include "model/terrain/formats/cell_reading.hpp"
#include "model/terrain/store/cell_files.hpp"
#include "model/terrain/store/directory_store.hpp"
#include "tools/command/command.hpp"

namespace yars::tools {

// `yars terrain profile`: prints the elevation [m above mean sea level] along a geodesic as CSV.

namespace {

struct ProfileOptions {
  radar::TerrainConfiguration terrain;
  std::vector<double> from_deg;  // latitude, longitude; north and east positive
  std::vector<double> to_deg;
  double step_m = 100.0;
  bool json = false;
};

void print_sentences(const model::terrain::FileSentences& sentences) {
  for (const std::string& problem : sentences.problems) std::fprintf(stderr, "problem: %s\n", problem.c_str());
  for (const std::string& note : sentences.notes) std::fprintf(stderr, "note: %s\n", note.c_str());
}

// Errors: throws CommandFailed if there is a problem.
void fail_if_damaged(const std::string& command, const model::terrain::FileSentences& found) {
  if (!found.problems.empty())
    throw CommandFailed{"yars terrain " + command + ": expected undamaged files, found " +
                            text::counted(found.problems.size(), "problem") + "; see above",
                        1};
}

// True if latitude is in [-90, 90] and longitude in [-360, 360]. False for NaN.
bool on_the_earth(const std::vector<double>& position_deg) {
  return std::abs(position_deg[0]) <= 90.0 && std::abs(position_deg[1]) <= 360.0;
}

// Area that the cells of a folder cover. Without a folder it is the whole earth, which the built-in hills cover.
class CoveredArea {
 public:
  explicit CoveredArea(const std::string& directory) {
    if (directory.empty()) return;
    if (auto index = model::terrain::index_directory(directory)) index_ = std::move(*index);
  }
  // The position, in the cell of which it is the edge.
  geo::GeoPoint placed(geo::GeoPoint position) const { return within_index(index_, position); }
  bool contains(geo::GeoPoint position) const {
    return index_.empty() || index_.contains(slot_of(model::terrain::cell_containing(position)));
  }
  std::string text() const { return coverage_text(index_); }

 private:
  model::terrain::DirectoryIndex index_;
};

// Warns on standard error that `outside` of `samples` samples lie in no cell. Their elevation is 0 (sea).
// Errors: throws CommandFailed if no sample has a cell.
void report_outside(const ProfileOptions& options, const CoveredArea& covered, long outside, long samples) {
  const error::Error error{options.terrain.directory, "cells along the geodesic",
                           "none at " + std::to_string(outside) + " of " + std::to_string(samples) +
                               " samples: the folder covers " + covered.text(),
                           "samples without a cell count as sea; check --from and --to and their signs"};
  if (outside == samples) throw_failure(error);
  std::fprintf(stderr, "yars terrain profile: %s\n", error.message().c_str());
}

struct ProfileSample {
  double distance_m = 0.0;
  geo::GeoPoint position;
  double elevation_m = 0.0;  // [m MSL] NaN: void

  nlohmann::ordered_json json() const {
    return {{"distance_m", distance_m},
            {"latitude_deg", position.latitude_deg},
            {"longitude_deg", position.longitude_deg},
            {"elevation_m",
             std::isnan(elevation_m) ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(elevation_m)}};
  }

  // The elevation of a void is an empty field.
  void print() const {
    std::printf("%.1f,%.7f,%.7f,", distance_m, position.latitude_deg, position.longitude_deg);
    if (std::isnan(elevation_m))
      std::printf("\n");
    else
      std::printf("%.2f\n", elevation_m);
  }
};

void profile(const ProfileOptions& options) {
  if (!on_the_earth(options.from_deg) || !on_the_earth(options.to_deg))
    throw_failure({"terrain profile", "latitudes in [-90, 90] and longitudes in [-360, 360] degrees", "a value outside",
                   "check --from and --to", error::ErrorCode::argument});
  auto store = model::terrain::open_terrain(options.terrain);
  if (!store) throw_failure(store.error());
  const geo::GeoPoint from{options.from_deg[0], options.from_deg[1]};
  const geo::GeodesicInverse geodesic = geo::geodesic_inverse(from, {options.to_deg[0], options.to_deg[1]});
  const geo::GeodesicRay ray(from, geodesic.azimuth_at_start);
  const double length_m = geodesic.distance.metres();
  const auto steps = static_cast<long>(std::ceil(length_m / options.step_m));
  const CoveredArea covered(options.terrain.directory);
  long outside = 0;
  nlohmann::ordered_json samples = nlohmann::ordered_json::array();
  if (!options.json) std::printf("distance_m,latitude_deg,longitude_deg,elevation_m\n");
  for (long step = 0; step <= steps; ++step) {
    const double distance_m = std::min(length_m, static_cast<double>(step) * options.step_m);
    const geo::GeoPoint position = ray.position(geo::Length::metres(distance_m));
    const geo::GeoPoint ground = covered.placed(position);
    if (!covered.contains(ground)) ++outside;
    const ProfileSample sample{distance_m, position, (*store)->prepare({ground, 0.0})->elevation_m(ground)};
    if (options.json)
      samples.push_back(sample.json());
    else
      sample.print();
  }
  const model::terrain::FileSentences found{(*store)->take_problems(), (*store)->take_notes()};
  if (options.json)
    print_json({{"samples", std::move(samples)}, {"problems", found.problems}, {"notes", found.notes}},
               JsonLines::many);
  std::fflush(stdout);
  print_sentences(found);
  if (outside > 0) report_outside(options, covered, outside, steps + 1);
  fail_if_damaged("profile", found);
}

}  // namespace

void add_terrain_profile(runtime::Command terrain) {
  const auto options = std::make_shared<ProfileOptions>();
  runtime::Command command = terrain.subcommand("profile", "elevation along the geodesic between two points, as CSV");
  add_terrain_option(command, options->terrain.directory).otherwise("the built-in hills");
  command.option("--from", options->from_deg, "[deg] latitude and longitude").values(2).required();
  command.option("--to", options->to_deg, "[deg] latitude and longitude").values(2).required();
  command.option("--step", options->step_m, "[m] between samples").range(0.1, 1e6);
  add_json_flag(command, options->json);
  command.callback([options] { profile(*options); });
}

// `yars terrain dump`: prints the posts [m above mean sea level] of one cell as CSV.

namespace {

using namespace model::terrain;

struct DumpOptions {
  std::string directory;
  int south_deg = 0;
  int west_deg = 0;
};

void dump(const DumpOptions& options) {
  const auto index = index_directory(options.directory);
  if (!index) throw_failure(index.error());
  const CellCorner corner{options.south_deg, options.west_deg};
  const auto file = index->find(slot_of(corner));
  if (file == index->end())
    throw_failure({options.directory, "the cell that --south and --west name",
                   "none: the folder covers " + coverage_text(*index), "check the numbers and their signs"});
  const auto reading = read_cell(file->second, corner);
  if (!reading) throw_failure(reading.error());
  ReadingNotes notes;
  const FileSentences found = notes.take_new(file->second.path, *reading);
  print_sentences(found);
  const Cell& cell = reading->cell;
  const int decimals = cell.unit_m() < 1.0 ? 1 : 0;
  std::printf("latitude_deg,longitude_deg,elevation_m\n");
  for (int row = 0; row < cell.rows(); ++row)
    for (int column = 0; column < cell.columns(); ++column) {
      std::printf("%.7f,%.7f,", corner.south_deg + static_cast<double>(row) / (cell.rows() - 1),
                  corner.west_deg + static_cast<double>(column) / (cell.columns() - 1));
      // The elevation of a void is an empty field.
      if (cell.post(row, column) == kVoidPost)
        std::printf("\n");
      else
        std::printf("%.*f\n", decimals, cell.post(row, column) * cell.unit_m());
    }
  std::fflush(stdout);
  fail_if_damaged("dump", found);
}

}  // namespace

void add_terrain_dump(runtime::Command terrain) {
  const auto options = std::make_shared<DumpOptions>();
  runtime::Command command =
      terrain.subcommand("dump", "posts of one cell as CSV, row by row from the south-west corner");
  add_terrain_option(command, options->directory).required();
  command.option("--south", options->south_deg, "[deg] the cell's south edge").range(-90, 89).required();
  command.option("--west", options->west_deg, "[deg] the cell's west edge").range(-180, 179).required();
  command.callback([options] { dump(*options); });
}

}  // namespace yars::tools
