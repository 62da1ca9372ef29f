// `yars scan --shadow`: the table of lit and shadowed samples, over a plain with a wall across the line of sight.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "model/terrain/formats/dted.hpp"
#include "tests/endtoend/process_set.hpp"
#include "tests/model/terrain/formats/dted_builder.hpp"
#include "tests/model/terrain/sampling/rough_cell.hpp"

namespace yars {
namespace {

using ::testing::AnyOf;
using ::testing::HasSubstr;

constexpr double kAltitudeFt = 4000.0;       // 1219 m: between the plain, 100 m, and the top of the wall, 2000 m
constexpr int kWallRow = 60, kVoidRow = 30;  // rows of posts, from 37 N; 120 intervals a degree

// One row of the table. `lit`: 1, 0 or "-" (void).
struct Row {
  int sweep = 0;
  double azimuth_deg = 0.0, range_m = 0.0, latitude_deg = 0.0, longitude_deg = 0.0;
  std::string elevation, lit;
};

// Writes a cell with plain, wall and three rows of voids.
void write_wall(const std::filesystem::path& tree) {
  const auto cell = test::cell_of({37, -122}, 121, 121, [](int row, int) {
    if (row == kWallRow) return 2000;
    return row >= kVoidRow - 1 && row <= kVoidRow + 1 ? int{model::terrain::kVoidPost} : 100;
  });
  ASSERT_TRUE(model::terrain::write_dted(tree, cell, 0));
}

endtoend::Finished scan(const std::filesystem::path& tree, const std::string& fidelity, const std::string& file) {
  return endtoend::run_program({"yars",       "scan",      "--terrain",    tree.string(), "--lat",
                                "37.05",      "--lon",     "-121.5",       "--alt-ft",    std::to_string(kAltitudeFt),
                                "--range-nm", "40",        "--scan-width", "20",          "--fidelity",
                                fidelity,     "--samples", "240",          "--shadow",    file});
}

std::vector<Row> rows_of(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  EXPECT_EQ(line, "sweep,azimuth_deg,ground_range_m,latitude_deg,longitude_deg,elevation_m,lit");
  std::vector<Row> rows;
  while (std::getline(file, line)) {
    std::istringstream fields(line);
    std::vector<std::string> words;
    for (std::string word; std::getline(fields, word, ',');) words.push_back(word);
    if (words.size() != 7U) {
      ADD_FAILURE() << line;
      continue;
    }
    const auto number = [&words](std::size_t i) { return std::strtod(words[i].c_str(), nullptr); };
    rows.push_back({std::atoi(words[0].c_str()), number(1), number(2), number(3), number(4), words[5], words[6]});
  }
  return rows;
}

// Expected `lit` followed by `elevation`; `row` is a fractional row of posts. Empty near voids and wall, where posts of
// different kinds are mixed.
std::string expected_at(double row) {
  if (std::abs(row - kVoidRow) < 0.9) return "--";
  if (row < kVoidRow - 2.1 || (row > kVoidRow + 2.1 && row < kWallRow - 1.1)) return "1100";
  return row > kWallRow + 2.0 && row < 120.0 ? "0100" : "";
}

class ScanShadow : public ::testing::TestWithParam<const char*> {};

TEST_P(ScanShadow, TheWallShadowsThePlainBehindItAndVoidsAreNeitherLitNorShadowed) {
  const test::TemporaryFolder folder;
  write_wall(folder.path());
  const std::string file = folder.path() / "shadow.csv";
  const auto run = scan(folder.path(), GetParam(), file);
  ASSERT_EQ(run.code, 0) << run.errors;
  EXPECT_THAT(run.output, HasSubstr(" sweeps of 240 samples"));
  const std::vector<Row> rows = rows_of(file);
  ASSERT_EQ(rows.size() % 240U, 0U);
  ASSERT_GT(rows.size(), 240U);
  EXPECT_EQ(rows.back().sweep, static_cast<int>(rows.size() / 240U) - 1);
  for (const Row& row : rows) {
    const std::string expected = expected_at((row.latitude_deg - 37.0) * 120.0);
    if (!expected.empty()) {
      EXPECT_EQ(row.lit + row.elevation, expected) << row.latitude_deg;
    }
    EXPECT_THAT(row.lit, AnyOf("1", "0", "-"));
    EXPECT_NEAR(row.longitude_deg, -121.5, 0.2);
    // The ray that `draft` takes for the last sweep of an odd number lies on its outer edge.
    EXPECT_TRUE(row.azimuth_deg <= 10.0 || row.azimuth_deg > 350.0) << row.azimuth_deg;
  }
  EXPECT_NEAR(rows[1].range_m - rows[0].range_m, 40 * 1852.0 / 240, 1e-6);
}
INSTANTIATE_TEST_SUITE_P(Fidelities, ScanShadow, ::testing::Values("1996", "draft", "standard", "reference"),
                         [](const auto& chosen) { return std::string("By_") + chosen.param; });

TEST(ScanShadowRefusal, ANameWithoutCsvIsBadUsage) {
  const test::TemporaryFolder folder;
  write_wall(folder.path());
  const auto run = scan(folder.path(), "standard", "shadow.png");
  EXPECT_EQ(run.code, 2);
  EXPECT_THAT(run.errors, HasSubstr("--shadow: expected a name that ends in .csv, found shadow.png"));
}

TEST(ScanShadowRefusal, AFileThatCannotBeWrittenIsAnError) {
  const test::TemporaryFolder folder;
  write_wall(folder.path());
  const auto run = scan(folder.path(), "standard", folder.path() / "missing" / "shadow.csv");
  EXPECT_EQ(run.code, 1);
  EXPECT_THAT(run.errors, HasSubstr("missing: expected a folder, found none"));
}

}  // namespace
}  // namespace yars
