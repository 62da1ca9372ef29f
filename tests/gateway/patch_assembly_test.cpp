// Patch maps out of rows that arrive in any order.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "gateway/sample_reception.hpp"
#include "tests/gateway/random_seed.hpp"

namespace yars::gateway {
namespace {

constexpr std::uint64_t kHost = 11;

struct Made {
  databuffer::PatchMap map{};
  std::vector<std::uint8_t> pixels;
  std::span<const std::uint8_t> row(std::uint32_t number) const {
    return std::span(pixels).subspan(std::size_t{number} * map.size, map.size);
  }
};

Made make(std::uint64_t id, std::uint32_t size, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  Made made;
  made.map.id = id;
  made.map.size = size;
  made.pixels.resize(std::size_t{size} * size);
  for (auto& pixel : made.pixels) pixel = static_cast<std::uint8_t>(random());
  made.map.hash = databuffer::map_hash(made.map, made.pixels);
  return made;
}

void add_all(PatchAssembly& assembly, const Made& made) {
  for (std::uint32_t row = 0; row < made.map.size; ++row) assembly.add_row(kHost, made.map.id, row, made.row(row));
}

TEST(PatchAssembly, RowsInAnyOrderAndAnyNumberOfTimesMakeTheMapOnce) {
  const std::uint64_t seed = testing::random_seed();
  SCOPED_TRACE("YARS_SEED=" + std::to_string(seed));
  std::mt19937_64 random(seed);
  for (int run = 0; run < 50; ++run) {
    const Made made = make(1 + random() % 100, static_cast<std::uint32_t>(1 + random() % 40), random());
    std::vector<int> steps(made.map.size * 3);  // each row three times; -1: the record of the map
    for (std::size_t i = 0; i < steps.size(); ++i) steps[i] = static_cast<int>(i % made.map.size);
    steps.push_back(-1);
    std::ranges::shuffle(steps, random);
    PatchAssembly assembly;
    int whole_maps = 0;
    std::vector<bool> has_arrived(made.map.size);
    bool has_map = false;
    for (const int step : steps) {
      if (step < 0)
        assembly.begin(kHost, made.map);
      else
        assembly.add_row(kHost, made.map.id, static_cast<std::uint32_t>(step),
                         made.row(static_cast<std::uint32_t>(step)));
      has_map = has_map || step < 0;
      if (step >= 0) has_arrived[static_cast<std::size_t>(step)] = true;
      const auto whole = assembly.take_whole(kHost);
      const bool is_due = whole_maps == 0 && has_map && std::ranges::count(has_arrived, false) == 0;
      EXPECT_EQ(whole.has_value(), is_due) << "as soon as it is whole, and once";
      if (!whole) continue;
      ++whole_maps;
      EXPECT_EQ(whole->map.id, made.map.id);
      EXPECT_EQ(whole->pixels, made.pixels);
    }
    EXPECT_EQ(whole_maps, 1);
  }
}

TEST(PatchAssembly, RowsOfAWrongSizeAreNoRows) {
  const Made made = make(3, 8, 1);
  PatchAssembly assembly;
  assembly.begin(kHost, made.map);
  add_all(assembly, made);
  assembly.add_row(kHost, 3, 5, made.row(5).first(7));
  EXPECT_FALSE(assembly.take_whole(kHost)) << "the row has become too short";
  assembly.add_row(kHost, 3, 5, {});
  EXPECT_FALSE(assembly.take_whole(kHost));
  assembly.add_row(kHost, 3, 8, made.row(0));
  assembly.add_row(kHost, 3, databuffer::kMaxPatchPixels, made.row(0));
  assembly.add_row(kHost, 3, 0xFFFF'FFFFU, made.row(0));
  assembly.add_row(kHost, 3, 5, made.row(5));
  const auto whole = assembly.take_whole(kHost);
  ASSERT_TRUE(whole) << "rows beyond the map do not matter";
  EXPECT_EQ(whole->pixels, made.pixels);
}

TEST(PatchAssembly, AMapWithAWrongHashWaitsForItsRightRows) {
  const Made made = make(3, 8, 1), other = make(3, 8, 2);
  PatchAssembly assembly;
  assembly.begin(kHost, made.map);
  add_all(assembly, other);
  EXPECT_FALSE(assembly.take_whole(kHost));
  add_all(assembly, made);
  const auto whole = assembly.take_whole(kHost);
  ASSERT_TRUE(whole);
  EXPECT_EQ(whole->pixels, made.pixels);
}

// A host that starts its set again counts its maps from 1 again.
TEST(PatchAssembly, AnotherMapWithTheNumberOfAnUnfinishedOneIsMade) {
  const Made first = make(1, 8, 1), second = make(1, 6, 2);
  PatchAssembly assembly;
  assembly.begin(kHost, first.map);
  for (std::uint32_t row = 0; row < 5; ++row) assembly.add_row(kHost, 1, row, first.row(row));
  for (std::uint32_t row = 0; row < 3; ++row) assembly.add_row(kHost, 1, row, second.row(row));
  assembly.begin(kHost, second.map);
  EXPECT_FALSE(assembly.take_whole(kHost));
  for (std::uint32_t row = 3; row < 6; ++row) assembly.add_row(kHost, 1, row, second.row(row));
  const auto whole = assembly.take_whole(kHost);
  ASSERT_TRUE(whole);
  EXPECT_EQ(whole->pixels, second.pixels);
}

TEST(PatchAssembly, OnlyMapsOfTheNamedHostAreTaken) {
  const Made made = make(3, 8, 1);
  PatchAssembly assembly;
  assembly.begin(kHost, made.map);
  add_all(assembly, made);
  EXPECT_FALSE(assembly.take_whole(kHost + 1));
  EXPECT_TRUE(assembly.take_whole(kHost));
  EXPECT_FALSE(assembly.take_whole(kHost)) << "once";
}

TEST(PatchAssembly, TheOldestUnfinishedMapIsForgottenForTheNinth) {
  const Made oldest = make(1, 4, 1);
  PatchAssembly assembly;
  assembly.begin(kHost, oldest.map);
  for (std::uint64_t id = 2; id <= 9; ++id) assembly.begin(kHost, make(id, 4, id).map);
  add_all(assembly, oldest);
  EXPECT_FALSE(assembly.take_whole(kHost));
  const Made newest = make(9, 4, 9);
  add_all(assembly, newest);
  EXPECT_TRUE(assembly.take_whole(kHost));
}

}  // namespace
}  // namespace yars::gateway
