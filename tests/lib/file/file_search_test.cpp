// Tests of installed_file() and installed_folder(), which find a configuration or route by its name alone.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "lib/file/text_file.hpp"

namespace yars::file {
namespace {

namespace fs = std::filesystem;

// An installation prefix with two files, at the paths that `cmake --install` uses.
class InstalledFile : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const char* name : {"share/yars/config/only_here.guf", "share/yars/config/routes/only_here.route"}) {
      fs::create_directories((prefix_ / name).parent_path());
      std::ofstream(prefix_ / name) << "text";
    }
  }
  void TearDown() override { fs::remove_all(prefix_); }

  std::string found(const std::string& name) const { return installed_file(name, prefix_ / "share/yars/config"); }

  fs::path prefix_ = fs::temp_directory_path() / ("yars_installed_file_" + std::to_string(getpid()));
};

TEST_F(InstalledFile, AFileNameIsFoundInTheInstallation) {
  EXPECT_EQ(found("only_here.guf"), (prefix_ / "share/yars/config/only_here.guf").string());
  EXPECT_EQ(found("only_here.route"), (prefix_ / "share/yars/config/routes/only_here.route").string());
}

TEST_F(InstalledFile, AFileInTheCurrentFolderComesFirst) {
  const fs::path previous_folder = fs::current_path();
  fs::create_directories(prefix_ / "here");
  std::ofstream(prefix_ / "here/only_here.guf") << "text";
  fs::current_path(prefix_ / "here");
  const std::string name = found("only_here.guf");
  fs::current_path(previous_folder);
  EXPECT_EQ(name, "only_here.guf");
}

TEST_F(InstalledFile, ANameWithAFolderIsNotSearchedElsewhere) {
  EXPECT_EQ(found("routes/only_here.route"), "routes/only_here.route");
  EXPECT_EQ(found("../only_here.guf"), "../only_here.guf");
}

TEST_F(InstalledFile, AMissingFileKeepsItsNameForTheErrorMessage) {
  EXPECT_EQ(found("absent.guf"), "absent.guf");
  EXPECT_EQ(found(""), "");
  EXPECT_EQ(found("routes"), "routes");
}

TEST(InstalledFolder, OfABuildIsTheFolderOfItsSources) {
  EXPECT_TRUE(fs::is_regular_file(installed_folder() / "apg70.guf"));
}

}  // namespace
}  // namespace yars::file
