// Files .f32 of `yars scan` and `yars patch`: little-endian floats, equal bit by bit to the power that the kernel
// computes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <span>
#include <string>
#include <vector>

#include "config/schema/load.hpp"
#include "model/hrm/patch_formation.hpp"
#include "model/kernel/offline_scan.hpp"
#include "model/kernel/tick_inputs.hpp"
#include "model/terrain/store/directory_store.hpp"
#include "tests/endtoend/process_set.hpp"
#include "tests/model/terrain/formats/dted_builder.hpp"

namespace yars {
namespace {

namespace hrm = model::hrm;
namespace kernel = model::kernel;

constexpr int kSamples = 60, kSize = 48;

std::vector<float> little_endian_floats(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(file)), {});
  EXPECT_EQ(bytes.size() % 4U, 0U);
  std::vector<float> values;
  for (std::size_t at = 0; at + 4 <= bytes.size(); at += 4) {
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < 4; ++i)
      bits |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + i])) << (8U * i);
    values.push_back(std::bit_cast<float>(bits));
  }
  return values;
}

radar::RadarConfiguration default_configuration() {
  return config::load_configuration("")->radar;
}

TEST(FloatFiles, AScanFileHasThePowerOfTheKernelSweepBySweep) {
  const test::TemporaryFolder folder;
  const std::string out = folder.path() / "scan.f32";
  const auto run = endtoend::run_program({"yars", "scan", "--range-nm", "10", "--scan-width", "20", "--samples",
                                          std::to_string(kSamples), "--gain", "1", "--out", out});
  ASSERT_EQ(run.code, 0) << run.errors;

  radar::RadarConfiguration configuration = default_configuration();
  configuration.fidelity.samples = kSamples;
  kernel::ScanRequest request;
  request.pose.position = {37.8, -122.5};
  request.pose.altitude = geo::AltitudeMsl::feet(15000.0);
  request.range = geo::Length::nautical_miles(10.0);
  request.width = geo::Angle::degrees(20.0);
  kernel::OfflineScan scan(configuration, request, 1);
  auto store = model::terrain::open_terrain(configuration.terrain);
  const auto terrain = (*store)->prepare(
      {request.pose.position, request.range.metres(), kernel::scan_detail(configuration.fidelity, request.range)});
  scan.measure({*terrain, nullptr});
  const std::span<const float> power = scan.power();
  ASSERT_EQ(power.size(), scan.headers().size() * kSamples);
  EXPECT_EQ(little_endian_floats(out), std::vector<float>(power.begin(), power.end()));
}

TEST(FloatFiles, APatchFileHasThePowerOfTheKernelFromTheFarEdge) {
  const test::TemporaryFolder folder;
  const std::string out = folder.path() / "map.f32";
  const auto run = endtoend::run_program({"yars", "patch", "--size", std::to_string(kSize), "--out", out});
  ASSERT_EQ(run.code, 0) << run.errors;

  radar::RadarConfiguration configuration = default_configuration();
  configuration.fidelity.map_size = kSize;
  hrm::PatchOrder order;
  order.apex = {37.8, -122.5};
  order.altitude = geo::AltitudeMsl::feet(15000.0);
  order.ground_speed = geo::Speed::knots(480.0);
  order.centre = {37.9, -122.3};
  order.window = geo::Length::nautical_miles(4.7);
  order.map = 1;
  hrm::PatchFormation process(configuration, {});
  const hrm::PatchNeed need = process.begin(order);
  auto store = model::terrain::open_terrain(configuration.terrain);
  process.set_environment({(*store)->prepare(need.window), (*store)->prepare(need.path), nullptr});
  while (process.state() != hrm::PatchState::done) process.advance();
  const auto& power = process.image().power;
  EXPECT_EQ(little_endian_floats(out), std::vector<float>(power.begin(), power.end()));
}

}  // namespace
}  // namespace yars
