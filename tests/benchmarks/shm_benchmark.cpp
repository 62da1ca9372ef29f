// Benchmark of the containers of shm/ against reference containers in the same run. Medians of interleaved pairs:
//  ring of sweeps    against MemcpyRing (memcpy_ring.hpp); publish and read on one thread, and on two threads
//  lane of events    against boost::lockfree::spsc_queue, two threads
//  LatestValue       alone: time of one read while another thread publishes at 1 kHz
// Prints nanoseconds and the ratio of times, reference / YARS: above 1, YARS is faster.
#include <algorithm>
#include <boost/lockfree/spsc_queue.hpp>
#include <cstdio>
#include <ctime>
#include <memory>
#include <thread>
#include <vector>

#include "databuffer/messages/model_records.hpp"
#include "shm/latest_value.hpp"
#include "shm/ring_buffers.hpp"
#include "tests/benchmarks/memcpy_ring.hpp"
#include "tests/benchmarks/timing.hpp"

namespace {

using namespace yars;
using benchmarks::median;
using databuffer::InputEvent;
using databuffer::Sweep;

constexpr int kPairs = 15;  // measurements of each container
constexpr std::size_t kDepth = 1024;
constexpr std::uint64_t kMaxAhead = 512;  // [records] lead of the producer over the reader, below kDepth: none is lost

double now_ns() {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return 1e9 * static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec);
}

// Time [ns] per record, published and read by the same thread.
template <class Ring>
double one_thread(Ring& ring, const Sweep& record, int count) {
  auto out = std::make_unique<Sweep>();
  std::uint64_t cursor = ring.next();
  const double began = now_ns();
  for (int i = 0; i < count; ++i) {
    ring.publish(record);
    ring.read(cursor, *out);
  }
  return (now_ns() - began) / count;
}

// Time [ns] per record, published by one thread and read by another.
template <class Ring>
double two_threads(Ring& ring, const Sweep& record, std::uint64_t count) {
  auto out = std::make_unique<Sweep>();
  const std::uint64_t first = ring.next();
  std::atomic<std::uint64_t> read{first};
  const double began = now_ns();
  std::thread producer([&] {
    for (std::uint64_t i = first; i < first + count; ++i) {
      while (i - read.load(std::memory_order_acquire) > kMaxAhead) std::this_thread::yield();
      ring.publish(record);
    }
  });
  std::uint64_t cursor = first;
  while (cursor < first + count) {
    if (!ring.read(cursor, *out).delivered) std::this_thread::yield();
    if (cursor % 16 == 0) read.store(cursor, std::memory_order_release);
  }
  producer.join();
  return (now_ns() - began) / static_cast<double>(count);
}

struct OurLane {
  std::unique_ptr<shm::InputLanes<InputEvent, 1, 128>> lanes = std::make_unique<shm::InputLanes<InputEvent, 1, 128>>();
  bool push(const InputEvent& event) { return lanes->push(0, event); }
  bool pop(InputEvent& event) { return lanes->pop(0, event); }
};

struct BoostQueue {
  std::unique_ptr<boost::lockfree::spsc_queue<InputEvent, boost::lockfree::capacity<128>>> queue =
      std::make_unique<boost::lockfree::spsc_queue<InputEvent, boost::lockfree::capacity<128>>>();
  bool push(const InputEvent& event) { return queue->push(event); }
  bool pop(InputEvent& event) { return queue->pop(event); }
};

// Time [ns] per event, passed from one thread to another.
template <class Queue>
double events(Queue queue, int count) {
  const double began = now_ns();
  std::thread producer([&] {
    InputEvent event{};
    for (int i = 0; i < count; ++i) {
      event.number = static_cast<std::uint32_t>(i);
      while (!queue.push(event)) std::this_thread::yield();
    }
  });
  InputEvent event{};
  for (int i = 0; i < count; ++i)
    while (!queue.pop(event)) std::this_thread::yield();
  producer.join();
  return (now_ns() - began) / count;
}

template <class Ours, class Reference>
void compare(const char* name, const char* reference_name, const Ours& ours, const Reference& reference) {
  std::vector<double> ours_ns, reference_ns, ratio;
  for (int pair = 0; pair < kPairs; ++pair) {
    ours_ns.push_back(ours());
    reference_ns.push_back(reference());
    ratio.push_back(reference_ns.back() / ours_ns.back());
  }
  std::printf("%-34s %8.1f ns   %-22s %8.1f ns   ratio %.2f\n", name, median(ours_ns), reference_name,
              median(reference_ns), median(ratio));
}

void rings() {
  auto ours = std::make_unique<shm::BroadcastRing<Sweep, kDepth>>();
  auto reference = std::make_unique<benchmarks::MemcpyRing<Sweep, kDepth>>();
  auto sweep = std::make_unique<Sweep>();
  for (const std::uint32_t samples : {480U, 1024U, 4096U}) {
    sweep->samples = samples;
    const auto name = "ring, " + std::to_string(samples) + " samples, ";
    compare((name + "one thread").c_str(), "memcpy ring", [&] { return one_thread(*ours, *sweep, 50'000); },
            [&] { return one_thread(*reference, *sweep, 50'000); });
    compare((name + "two threads").c_str(), "memcpy ring", [&] { return two_threads(*ours, *sweep, 50'000); },
            [&] { return two_threads(*reference, *sweep, 50'000); });
  }
}

void latest_value() {
  struct Kilobyte {
    std::uint64_t words[128];
  };
  auto value = std::make_unique<shm::LatestValue<Kilobyte>>();
  std::atomic<bool> ending{false};
  std::thread writer([&] {
    Kilobyte record{};
    while (!ending.load(std::memory_order_relaxed)) {
      ++record.words[0];
      value->publish(record);
      const timespec pause{0, 1'000'000};
      nanosleep(&pause, nullptr);
    }
  });
  Kilobyte copy{};
  while (!value->read(copy)) std::this_thread::yield();
  constexpr int kReads = 2'000'000;
  std::vector<double> times;
  times.reserve(kReads);
  std::uint64_t failed = 0;
  for (int i = 0; i < kReads; ++i) {
    const double began = now_ns();
    failed += value->read(copy) ? 0 : 1;
    times.push_back(now_ns() - began);
  }
  ending = true;
  writer.join();
  std::sort(times.begin(), times.end());
  const auto at = [&](double share) { return times[static_cast<std::size_t>(share * (kReads - 1))]; };
  std::printf(
      "LatestValue, 1 KB, writer at 1 kHz: read p50 %.0f ns, p99.9 %.0f ns (clock included), %llu reads failed\n",
      at(0.5), at(0.999), static_cast<unsigned long long>(failed));
}

}  // namespace

int main() {
  rings();
  compare(
      "lane of 56-byte events", "boost spsc_queue", [] { return events(OurLane{}, 500'000); },
      [] { return events(BoostQueue{}, 500'000); });
  latest_value();
  return 0;
}
