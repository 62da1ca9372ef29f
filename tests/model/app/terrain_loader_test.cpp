// The loader's thread: intermediate views are available while the rest loads, and a newer request cancels the rest.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <thread>
#include <utility>

#include "model/app/background_shell.hpp"
#include "tests/model/terrain/shapes.hpp"

namespace yars::model {
namespace {

terrain::TerrainViewPointer view_of(std::uint64_t generation) {
  return std::make_shared<terrain::AnalyticTerrain>(terrain::flat(100.0), generation);
}

// Generation 1 for the empty region; else a view in between, 2, then waits for the gate or for being cut short, then 3.
class GatedStore final : public terrain::TerrainStore {
 public:
  explicit GatedStore(std::atomic<bool>& gate, std::atomic<int>& cut) : gate_(&gate), cut_(&cut) {}
  terrain::TerrainViewPointer prepare(const terrain::TerrainRegion& region) override {
    return view_of(region.radius_m > 0.0 ? 3 : 1);
  }
  terrain::TerrainViewPointer prepare_in_steps(const terrain::TerrainRegion& region, const Interim& interim) override {
    while (!*gate_) {
      const auto between = view_of(2);
      if (!interim(between)) {
        ++*cut_;
        return between;
      }
      std::this_thread::yield();
    }
    return prepare(region);
  }

 private:
  std::atomic<bool>* gate_;
  std::atomic<int>* cut_;
};

// False when the watchdog ends it.
bool comes(const std::function<bool()>& condition) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::yield();
  }
  return true;
}

const terrain::TerrainRegion kHere{{37.0, -122.0}, 50000.0, 0};
const terrain::TerrainRegion kElsewhere{{47.0, -122.0}, 50000.0, 0};

TEST(TerrainLoader, ShowsWhatIsThereWhileTheRestLoads) {
  std::atomic<bool> gate = false;
  std::atomic<int> cut = 0;
  TerrainLoader loader(std::make_unique<GatedStore>(gate, cut), false);
  EXPECT_EQ(loader.view()->generation(), 1U);
  loader.request(kHere);
  EXPECT_TRUE(comes([&] { return loader.view()->generation() == 2U; }));
  gate = true;
  EXPECT_TRUE(comes([&] { return loader.view()->generation() == 3U; }));
  EXPECT_EQ(cut, 0);
}

TEST(TerrainLoader, ANewerRequestCutsTheRestOfTheOlderShort) {
  std::atomic<bool> gate = false;
  std::atomic<int> cut = 0;
  TerrainLoader loader(std::make_unique<GatedStore>(gate, cut), false);
  loader.request(kHere);
  EXPECT_TRUE(comes([&] { return loader.view()->generation() == 2U; }));
  loader.request(kElsewhere);
  EXPECT_TRUE(comes([&] { return cut == 1; }));
}

TEST(TerrainLoader, ItsEndDoesNotWaitForTheRest) {
  std::atomic<bool> gate = false;
  std::atomic<int> cut = 0;
  {
    TerrainLoader loader(std::make_unique<GatedStore>(gate, cut), false);
    loader.request(kHere);
    EXPECT_TRUE(comes([&] { return loader.view()->generation() == 2U; }));
  }
  EXPECT_EQ(cut, 1);
}

TEST(TerrainLoader, WhoMayWaitSeesTheWholeAtOnce) {
  std::atomic<bool> gate = false;
  std::atomic<int> cut = 0;
  TerrainLoader loader(std::make_unique<GatedStore>(gate, cut), true);
  loader.request(kHere);
  EXPECT_EQ(loader.view()->generation(), 3U);
}

}  // namespace
}  // namespace yars::model
