// `yars terrain convert`: elevation of any format that YARS reads, as DTED, HGT or packed cells.
#include <memory>

#include "tools/command.hpp"
#include "tools/terrain_batch.hpp"
#include "tools/terrain_commands.hpp"
#include "tools/terrain_formats.hpp"

namespace yars::tools {

namespace {

struct ConvertOptions {
  std::string in, out;
  TerrainOutput output;
};

void convert(const ConvertOptions& options) {
  run_terrain_batch({"convert", options.in, options.out, 0,
                     [&](model::terrain::CellPlace place, const model::terrain::Cell& cell) {
                       return output_name(options.output, place, cell);
                     },
                     [&](const std::filesystem::path& tree, const model::terrain::Cell& cell) {
                       return write_output(options.output, tree, cell);
                     }});
}

}  // namespace

void add_terrain_convert(CLI::App& terrain) {
  const auto options = std::make_shared<ConvertOptions>();
  CLI::App* command = terrain.add_subcommand("convert", "elevation of any format read, as DTED, HGT or packed cells");
  command->add_option("--in", options->in, "folder of cells, or one file of any name (rasters too)")->required();
  command->add_option("--out", options->out, "folder for the cells")->required();
  command->add_option("--to", options->output.format, "format")
      ->check(CLI::IsMember({"dted", "hgt", "jp2"}))
      ->capture_default_str();
  command->add_option("--level", options->output.level, "DTED level of the grid; else the finest that the cell fills")
      ->check(CLI::Range(0, 2));
  command->callback([options] { convert(*options); });
}

}  // namespace yars::tools
