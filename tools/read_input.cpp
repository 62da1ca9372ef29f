#include "tools/read_input.hpp"

#include <algorithm>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "model/terrain/directory_store.hpp"

namespace yars::tools {

namespace {

// Of what there is, how much cannot be read; fails where that is all of it.
void judge(const char* command, const std::string& subject, const char* things, std::size_t all, std::size_t lost) {
  if (lost == 0) return;
  const std::string count = std::to_string(lost) + " of " + std::to_string(all);
  if (lost == all)
    give_up({subject, std::string(things) + " that can be read", "none: " + count + " cannot",
             "see the lines above; mend or replace the files", false});
  std::fprintf(stderr, "%s: %s %s cannot be read, the picture is made without them\n", command, count.c_str(), things);
}

void tell(const char* command, const std::vector<std::string>& problems) {
  for (const std::string& problem : problems) std::fprintf(stderr, "%s: %s\n", command, problem.c_str());
}

}  // namespace

void check_terrain_read(const char* command, const std::string& folder, model::terrain::TerrainStore& store,
                        model::terrain::TerrainStore* way) {
  std::vector<std::string> problems = store.take_problems();
  for (std::string& problem : way == nullptr ? std::vector<std::string>() : way->take_problems())
    if (std::find(problems.begin(), problems.end(), problem) == problems.end()) problems.push_back(std::move(problem));
  tell(command, problems);
  const auto* const directory = dynamic_cast<const model::terrain::DirectoryTerrainStore*>(&store);
  if (directory == nullptr) return;  // the built-in hills are not read
  const model::terrain::RegionCells cells = directory->region_cells();
  judge(command, folder, "cells of the region", cells.files, cells.unreadable);
}

void check_scenes_read(const char* command, model::scene::SceneStore& scenes) {
  tell(command, scenes.take_problems());
  judge(command, "--scene", "scenes of the region", scenes.wanted().files, scenes.wanted().unreadable);
}

}  // namespace yars::tools
