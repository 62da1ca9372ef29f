// Commands with damaged or missing input. If none of the input can be read: exit code 1 and a message. If a part can be
// read: a result, the number of unreadable files, and exit code 1.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "model/terrain/formats/dted.hpp"
#include "tests/endtoend/process_set.hpp"
#include "tests/model/terrain/formats/dted_builder.hpp"
#include "tests/model/terrain/sampling/rough_cell.hpp"
#include "worldgen/scene/openflight_writer.hpp"

namespace yars {
namespace {

using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

void write_text(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << text;
}

void write_cell(const fs::path& tree, int south_deg, int west_deg) {
  ASSERT_TRUE(model::terrain::write_dted(
      tree, test::cell_of({south_deg, west_deg}, 121, 121, [](int, int) { return 100; }), 0));
}

// Runs `yars scan` or `yars patch` at 37.5 N 121.02 W with further options.
endtoend::Finished view(const std::string& command, const std::vector<std::string>& more) {
  std::vector<std::string> words{"yars", command, "--lat", "37.5", "--lon", "-121.02", "--heading", "10"};
  if (command == "patch") words.insert(words.end(), {"--target-lat", "37.6", "--target-lon", "-120.9", "--size", "64"});
  if (command == "scan") words.insert(words.end(), {"--range-nm", "10", "--samples", "60"});
  words.insert(words.end(), more.begin(), more.end());
  return endtoend::run_program(words);
}

TEST(DamagedInput, UnreadableTerrainFailsAndPartlyUnreadableTerrainIsCounted) {
  for (const std::string command : {"scan", "patch"}) {
    const test::TemporaryFolder folder;
    const std::string tree = folder.path();
    write_cell(folder.path(), 37, -122);
    write_cell(folder.path(), 37, -121);
    EXPECT_EQ(view(command, {"--terrain", tree}).errors, "") << command;
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder.path()))
      if (entry.is_regular_file()) files.push_back(entry.path());
    ASSERT_EQ(files.size(), 2U);
    fs::resize_file(files[0], 4000);
    const auto half = view(command, {"--terrain", tree});
    EXPECT_EQ(half.code, 1) << command << half.errors;
    EXPECT_NE(half.output, "") << "the picture of the rest";
    EXPECT_THAT(half.errors, HasSubstr("1 of 2 cells of the region cannot be read")) << command;
    fs::resize_file(files[1], 4000);
    const auto none = view(command, {"--terrain", tree});
    EXPECT_EQ(none.code, 1) << command;
    EXPECT_EQ(none.output, "") << command;
    EXPECT_THAT(none.errors, HasSubstr("expected cells of the region that can be read, found none: 2 of 2 cannot"));
  }
}

TEST(DamagedInput, AnUnreadableCellOnThePathToAPatchIsReported) {
  const test::TemporaryFolder folder;
  write_cell(folder.path(), 37, -121);
  write_cell(folder.path(), 37, -120);
  fs::resize_file(folder.path() / "w121" / "n37.dt0", 4000);
  const auto patch =
      endtoend::run_program({"yars", "patch", "--lat", "37.5", "--lon", "-120.3", "--heading", "60", "--target-lat",
                             "37.6", "--target-lon", "-119.8", "--size", "64", "--terrain", folder.path()});
  EXPECT_EQ(patch.code, 1) << patch.errors;
  EXPECT_THAT(patch.errors, HasSubstr("n37.dt0"));
}

TEST(DamagedInput, ATradeOverUnreadableTerrainFails) {
  const test::TemporaryFolder folder;
  write_cell(folder.path(), 37, -121);
  fs::resize_file(folder.path() / "w121" / "n37.dt0", 4000);
  const std::vector<std::vector<std::string>> trades = {
      {"yars", "trade", "--scene", "37.5,-120.5,15000,10,10"},
      {"yars", "trade", "maps", "--view", "37.5,-120.5,15000,37.7,-120.4,4.7"}};
  for (std::vector<std::string> words : trades) {
    words.insert(words.end(), {"--presets", "draft", "--repeat", "1", "--terrain", folder.path()});
    const auto trade = endtoend::run_program(words);
    EXPECT_EQ(trade.code, 1) << trade.errors;
    EXPECT_EQ(trade.output, "");
    EXPECT_THAT(trade.errors, HasSubstr("expected cells of the region that can be read, found none"));
  }
}

// A problem of a cell that is read makes the exit code of every command 1 that reads the cell; a note does not.
TEST(DamagedInput, ACellWithAProblemIsNamedAndMakesTheExitCodeOne) {
  const test::TemporaryFolder folder;
  const fs::path tree = folder.path() / "cells";
  write_cell(tree, 37, -122);
  const fs::path cell = tree / "w122" / "n37.dt0";
  const std::string out = folder.path() / "out";
  const std::vector<std::vector<std::string>> commands = {
      {"terrain", "info", tree},
      {"terrain", "image", "--terrain", tree, "--out", folder.path() / "map.png"},
      {"terrain", "profile", "--terrain", tree, "--from", "37.4", "-121.5", "--to", "37.5", "-121.5"},
      {"terrain", "dump", "--terrain", tree, "--south", "37", "--west", "-122"},
      {"terrain", "convert", "--in", tree, "--out", out},
      {"terrain", "reduce", "--in", tree, "--out", out, "--reduction", "1"},
      {"terrain", "pack", "--in", tree, "--out", out},
      {"scan", "--terrain", tree, "--lat", "37.5", "--lon", "-121.5", "--range-nm", "5", "--samples", "20"},
      {"patch", "--terrain", tree, "--lat", "37.4", "--lon", "-121.5", "--heading", "0", "--target-lat", "37.5",
       "--target-lon", "-121.3", "--size", "32", "--force"},
      {"trade", "--terrain", tree, "--scene", "37.5,-121.5,15000,0,5", "--presets", "draft", "--repeat", "1",
       "--ruler-samples", "16"}};
  const auto expect = [&](int code, const std::string& sentence) {
    for (std::vector<std::string> words : commands) {
      words.insert(words.begin(), "yars");
      const auto done = endtoend::run_program(words);
      EXPECT_EQ(done.code, code) << words[1] << ' ' << words[2] << done.errors;
      EXPECT_THAT(done.output + done.errors, HasSubstr(sentence)) << words[1] << ' ' << words[2];
    }
  };
  std::ofstream(cell, std::ios::app) << "padding";
  expect(0, "bytes after the last column record: 7");
  std::fstream(cell, std::ios::in | std::ios::out | std::ios::binary).seekp(3500) << '\x01';
  expect(1, "columns with a wrong checksum: 1");
}

// A trade whose terrain or scene lacks a part writes its table, names the part, and ends with 1, in text and in JSON.
TEST(DamagedInput, ATradeThatLeavesPartsOutNamesThemAndFailsAfterTheResult) {
  const test::TemporaryFolder folder;
  write_cell(folder.path() / "cells", 37, -121);
  write_cell(folder.path() / "cells", 37, -120);
  fs::resize_file(folder.path() / "cells" / "w120" / "n37.dt0", 4000);
  worldgen::OpenFlightWriter writer(geo::GeoPoint{37.7, -120.4});
  writer.external("hangar.flt", {});
  const std::vector<std::byte> bytes = writer.take();
  const fs::path scene = folder.path() / "whole.flt";
  write_text(scene, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  struct Trade {
    std::vector<std::string> words;
    std::string part;
  };
  const std::vector<Trade> trades = {
      {{"trade", "--scene", "37.5,-120.1,15000,90,20", "--terrain", folder.path() / "cells"}, "n37.dt0"},
      {{"trade", "maps", "--view", "37.5,-120.4,15000,37.6,-120.0,4.7", "--terrain", folder.path() / "cells"},
       "n37.dt0"},
      {{"trade", "maps", "--view", "37.5,-120.5,15000,37.7,-120.4,4.7", "--scene", scene}, "hangar.flt is not there"}};
  for (const Trade& trade : trades)
    for (const bool json : {false, true}) {
      std::vector<std::string> words{"yars"};
      words.insert(words.end(), trade.words.begin(), trade.words.end());
      words.insert(words.end(), {"--presets", "draft", "--repeat", "1"});
      words.insert(words.end(), {words[2] == "maps" ? "--ruler-size" : "--ruler-samples", "32"});
      if (json) words.emplace_back("--json");
      const auto done = endtoend::run_program(words);
      EXPECT_EQ(done.code, 1) << done.errors;
      EXPECT_THAT(done.output, HasSubstr("draft")) << "the result is written";
      EXPECT_THAT(done.errors, AllOf(HasSubstr(trade.part), HasSubstr("found 1 part left out")));
      if (json) {
        EXPECT_THAT(done.output, HasSubstr(trade.part));
      }
    }
}

// `trade` may take an hour; a misspelt output folder must not waste that time.
TEST(DamagedInput, AnOutputThatCannotBeWrittenIsReportedBeforeTheWorkBegins) {
  const test::TemporaryFolder folder;
  const std::string missing = folder.path() / "missing" / "file";
  const std::vector<std::vector<std::string>> commands = {
      {"trade", "--out", missing + ".json"},
      {"trade", "maps", "--csv", missing + ".csv"},
      {"scan", "--out", missing + ".f32"},
      {"scan", "--shadow", missing + ".csv"},
      {"patch", "--out", missing + ".png"},
      {"terrain", "image", "--terrain", "none", "--out", missing + ".png"},
      {"scene", "image", "none.flt", "--out", missing + ".png"},
      {"scene", "generate", "--origin", "37,-121", "--out", missing + ".flt"}};
  for (std::vector<std::string> words : commands) {
    words.insert(words.begin(), "yars");
    if (words[1] == "scan" || words[1] == "patch")
      words.insert(words.end(), {"--lat", "37.5", "--lon", "-121.02", "--terrain", "none-there"});
    if (words[1] == "patch") words.insert(words.end(), {"--target-lat", "37.6", "--target-lon", "-120.9"});
    const auto done = endtoend::run_program(words);
    EXPECT_EQ(done.code, 1) << words[1] << done.errors;
    EXPECT_THAT(done.errors, HasSubstr((folder.path() / "missing").string())) << words[1];
  }
}

fs::path airfield(const fs::path& folder) {
  fs::path file = folder / "whole.flt";
  const auto made = endtoend::run_program({"yars", "scene", "generate", "--kind", "airfield", "--triangles", "2000",
                                           "--origin", "37.55,-120.97", "--out", file.string()});
  EXPECT_EQ(made.code, 0) << made.errors;
  return file;
}

TEST(DamagedInput, UnreadableAndMissingScenesFail) {
  const test::TemporaryFolder folder;
  const fs::path whole = airfield(folder.path());
  const fs::path torn = folder.path() / "torn.flt";
  fs::copy_file(whole, torn);
  fs::resize_file(torn, 3000);
  for (const std::string command : {"scan", "patch"}) {
    EXPECT_EQ(view(command, {"--scene", whole}).code, 0) << command;
    const auto none = view(command, {"--scene", torn});
    EXPECT_EQ(none.code, 1) << command << none.errors;
    EXPECT_THAT(none.errors, HasSubstr("torn.flt")) << command;
    const auto missing = view(command, {"--scene", folder.path() / "missing.flt"});
    EXPECT_EQ(missing.code, 1) << command;
    EXPECT_THAT(missing.errors, HasSubstr("missing.flt")) << command;
  }
}

TEST(DamagedInput, UnreadableFilesOfASceneFolderAreCounted) {
  const test::TemporaryFolder folder;
  airfield(folder.path());
  write_text(folder.path() / "text.flt", "no scene");
  for (const std::string command : {"scan", "patch"}) {
    const auto part = view(command, {"--scene", folder.path()});
    EXPECT_EQ(part.code, 1) << command << part.errors;
    EXPECT_THAT(part.errors, AllOf(HasSubstr("text.flt"), HasSubstr("1 of 2 scenes of the region cannot be read")));
    EXPECT_THAT(part.output, HasSubstr("hash")) << "the picture is made";
  }
  fs::remove(folder.path() / "whole.flt");
  for (const std::string command : {"scan", "patch"}) {
    const auto none = view(command, {"--scene", folder.path()});
    EXPECT_EQ(none.code, 1) << command << none.errors;
    EXPECT_THAT(none.errors, HasSubstr("none: 1 of 1 cannot"));
  }
}

TEST(DamagedInput, SceneInfoReportsReadableFilesAndFailsForUnreadableFiles) {
  const test::TemporaryFolder folder;
  const fs::path whole = airfield(folder.path());
  write_text(folder.path() / "text.flt", "no scene");
  const auto run = endtoend::run_program({"yars", "scene", "info", folder.path() / "text.flt", whole});
  EXPECT_EQ(run.code, 1);
  EXPECT_THAT(run.output, HasSubstr("whole.flt"));
  EXPECT_THAT(run.errors, HasSubstr("1 of 2 that cannot be read"));
}

// A scene whose external file is missing: the commands name it, in text and in JSON, and fail after their result.
TEST(DamagedInput, WhatIsLeftOutOfASceneIsNamedAndFailsAfterTheResult) {
  const test::TemporaryFolder folder;
  worldgen::OpenFlightWriter writer(geo::GeoPoint{37.55, -120.97});
  writer.external("hangar.flt", {});
  const std::vector<std::byte> bytes = writer.take();
  const fs::path file = folder.path() / "whole.flt";
  write_text(file, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  const std::string image = folder.path() / "plan.png";
  const auto run = [](std::vector<std::string> words) {
    words.insert(words.begin(), "yars");
    return endtoend::run_program(words);
  };
  for (const auto& done : {run({"scene", "info", file}), run({"scene", "info", file, "--json"}),
                           view("scan", {"--scene", file, "--json"}), view("patch", {"--scene", file, "--json"})}) {
    EXPECT_EQ(done.code, 1) << done.errors;
    EXPECT_THAT(done.output, HasSubstr("external file hangar.flt is not there"));
    EXPECT_THAT(done.output, AnyOf(HasSubstr("left out: "), HasSubstr("\"left_out\": ["), HasSubstr("\"left_out\":[")));
    EXPECT_THAT(done.errors, HasSubstr("left out"));
  }
  for (const std::string command : {"scan", "patch"}) {
    const auto text = view(command, {"--scene", file});
    EXPECT_EQ(text.code, 1) << command;
    EXPECT_THAT(text.output, HasSubstr("hash")) << command;
    EXPECT_THAT(text.errors, HasSubstr("external file hangar.flt is not there")) << command;
  }
  const auto drawn = run({"scene", "image", file, "--out", image});
  EXPECT_EQ(drawn.code, 1);
  EXPECT_TRUE(fs::exists(image));
  EXPECT_THAT(drawn.errors, HasSubstr("external file hangar.flt is not there"));
  EXPECT_EQ(run({"scene", "info", file, "--without", "hangar.flt"}).code, 0) << "the user leaves it out";
}

// The path of an existing file is never split at an '@'.
TEST(Scenes, AFileWithAnAtSignInItsNameIsRead) {
  const test::TemporaryFolder folder;
  const fs::path named = folder.path() / "base@37.6,-121.flt";
  fs::copy_file(airfield(folder.path()), named);
  for (const std::string command : {"scan", "patch"}) {
    EXPECT_EQ(view(command, {"--scene", named}).code, 0) << command;
    EXPECT_EQ(view(command, {"--scene", named.string() + "@37.55,-120.97"}).code, 0) << command;
  }
  EXPECT_EQ(endtoend::run_program({"yars", "scene", "info", named}).code, 0);
  const auto missing = view("scan", {"--scene", folder.path() / "base@north.flt"});
  EXPECT_EQ(missing.code, 2);
  EXPECT_THAT(missing.errors, HasSubstr("expected an existing file, FILE@LATITUDE,LONGITUDE"));
}

}  // namespace
}  // namespace yars
