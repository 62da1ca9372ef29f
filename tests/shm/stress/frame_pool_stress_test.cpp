// Stress of the frame pool: a writer of display frames is killed repeatedly, while a reader reads the newest frame.
// Each frame read is whole. A second test uses threads, of which ThreadSanitizer sees all accesses (preset tsan).
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <random>
#include <thread>
#include <vector>

#include "databuffer/session/picture_pool.hpp"
#include "tests/shm/child_process.hpp"

namespace yars::databuffer {
namespace {

using shm::testing::ChildProcess;
using shm::testing::SharedMemory;
using shm::testing::wait_until;

// Size and tone (brightness) differ between successive frames, so that a rest of an older frame is detected. All pixels
// of a frame have one tone, because that costs the writer little time outside of the pool.
std::uint8_t tone_of(std::uint64_t id) {
  return static_cast<std::uint8_t>(id * 31);
}

GlassFrame made_up_frame(std::uint64_t id) {
  GlassFrame frame{};
  frame.id = id;
  frame.tick = static_cast<std::int64_t>(3 * id);
  frame.sim_time_ns = static_cast<std::int64_t>(7 * id);
  frame.width = static_cast<std::uint32_t>(160 + id % 41);
  frame.height = static_cast<std::uint32_t>(160 + id % 17);
  return frame;
}

void publish(SessionLayout& layout, std::uint64_t id, std::vector<std::uint8_t>& pixels) {
  const GlassFrame frame = made_up_frame(id);
  pixels.assign(frame_bytes(frame), tone_of(id));
  publish_frame(layout, frame, pixels);
}

// 0: the frame is whole. 1: wrong times. 2: wrong size. 3: wrong pixels.
int flaw_of(const GlassFrame& frame, const std::vector<std::uint8_t>& pixels) {
  const GlassFrame wanted = made_up_frame(frame.id);
  if (frame.tick != wanted.tick || frame.sim_time_ns != wanted.sim_time_ns) return 1;
  if (frame.width != wanted.width || frame.height != wanted.height || pixels.size() != frame_bytes(wanted)) return 2;
  const bool whole = std::ranges::all_of(pixels, [&](std::uint8_t pixel) { return pixel == tone_of(frame.id); });
  return whole ? 0 : 3;
}

class Reader {
 public:
  explicit Reader(const SessionLayout& layout) : layout_(layout) {}
  void poll() {
    if (!read_newest_frame(layout_, last_, frame_, pixels_)) return;
    ASSERT_GT(frame_.id, last_) << "ids increase";
    ASSERT_EQ(flaw_of(frame_, pixels_), 0) << "frame " << frame_.id;
    last_ = frame_.id;
    ++read_;
  }
  std::uint64_t read() const { return read_; }

 private:
  const SessionLayout& layout_;
  GlassFrame frame_{};
  std::vector<std::uint8_t> pixels_;
  std::uint64_t last_ = 0, read_ = 0;
};

TEST(FramePoolStress, AWriterKilledAtRandomTimesLeavesWholeFramesAndItsSuccessorContinues) {
  constexpr int kKills = 60;
  SharedMemory<SessionLayout> layout;
  std::mt19937 random(11);
  Reader reader(*layout);
  std::vector<std::uint8_t> first;
  for (std::uint64_t id = 1; id <= kFrameSlots; ++id) publish(*layout, id, first);
  int while_writing = 0;  // kills while a frame was being written, which leaves one slot without an id
  for (int kill = 0; kill < kKills; ++kill) {
    const std::uint64_t begin = greatest_id<shm::PlainAccess>(layout->frames);
    ChildProcess writer([&] {
      std::vector<std::uint8_t> pixels;
      for (std::uint64_t id = begin + 1;; ++id) publish(*layout, id, pixels);
    });
    const std::uint64_t life = 1 + random() % 300;
    ASSERT_TRUE(wait_until([&] {
      reader.poll();
      return greatest_id<shm::PlainAccess>(layout->frames) >= begin + life;
    })) << "the writer after a killed writer makes no progress";
    writer.kill_now();
    while_writing += std::ranges::count(layout->frames, 0U, [](const FrameSlot& slot) { return slot.id.load(); }) > 0;
    GlassFrame frame{};
    std::vector<std::uint8_t> pixels;
    ASSERT_TRUE(read_newest_frame(*layout, 0, frame, pixels)) << "the newest frame remains";
    ASSERT_EQ(flaw_of(frame, pixels), 0);
    ASSERT_GE(frame.id, begin + life);
  }
  EXPECT_GT(while_writing, 0);
  std::printf("writers killed: %d, %d of them within a frame; frames read: %lu\n", kKills, while_writing,
              reader.read());
}

TEST(FramePoolStress, EveryFrameReadIsWhole) {
  constexpr std::uint64_t kFrames = 8'000;
  SharedMemory<SessionLayout> layout;
  std::atomic<bool> writing{true};
  std::atomic<std::uint64_t> read{0};
  std::vector<std::thread> readers;
  for (int i = 0; i < 3; ++i)
    readers.emplace_back([&] {
      Reader reader(*layout);
      while (writing && !::testing::Test::HasFatalFailure()) reader.poll();
      read += reader.read();
    });
  std::vector<std::uint8_t> pixels;
  for (std::uint64_t id = 1; id <= kFrames; ++id) publish(*layout, id, pixels);
  writing = false;
  for (std::thread& reader : readers) reader.join();
  EXPECT_GT(read, 0U);
  std::printf("frames read: %lu\n", read.load());
}

}  // namespace
}  // namespace yars::databuffer
