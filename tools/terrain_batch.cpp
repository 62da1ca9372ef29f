#include "tools/terrain_batch.hpp"

#include <cstdio>
#include <set>
#include <system_error>
#include <vector>

#include "model/terrain/culture_reader.hpp"
#include "model/terrain/culture_tile.hpp"
#include "model/terrain/culture_writer.hpp"
#include "model/terrain/directory_index.hpp"
#include "model/terrain/reading_notes.hpp"
#include "tools/command.hpp"
#include "tools/output_name.hpp"

namespace yars::tools {

namespace {

using namespace model::terrain;

constexpr double kMegabyte = 1e6;

std::uintmax_t bytes_of(const std::filesystem::path& path) {
  std::error_code code;
  const std::uintmax_t bytes = std::filesystem::file_size(path, code);
  return code ? 0 : bytes;
}

// What a cell takes on disk: a pack is two files, and culture another.
std::uintmax_t bytes_on_disk(const std::filesystem::path& path) {
  const std::uintmax_t beside =
      path.extension() == ".jp2" ? bytes_of(std::filesystem::path(path).replace_extension(".side")) : 0;
  return bytes_of(path) + beside + bytes_of(culture_path(path));
}

Culture thinned(const Culture& culture, int posts) {
  int reduction = 0;
  while ((culture.rows() - 1) >> (reduction + 1) >= posts - 1) ++reduction;
  return culture.reduced(reduction);
}

// What covers the ground of a cell, from beside its file to beside the one that was written.
failure::Expected<void> take_culture_along(const TerrainBatch& batch, const CellFile& file, const Cell& cell,
                                           const std::filesystem::path& written) {
  const auto from = find_culture(file.path);
  const std::filesystem::path to = culture_path(written);
  std::error_code code;
  if (!from || std::filesystem::equivalent(*from, to, code)) return {};
  const auto culture = read_culture(*from, cell.place());
  if (!culture) return tl::unexpected(culture.error());
  return write_culture(to, batch.culture_posts ? thinned(*culture, batch.culture_posts(cell)) : *culture);
}

bool lies_in(const std::filesystem::path& inner, const std::filesystem::path& outer) {
  const std::filesystem::path way =
      std::filesystem::weakly_canonical(inner).lexically_relative(std::filesystem::weakly_canonical(outer));
  return !way.empty() && *way.begin() != "..";
}

failure::Expected<DirectoryIndex> index_of(const TerrainBatch& batch, std::vector<std::string>& problems) {
  if (!std::filesystem::is_directory(batch.in)) return index_file(batch.in);
  if (lies_in(batch.out, batch.in))
    return tl::unexpected(failure::Error{"yars terrain " + batch.command, "--out outside of --in",
                                         batch.out + " inside of " + batch.in,
                                         "give another folder: the input is never written over", true});
  return index_directory(batch.in, &problems);
}

failure::Expected<std::filesystem::path> convert_cell(const TerrainBatch& batch, const CellFile& file, CellPlace place,
                                                      AllReadingNotes& notes) {
  const auto reading = read_cell(file, place, batch.reduction);
  if (!reading) return tl::unexpected(reading.error());
  notes.add(file.path, *reading);
  const std::filesystem::path target = std::filesystem::path(batch.out) / batch.name(place, reading->cell);
  std::error_code code;
  if (std::filesystem::equivalent(target, file.path, code))
    return failure::fail(target.string(), "an output that is not the input", "the input itself", "give another --out");
  auto written = batch.write(batch.out, reading->cell);
  if (!written) return written;
  if (const auto taken = take_culture_along(batch, file, reading->cell, *written); !taken)
    return tl::unexpected(taken.error());
  return written;
}

}  // namespace

void run_terrain_batch(const TerrainBatch& batch) {
  check_folder_name("--out", batch.out);
  std::vector<std::string> unusable;
  const auto index = index_of(batch, unusable);
  if (!index) give_up(index.error());
  AllReadingNotes notes;
  for (const std::string& file : unusable) notes.add_problem(file);
  std::size_t seen = 0;
  std::size_t failed = 0;
  std::uintmax_t bytes_in = 0;
  std::uintmax_t bytes_out = 0;
  std::set<std::filesystem::path> files;  // a file of several cells counts once
  for (const auto& [slot, file] : *index) {
    ++seen;
    const auto written = convert_cell(batch, file, place_of_slot(slot), notes);
    if (!written) {
      notes.add_problem(written.error().message());
      ++failed;
      continue;
    }
    if (files.insert(file.path).second) bytes_in += bytes_on_disk(file.path);
    bytes_out += bytes_on_disk(*written);
    std::printf("%3zu/%zu  %s  %.3f MB\n", seen, index->size(), written->c_str(),
                static_cast<double>(bytes_on_disk(*written)) / kMegabyte);
    std::fflush(stdout);
  }
  for (const std::string& problem : notes.sentences()) std::fprintf(stderr, "problem: %s\n", problem.c_str());
  std::printf("%zu cells, %.3f MB to %.3f MB, ratio %.2f\n", seen - failed, static_cast<double>(bytes_in) / kMegabyte,
              static_cast<double>(bytes_out) / kMegabyte,
              bytes_out == 0 ? 0.0 : static_cast<double>(bytes_in) / static_cast<double>(bytes_out));
  if (failed > 0)
    throw CommandFailed{"yars terrain " + batch.command + ": expected all cells to be written, found " +
                            std::to_string(failed) + " of " + std::to_string(seen) + " that were not; see the problems",
                        1};
  if (!unusable.empty())
    throw CommandFailed{"yars terrain " + batch.command + ": expected all files to be used, found " +
                            std::to_string(unusable.size()) + " that could not be; see the problems",
                        1};
}

}  // namespace yars::tools
