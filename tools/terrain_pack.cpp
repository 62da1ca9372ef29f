// `yars terrain pack`: cells as lossless JPEG 2000, which is read at the resolution that a range needs.
#include <memory>

#include "model/terrain/pack_writer.hpp"
#include "tools/command.hpp"
#include "tools/terrain_batch.hpp"
#include "tools/terrain_commands.hpp"

namespace yars::tools {

void add_terrain_pack(CLI::App& terrain) {
  struct Folders {
    std::string in, out;
  };
  const auto folders = std::make_shared<Folders>();
  CLI::App* command = terrain.add_subcommand("pack", "cells as lossless JPEG 2000 with coarser grids inside");
  command->add_option("--in", folders->in, "folder of cells, or one file")->required();
  command->add_option("--out", folders->out, "folder for the packed cells")->required();
  command->callback([folders] {
    run_terrain_batch(
        {"pack", folders->in, folders->out, 0,
         [](model::terrain::CellPlace place, const model::terrain::Cell&) { return model::terrain::pack_name(place); },
         [](const std::filesystem::path& tree, const model::terrain::Cell& cell) {
           return model::terrain::write_pack(tree, cell);
         }});
  });
}

}  // namespace yars::tools
