// One cell of the made-up landscape as DTED level 1, which several bounds are checked over. It is made once.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>

#include "model/terrain/formats/dted.hpp"
#include "tests/model/terrain/formats/dted_builder.hpp"
#include "worldgen/terrain/landscape.hpp"

namespace yars::test {

inline std::filesystem::path made_up_coast() {
  static const TemporaryFolder folder;
  static const bool written = [] {
    const worldgen::Landscape landscape(worldgen::DefaultLandscape::kSeed);
    return model::terrain::write_dted(folder.path(), landscape.cell({37, -123}, 1201, 1201), 1).has_value();
  }();
  EXPECT_TRUE(written);
  return folder.path();
}

}  // namespace yars::test
