// Stress of the patch pool: the writer cycles through the slots at full speed, while readers read the newest and the
// oldest map. Each map read is whole. All are threads, so that ThreadSanitizer sees all accesses (preset tsan).
#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

#include "databuffer/session/picture_pool.hpp"
#include "tests/databuffer/session/made_up_map.hpp"
#include "tests/shm/child_process.hpp"

namespace yars::databuffer {
namespace {

using shm::testing::SharedMemory;

constexpr std::uint64_t kMaps = 20'000;

TEST(PatchPoolStress, EveryMapReadIsWholeAndTheRequestedOne) {
  SharedMemory<SessionLayout> layout;
  std::atomic<bool> writing{true};
  std::atomic<std::uint64_t> read{0}, gone{0};
  const auto poll = [&] {
    PatchMap map{};
    std::vector<std::uint8_t> pixels;
    while (writing) {
      const std::uint64_t id = greatest_id<shm::PlainAccess>(layout->patches);
      // The newest map, and the oldest of the 8 in the pool, which is overwritten next.
      for (const std::uint64_t wanted : {id, id < 7 ? id : id - 7}) {
        if (!read_patch(*layout, wanted, map, pixels)) {
          ++gone;
          continue;
        }
        ASSERT_EQ(map.id, wanted);
        ASSERT_TRUE(testing::is_whole(map, pixels));
        ++read;
      }
    }
  };
  std::vector<std::thread> readers;
  for (int i = 0; i < 3; ++i) readers.emplace_back(poll);
  for (std::uint64_t id = 1; id <= kMaps; ++id) {
    const auto size = static_cast<std::uint32_t>(8 + id % 25);
    publish_patch(*layout, testing::made_up_map(id, size), testing::made_up_pixels(id, size), {});
  }
  writing = false;
  for (std::thread& reader : readers) reader.join();
  std::printf("maps read: %lu; overwritten before they were read: %lu\n", read.load(), gone.load());
}

}  // namespace
}  // namespace yars::databuffer
