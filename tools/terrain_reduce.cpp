// `yars terrain reduce`: a coarser database: by halvings as packed cells, or as DTED of a level.
#include <memory>
#include <optional>

#include "model/terrain/dted_format.hpp"
#include "tools/command.hpp"
#include "tools/terrain_batch.hpp"
#include "tools/terrain_commands.hpp"
#include "tools/terrain_formats.hpp"

namespace yars::tools {

namespace {

struct ReduceOptions {
  std::string in, out;
  std::optional<int> reduction;
  std::optional<int> level;
};

void reduce_all(const ReduceOptions& options) {
  if (options.reduction.has_value() == options.level.has_value())
    throw CommandFailed{"yars terrain reduce: expected one of --reduction and --level, found " +
                            std::string(options.level ? "both" : "none"),
                        2};
  const TerrainOutput output{options.level ? "dted" : "jp2", options.level};
  run_terrain_batch({"reduce", options.in, options.out, options.reduction.value_or(0),
                     [&](model::terrain::CellPlace place, const model::terrain::Cell& cell) {
                       return output_name(output, place, cell);
                     },
                     [&](const std::filesystem::path& tree, const model::terrain::Cell& cell) {
                       return write_output(output, tree, cell);
                     },
                     [&](const model::terrain::Cell& cell) {
                       return options.level ? model::terrain::dted::kPostsOfLevel[*options.level] : cell.rows();
                     }});
}

}  // namespace

void add_terrain_reduce(CLI::App& terrain) {
  const auto options = std::make_shared<ReduceOptions>();
  CLI::App* command = terrain.add_subcommand("reduce", "a coarser database: means of the posts around each kept one");
  command->add_option("--in", options->in, "folder of cells, or one file")->required();
  command->add_option("--out", options->out, "folder for the coarser cells")->required();
  command->add_option("--reduction", options->reduction, "keep every 2^N-th post; written as packed cells")
      ->check(CLI::Range(1, 12));
  command->add_option("--level", options->level, "DTED of this level")->check(CLI::Range(0, 2));
  command->callback([options] { reduce_all(*options); });
}

}  // namespace yars::tools
