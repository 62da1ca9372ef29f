#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <system_error>
#include <vector>

#include "lib/error/error.hpp"
#include "lib/text/plain_text.hpp"
#include "model/terrain/formats/cell.hpp"
#include "model/terrain/formats/cell_reading.hpp"
#include "model/terrain/formats/culture.hpp"
#include "model/terrain/formats/dted.hpp"
#include "model/terrain/formats/hgt.hpp"
#include "model/terrain/formats/pack.hpp"
#include "model/terrain/sampling/cell_view.hpp"
#include "model/terrain/store/cell_files.hpp"
#include "tools/command/command.hpp"
#include "tools/terrain/terrain_folders.hpp"

namespace yars::tools {

// Output format and grid of elevation cells.
struct TerrainOutput {
  std::string format = "dted";  // "dted", "hgt" or "jp2" (packed cells)
  // DTED level of the output's grid, 0 to 2. nullopt: the finest level that has no more rows than the cell, or the
  // format's coarsest if there is none; for jp2 the grid of the cell. HGT has the rows of level 1 or 2 (0 counts as 1),
  // and as many columns as rows at all latitudes. DTED has fewer columns at high latitudes.
  std::optional<int> level;
};

// Path of a cell's file relative to the output folder.
std::string output_name(const TerrainOutput& output, model::terrain::CellCorner corner,
                        const model::terrain::Cell& cell);

// Resamples the cell to the output's grid (resample() in cell_view.hpp) and writes the result below `tree`. Returns the
// path of the written file.
error::Expected<std::filesystem::path> write_output(const TerrainOutput& output, const std::filesystem::path& tree,
                                                    const model::terrain::Cell& cell);

namespace {

using namespace model::terrain;

int level_of(const TerrainOutput& output, const Cell& cell) {
  const int min_level = output.format == "hgt" ? 1 : 0;
  if (output.level) return std::max(min_level, *output.level);
  int level = min_level;
  while (level < 2 && dted::kPostsOfLevel[level + 1] <= cell.rows()) ++level;
  return level;
}

}  // namespace

std::string output_name(const TerrainOutput& output, CellCorner corner, const Cell& cell) {
  if (output.format == "jp2") return pack_name(corner);
  return output.format == "hgt" ? hgt_name(corner) : dted_name(corner, level_of(output, cell));
}

error::Expected<std::filesystem::path> write_output(const TerrainOutput& output, const std::filesystem::path& tree,
                                                    const Cell& cell) {
  if (output.format == "jp2" && !output.level) return write_pack(tree, cell);
  const int level = level_of(output, cell);
  const int rows = dted::kPostsOfLevel[level];
  if (output.format == "hgt") return write_hgt(tree, in_whole_metres(resample(cell, rows, rows)));
  const Cell on_level = resample(cell, rows, dted_columns(cell.corner(), level));
  return output.format == "jp2" ? write_pack(tree, on_level) : write_dted(tree, in_whole_metres(on_level), level);
}

// Batch conversion of elevation cells: reads the cells of a folder or file and writes each cell below the folder `out`.
// Copies the culture file of each cell. If the input has none, an older culture file in the output is removed. Copies
// the files of the folder's scenes. Prints the total sizes; on a terminal also a line for each written cell. The input
// is never overwritten.
// Errors: a cell that cannot be read or written, or has no height, is reported as a problem. A cell with an unreadable
// culture is not written. The batch continues; the command fails at the end.

struct TerrainBatch {
  std::string command;  // subcommand, for error messages
  std::string in;
  std::string out;
  bool json = false;
  int reduction = 0;  // every 2^reduction-th post is written, with the mean height of the posts around it
  // `name` returns the path of a cell's file relative to `out`. `write` writes the cell to this path below `tree`.
  std::function<std::string(model::terrain::CellCorner, const model::terrain::Cell&)> name;
  std::function<error::Expected<std::filesystem::path>(const std::filesystem::path& tree, const model::terrain::Cell&)>
      write;
  // Minimum number of rows of the written culture. The culture's rows are halved as often as this number allows. Empty:
  // culture is not reduced.
  std::function<int(const model::terrain::Cell&)> culture_posts = {};
};

// Errors: throws CommandFailed.
void run_terrain_batch(const TerrainBatch& batch);

namespace {

using namespace model::terrain;

constexpr double kMegabyte = 1e6;

std::uintmax_t bytes_of(const std::filesystem::path& path) {
  std::error_code code;
  const std::uintmax_t bytes = std::filesystem::file_size(path, code);
  return code ? 0 : bytes;
}

// Size of a cell's files [bytes]: the cell, the .side file of a packed cell, and the culture.
std::uintmax_t bytes_on_disk(const std::filesystem::path& path, const std::optional<std::filesystem::path>& culture) {
  const std::uintmax_t side_bytes =
      path.extension() == ".jp2" ? bytes_of(std::filesystem::path(path).replace_extension(".side")) : 0;
  return bytes_of(path) + side_bytes + (culture ? bytes_of(*culture) : 0);
}

// Culture reduced by the largest power of two that leaves at least `posts` rows.
Culture thinned(const Culture& culture, int posts) {
  int reduction = 0;
  while ((culture.rows() - 1) >> (reduction + 1) >= posts - 1) ++reduction;
  return culture.reduced(reduction);
}

// Copies the culture file of the input to the culture path of `target`, the elevation file to be written. Reduces the
// culture if the batch has culture_posts. If the input has no culture file, removes an older culture of `target`.
error::Expected<void> copy_culture(const TerrainBatch& batch, const CellFile& file, const Cell& cell,
                                   const std::filesystem::path& target) {
  if (!file.culture) return remove_culture(target);
  const auto culture = read_culture(*file.culture, cell.corner());
  if (!culture) return tl::unexpected(culture.error());
  const std::filesystem::path to = culture_path(target);
  std::error_code code;
  if (std::filesystem::equivalent(*file.culture, to, code)) return {};
  return write_culture(to, batch.culture_posts ? thinned(*culture, batch.culture_posts(cell)) : *culture);
}

error::Expected<DirectoryIndex> index_of(const TerrainBatch& batch, FileSentences& unused) {
  if (!std::filesystem::is_directory(batch.in)) return index_file(batch.in);
  if (lies_in(batch.out, batch.in))
    return tl::unexpected(
        error::Error{"yars terrain " + batch.command, "--out outside of --in", batch.out + " inside of " + batch.in,
                     "give another folder: the input is never overwritten", error::ErrorCode::argument});
  return index_directory(batch.in, &unused);
}

error::Expected<std::filesystem::path> convert_cell(const TerrainBatch& batch, const CellFile& file, CellCorner corner,
                                                    AllReadingNotes& notes, std::size_t& left_out) {
  const auto reading = read_cell(file, corner, batch.reduction);
  if (!reading) return tl::unexpected(reading.error());
  notes.add(file.path, *reading);
  const bool empty = reading->cell.voids() == reading->cell.post_count();
  if (empty || reading->has_problem()) ++left_out;
  if (empty)
    notes.add_problem(error::Error{file.path.string(), "a cell with heights",
                                   text::counted(reading->cell.post_count(), "post") + " without any",
                                   "see whether its no-data value is right; the cell is written as void"}
                          .message());
  const std::filesystem::path target = std::filesystem::path(batch.out) / batch.name(corner, reading->cell);
  std::error_code code;
  if (std::filesystem::equivalent(target, file.path, code))
    return error::fail(target.string(), "an output that is not the input", "the input itself", "give another --out");
  // The culture is written before the cell, so that no new cell is left with an older culture or without its own.
  if (const auto copied = copy_culture(batch, file, reading->cell, target); !copied)
    return tl::unexpected(copied.error());
  return batch.write(batch.out, reading->cell);
}

}  // namespace

namespace {

// Result of a batch.
struct BatchTotals {
  std::size_t cells = 0;        // of the input
  std::size_t failed = 0;       // cells that were not written
  std::size_t scene_files = 0;  // copied
  std::uintmax_t bytes_in = 0;
  std::uintmax_t bytes_out = 0;
  std::vector<std::string> files;  // written

  double ratio() const { return bytes_out == 0 ? 0.0 : static_cast<double>(bytes_in) / static_cast<double>(bytes_out); }
};

std::string megabytes(std::uintmax_t bytes) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.3f MB", static_cast<double>(bytes) / kMegabyte);
  return text.data();
}

void print_totals(const BatchTotals& totals, const AllReadingNotes& notes, bool json) {
  for (const std::string& problem : notes.problems()) std::fprintf(stderr, "problem: %s\n", problem.c_str());
  for (const std::string& note : notes.notes()) std::fprintf(stderr, "note: %s\n", note.c_str());
  const std::size_t written = totals.cells - totals.failed;
  if (json)
    return print_json({{"cells", written},
                       {"bytes_in", totals.bytes_in},
                       {"bytes_out", totals.bytes_out},
                       {"files", totals.files},
                       {"scene_files", totals.scene_files},
                       {"problems", notes.problems()},
                       {"notes", notes.notes()}});
  std::printf("%s, %s to %s, ratio %.2f\n", text::counted(written, "cell").c_str(), megabytes(totals.bytes_in).c_str(),
              megabytes(totals.bytes_out).c_str(), totals.ratio());
  if (totals.scene_files > 0) std::printf("%s copied\n", text::counted(totals.scene_files, "scene file").c_str());
}

}  // namespace

void run_terrain_batch(const TerrainBatch& batch) {
  check_folder_name("--out", batch.out);
  FileSentences unused;
  const auto index = index_of(batch, unused);
  if (!index) throw_failure(index.error());
  std::size_t left_out = unused.problems.size();
  AllReadingNotes notes;
  notes.add(std::move(unused));
  BatchTotals totals;
  totals.cells = index->size();
  Progress progress(index->size());
  std::set<std::filesystem::path> files;  // input files already in bytes_in; a file may hold several cells
  for (const auto& [slot, file] : *index) {
    const auto written = convert_cell(batch, file, corner_of_slot(slot), notes, left_out);
    if (!written) {
      notes.add_problem(written.error().message());
      ++totals.failed;
      progress.done("");
      continue;
    }
    if (files.insert(file.path).second) totals.bytes_in += bytes_on_disk(file.path, file.culture);
    const std::uintmax_t bytes = bytes_on_disk(*written, find_culture(*written));
    totals.bytes_out += bytes;
    totals.files.push_back(written->string());
    progress.done(written->string() + "  " + megabytes(bytes));
  }
  FileSentences scenes;
  totals.scene_files = copy_scenes(batch.in, batch.out, scenes.problems);
  left_out += scenes.problems.size();
  notes.add(std::move(scenes));
  print_totals(totals, notes, batch.json);
  if (totals.failed > 0)
    throw CommandFailed{"yars terrain " + batch.command + ": expected all cells to be written, found " +
                            std::to_string(totals.failed) + " of " + std::to_string(totals.cells) +
                            " that were not; see the problems",
                        1};
  if (left_out > 0)
    throw CommandFailed{"yars terrain " + batch.command + ": expected files that are whole, found " +
                            std::to_string(left_out) + " that are not, or are not used; see the problems",
                        1};
}

// `yars terrain convert`: converts elevation of any readable format to DTED, HGT or packed cells.

namespace {

// Adds --in, --out and --json, which all conversions have.
struct BatchOptions {
  std::string in, out;
  bool json = false;
};
void add_batch_options(runtime::Command command, BatchOptions& options) {
  command.option("--in", options.in, "folder of cells, or one file of any name (also a raster)")
      .value_name("FILE")
      .required();
  command.option("--out", options.out, "folder for the cells").value_name("DIR").required();
  add_json_flag(command, options.json);
}

struct ConvertOptions : BatchOptions {
  TerrainOutput output;
};

void convert(const ConvertOptions& options) {
  run_terrain_batch({"convert", options.in, options.out, options.json, 0,
                     [&](model::terrain::CellCorner corner, const model::terrain::Cell& cell) {
                       return output_name(options.output, corner, cell);
                     },
                     [&](const std::filesystem::path& tree, const model::terrain::Cell& cell) {
                       return write_output(options.output, tree, cell);
                     }});
}

}  // namespace

void add_terrain_convert(runtime::Command terrain) {
  const auto options = std::make_shared<ConvertOptions>();
  runtime::Command command =
      terrain.subcommand("convert", "convert elevation files of any readable format to DTED, HGT or packed cells");
  add_batch_options(command, *options);
  command.option("--to", options->output.format, "format").one_of({"dted", "hgt", "jp2"});
  command.option("--level", options->output.level, "DTED level of the grid")
      .range(0, 2)
      .otherwise("the finest with no more rows than the cell, for jp2 the cell's own grid");
  command.callback([options] { convert(*options); });
}

// `yars terrain reduce`: writes a coarser database: either packed cells with every 2^N-th post, or cells of a DTED
// level. A written post is the mean of the posts around it, or interpolated between such means (resample()).

namespace {

struct ReduceOptions : BatchOptions {
  std::optional<int> reduction;
  std::optional<int> level;
};

void reduce_all(const ReduceOptions& options) {
  if (options.reduction.has_value() == options.level.has_value())
    throw CommandFailed{"yars terrain reduce: expected one of --reduction and --level, found " +
                            std::string(options.level ? "both" : "none"),
                        2};
  const TerrainOutput output{options.level ? "dted" : "jp2", options.level};
  run_terrain_batch({"reduce", options.in, options.out, options.json, options.reduction.value_or(0),
                     [&](model::terrain::CellCorner corner, const model::terrain::Cell& cell) {
                       return output_name(output, corner, cell);
                     },
                     [&](const std::filesystem::path& tree, const model::terrain::Cell& cell) {
                       return write_output(output, tree, cell);
                     },
                     [&](const model::terrain::Cell& cell) {
                       return options.level ? model::terrain::dted::kPostsOfLevel[*options.level] : cell.rows();
                     }});
}

}  // namespace

void add_terrain_reduce(runtime::Command terrain) {
  const auto options = std::make_shared<ReduceOptions>();
  runtime::Command command =
      terrain.subcommand("reduce", "write a coarser database; each post is averaged over the posts around it");
  add_batch_options(command, *options);
  command.option("--reduction", options->reduction, "keep every 2^N-th post; written as packed cells")
      .range(1, 12)
      .otherwise("--level");
  command.option("--level", options->level, "write DTED of this level").range(0, 2).otherwise("--reduction");
  command.callback([options] { reduce_all(*options); });
}

// `yars terrain pack`: writes cells as lossless JPEG 2000. Readers decode only the wavelet levels that the
// requested grid needs.

void add_terrain_pack(runtime::Command terrain) {
  const auto options = std::make_shared<BatchOptions>();
  runtime::Command command = terrain.subcommand("pack", "cells as lossless JPEG 2000 with coarser grids inside");
  add_batch_options(command, *options);
  command.callback([options] {
    run_terrain_batch({"pack", options->in, options->out, options->json, 0,
                       [](model::terrain::CellCorner corner, const model::terrain::Cell&) {
                         return model::terrain::pack_name(corner);
                       },
                       [](const std::filesystem::path& tree, const model::terrain::Cell& cell) {
                         return model::terrain::write_pack(tree, cell);
                       }});
  });
}

}  // namespace yars::tools
