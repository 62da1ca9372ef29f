// After its first scans, a step of the kernel allocates no memory. The test counts all calls of operator new.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "lib/radar/configuration.hpp"
#include "tests/model/kernel/cockpit.hpp"
#include "tests/model/made_up_objects.hpp"

namespace {
std::atomic<long> allocations{0};

void* counted(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
}  // namespace

void* operator new(std::size_t size) {
  return counted(size);
}
void* operator new[](std::size_t size) {
  return counted(size);
}
// std::stable_sort allocates its temporary buffer by the nothrow forms.
void* operator new(std::size_t size, const std::nothrow_t& /*tag*/) noexcept {
  ++allocations;
  return std::malloc(size);
}
void* operator new[](std::size_t size, const std::nothrow_t& /*tag*/) noexcept {
  ++allocations;
  return std::malloc(size);
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete[](void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
  std::free(memory);
}

namespace yars::model::kernel {
namespace {

// Steps 700 ticks with scans, rain, a jammer, a mover and a scene. Returns the number of allocations.
long allocations_of(radar::Algorithm algorithm, int sub_beams = 1) {
  radar::RadarConfiguration configuration;
  configuration.fidelity.sub_beams = sub_beams;
  configuration.fidelity.algorithm = algorithm;
  configuration.fidelity.samples = 64;
  configuration.world.rain.cells.push_back({{37.2, -121.8}, 9000.0, 10.0, 5000.0});
  configuration.world.jamming.jammers.push_back({"jammer", {37.4, -121.6}});
  configuration.world.movers.push_back({"mover", {37.2, -121.8}, 10.0});
  test::Cockpit cockpit(configuration);
  cockpit.scenes =
      test::scene_of({{}, {200.0, 0.0, 300.0, 40.0, 12.0, 3}, {0.0, 300.0, 45.0, 900.0, 0.0, 9}}, {37.2, -121.8});
  databuffer::ModelStatus status{};
  cockpit.run(50);
  ++cockpit.tick.command.scan_restart;
  const long before = allocations.load();
  int sweeps = 0;
  for (int tick = 0; tick < 700; ++tick) {
    if (tick == 300) cockpit.tick.command.range_nm = 80.0;
    cockpit.set_flag(databuffer::kFreeze, tick > 600);
    if (cockpit.step() != nullptr) ++sweeps;
    cockpit.kernel.describe(cockpit.terrain, status);
  }
  EXPECT_GT(sweeps, 400);
  return allocations.load() - before;
}

// Steps through PVU, IPVU (beams between scans) and a patch map. Returns the number of allocations.
long allocations_beside_the_scan() {
  radar::RadarConfiguration configuration;
  configuration.fidelity.samples = 64;
  test::Cockpit cockpit(configuration);
  databuffer::ModelStatus status{};
  cockpit.run(50);
  const long before = allocations.load();
  for (int tick = 0; tick < 3000; ++tick) {
    const auto mode = tick < 1000 ? radar::Mode::pvu : tick < 2500 ? radar::Mode::rbm : radar::Mode::patch;
    cockpit.tick.command.mode = static_cast<std::uint8_t>(mode);
    cockpit.tick.command.map_latitude_deg = 37.1;
    cockpit.tick.command.map_longitude_deg = -121.7;
    cockpit.tick.command.map_window_nm = 4.7F;
    cockpit.set_flag(databuffer::kIpvu, tick > 1200);
    cockpit.step();
    cockpit.kernel.describe(cockpit.terrain, status);
  }
  EXPECT_GT(status.velocity_count, 1U);
  EXPECT_GT(status.map_window_nm, 0.0);
  return allocations.load() - before;
}

TEST(Allocation, TheCounterCounts) {
  const long before = allocations.load();
  int* volatile number = new int(1);  // volatile: a compiler may leave out a pair of new and delete
  delete number;
  EXPECT_GT(allocations.load(), before);
}

TEST(Allocation, AWarmKernelAllocatesNothing) {
  EXPECT_EQ(allocations_of(radar::Algorithm::standard), 0);
  EXPECT_EQ(allocations_of(radar::Algorithm::reference), 0);
  EXPECT_EQ(allocations_of(radar::Algorithm::standard, 13), 0);
  EXPECT_EQ(allocations_beside_the_scan(), 0);
}

}  // namespace
}  // namespace yars::model::kernel
