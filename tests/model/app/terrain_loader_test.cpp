// TerrainLoader: intermediate views are available while a region loads, and a newer request cancels an older one.
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

// Store whose views tell the loading progress by their generation. 1: empty region; 2: intermediate view; 3: complete
// region. An incremental load ends when `gate` becomes true. `cancelled` counts the cancelled loads.
class GatedStore final : public terrain::TerrainStore {
 public:
  explicit GatedStore(std::atomic<bool>& gate, std::atomic<int>& cancelled) : gate_(&gate), cancelled_(&cancelled) {}
  terrain::TerrainViewPointer prepare(const terrain::TerrainRegion& region) override {
    return view_of(region.radius_m > 0.0 ? 3 : 1);
  }
  terrain::TerrainViewPointer prepare_in_steps(const terrain::TerrainRegion& region, const Interim& interim) override {
    while (!*gate_) {
      const auto intermediate = view_of(2);
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
