// TerrainLoader: intermediate views are available while a region loads, and a newer request cancels an older one.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <thread>
#include <utility>

#include "model/app/background_shell.hpp"
#include "model/terrain/sampling/cell_view.hpp"
#include "tests/model/terrain/shapes.hpp"

namespace yars::model {
namespace {

terrain::TerrainViewPointer view_of(std::uint64_t generation) {
  return std::make_shared<terrain::AnalyticTerrain>(terrain::flat(100.0), generation);
}

// View without cells, which has no detail.
terrain::TerrainViewPointer coarse_view_of(std::uint64_t generation) {
  return std::make_shared<terrain::CellView>(generation, terrain::Absence::sea, -1);
}

// Store whose views tell the loading progress by their generation. 1: empty region; 2: intermediate view; 3: complete
// region. An incremental load ends when `gate` becomes true. `cancelled` counts the cancelled loads. `detailed`: the
// intermediate view has the detail of the region.
class GatedStore final : public terrain::TerrainStore {
 public:
  GatedStore(std::atomic<bool>& gate, std::atomic<int>& cancelled, bool detailed = true)
      : gate_(&gate), cancelled_(&cancelled), detailed_(detailed) {}
  terrain::TerrainViewPointer prepare(const terrain::TerrainRegion& region) override {
    return view_of(region.radius_m > 0.0 ? 3 : 1);
  }
  terrain::TerrainViewPointer prepare_in_steps(const terrain::TerrainRegion& region, const Interim& interim) override {
    while (!*gate_) {
      const auto intermediate = detailed_ ? view_of(2) : coarse_view_of(2);
      if (!interim(intermediate)) {
        ++*cancelled_;
        return intermediate;
      }
      std::this_thread::yield();
    }
    return prepare(region);
  }

 private:
  std::atomic<bool>* gate_;
  std::atomic<int>* cancelled_;
  bool detailed_;
};

// Waits until the condition is true. Returns false after 20 s.
bool becomes_true(const std::function<bool()>& condition) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::yield();
  }
  return true;
}

const terrain::TerrainRegion kHere{{37.0, -122.0}, 50000.0, 0};
const terrain::TerrainRegion kElsewhere{{47.0, -122.0}, 50000.0, 0};

TEST(TerrainLoader, ShowsTheIntermediateViewUntilTheRegionIsComplete) {
  std::atomic<bool> gate = false;
  std::atomic<int> cancelled = 0;
  TerrainLoader loader(std::make_unique<GatedStore>(gate, cancelled), false);
  EXPECT_EQ(loader.view()->generation(), 1U);
  loader.request(kHere);
  EXPECT_TRUE(becomes_true([&] { return loader.view()->generation() == 2U; }));
  gate = true;
  EXPECT_TRUE(becomes_true([&] { return loader.view()->generation() == 3U; }));
  EXPECT_EQ(cancelled, 0);
}

TEST(TerrainLoader, HasLoadedTheScansReachBeforeTheMargin) {
  std::atomic<bool> gate = false;
  std::atomic<int> cancelled = 0;
  TerrainLoader loader(std::make_unique<GatedStore>(gate, cancelled), false);
  EXPECT_FALSE(loader.has_loaded(kHere));
  loader.request(kHere);
  EXPECT_TRUE(becomes_true([&] { return loader.has_loaded(kHere); }));
  EXPECT_EQ(loader.view()->generation(), 2U);
  const terrain::TerrainRegion wider{kHere.centre, kHere.radius_m + 0.5 * kLoadMargin_m, 0};
  EXPECT_FALSE(loader.has_loaded(wider));
  EXPECT_FALSE(loader.has_loaded({kHere.centre, kHere.radius_m, 1}));
  EXPECT_FALSE(loader.has_loaded(kElsewhere));
  gate = true;
  EXPECT_TRUE(becomes_true([&] { return loader.has_loaded(wider); }));
  EXPECT_EQ(loader.view()->generation(), 3U);
}

TEST(TerrainLoader, HasNotLoadedARegionWhoseViewLacksItsDetail) {
  std::atomic<bool> gate = false;
  std::atomic<int> cancelled = 0;
  TerrainLoader loader(std::make_unique<GatedStore>(gate, cancelled, false), false);
  loader.request(kHere);
  EXPECT_TRUE(becomes_true([&] { return loader.view()->generation() == 2U; }));
  EXPECT_FALSE(loader.has_loaded(kHere));
  gate = true;
  EXPECT_TRUE(becomes_true([&] { return loader.has_loaded(kHere); }));
}

TEST(TerrainLoader, AStandbysRegionIsEnoughUntilTheMarginIsLoaded) {
  std::atomic<bool> gate = true;
  std::atomic<int> cancelled = 0;
  TerrainLoader loader(std::make_unique<GatedStore>(gate, cancelled), false);
  loader.request(kHere, kStandbyMargin_m);
  EXPECT_TRUE(becomes_true([&] { return loader.has_loaded(kHere); }));
  gate = false;
  loader.request(kHere);
  EXPECT_TRUE(loader.has_loaded(kHere));
  EXPECT_TRUE(becomes_true([&] { return loader.view()->generation() == 2U; }));
  EXPECT_TRUE(loader.has_loaded(kHere));
  gate = true;
  const terrain::TerrainRegion wide{kHere.centre, kHere.radius_m + kLoadMargin_m, 0};
  EXPECT_TRUE(becomes_true([&] { return loader.has_loaded(wide); }));
}

TEST(TerrainLoader, ANewerRequestCancelsAnOlderRequest) {
  std::atomic<bool> gate = false;
  std::atomic<int> cancelled = 0;
  TerrainLoader loader(std::make_unique<GatedStore>(gate, cancelled), false);
  loader.request(kHere);
  EXPECT_TRUE(becomes_true([&] { return loader.view()->generation() == 2U; }));
  loader.request(kElsewhere);
  EXPECT_TRUE(becomes_true([&] { return cancelled == 1; }));
}

TEST(TerrainLoader, DestructionCancelsARequest) {
  std::atomic<bool> gate = false;
  std::atomic<int> cancelled = 0;
  {
    TerrainLoader loader(std::make_unique<GatedStore>(gate, cancelled), false);
    loader.request(kHere);
    EXPECT_TRUE(becomes_true([&] { return loader.view()->generation() == 2U; }));
  }
  EXPECT_EQ(cancelled, 1);
}

TEST(TerrainLoader, ASynchronousLoaderShowsTheCompleteRegionAtOnce) {
  std::atomic<bool> gate = false;
  std::atomic<int> cancelled = 0;
  TerrainLoader loader(std::make_unique<GatedStore>(gate, cancelled), true);
  loader.request(kHere);
  EXPECT_EQ(loader.view()->generation(), 3U);
}

}  // namespace
}  // namespace yars::model
