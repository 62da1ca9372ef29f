// The preset of fidelity that a tick names: it comes into use when a scan begins, and goes when the ticks name the
// configured one again.
#include <gtest/gtest.h>

#include <string_view>

#include "lib/text/plain_text.hpp"
#include "tests/model/kernel/cockpit.hpp"

namespace yars::model::kernel {
namespace {

// As radar-model names it: with its samples, those of the configuration for the configured one.
void name_preset(test::Cockpit& cockpit, std::string_view preset) {
  cockpit.tick.samples = preset == "draft" ? static_cast<std::uint32_t>(radar::fidelity_preset(preset)->samples) : 200U;
  std::fill(std::begin(cockpit.tick.fidelity), std::end(cockpit.tick.fidelity), '\0');
  preset.copy(cockpit.tick.fidelity, sizeof cockpit.tick.fidelity - 1);
}

std::string_view used(const databuffer::ModelStatus& status) {
  return text::text_of(status.fidelity);
}

radar::RadarConfiguration with_200_samples() {
  radar::RadarConfiguration configuration;
  configuration.fidelity.samples = 200;
  return configuration;
}

TEST(PresetChange, ComesIntoUseWithAScanAndGoesWithTheConfiguredName) {
  test::Cockpit cockpit(with_200_samples());
  name_preset(cockpit, "standard");
  cockpit.run(100);
  ASSERT_EQ(cockpit.sweep.samples, 200U);
  name_preset(cockpit, "draft");
  const std::uint32_t scan = cockpit.status().scan;
  const auto first = cockpit.run_until([&](const databuffer::Sweep& sweep) { return sweep.scan != scan; });
  ASSERT_TRUE(first);
  EXPECT_EQ(used(cockpit.status()), "draft");
  cockpit.run(20);
  EXPECT_EQ(cockpit.sweep.samples, static_cast<std::uint32_t>(radar::fidelity_preset("draft")->samples));
  name_preset(cockpit, "standard");
  const std::uint32_t draft_scan = cockpit.status().scan;
  cockpit.run_until([&](const databuffer::Sweep& sweep) { return sweep.scan != draft_scan; });
  cockpit.run(20);
  EXPECT_EQ(used(cockpit.status()), "standard");
  EXPECT_EQ(cockpit.sweep.samples, 200U) << "those of the configuration";
}

TEST(PresetChange, WithinAScanThePresetStays) {
  test::Cockpit cockpit(with_200_samples());
  name_preset(cockpit, "standard");
  cockpit.run(60);
  name_preset(cockpit, "draft");
  const std::uint32_t scan = cockpit.status().scan;
  for (const databuffer::Sweep& sweep : cockpit.run(40)) EXPECT_TRUE(sweep.scan != scan || sweep.samples == 200U);
}

// As after a restart of radar-model, or in a recording that begins within the scan.
TEST(PresetChange, AKernelThatResumesWithinAScanHasThePresetOfTheScan) {
  test::Cockpit cockpit(with_200_samples());
  name_preset(cockpit, "draft");
  cockpit.run_until([&](const databuffer::Sweep& sweep) { return sweep.scan > 1; });
  cockpit.run(20);
  ASSERT_EQ(used(cockpit.status()), "draft");
  test::Cockpit successor(with_200_samples());
  successor.kernel.resume(cockpit.status());
  successor.tick = cockpit.tick;
  const auto expected = cockpit.run(40), sweeps = successor.run(40);
  ASSERT_EQ(sweeps.back().number, expected.back().number);
  ASSERT_EQ(sweeps.back().scan, cockpit.status().scan) << "all in one scan";
  EXPECT_EQ(sweeps.back().samples, static_cast<std::uint32_t>(radar::fidelity_preset("draft")->samples));
  EXPECT_EQ(sweeps.back().hash, expected.back().hash);
}

// The instructor has named another preset within the scan that the status is of.
TEST(PresetChange, AKernelThatResumesBeforeANewPresetIsUsedKeepsTheOldOne) {
  test::Cockpit cockpit(with_200_samples());
  name_preset(cockpit, "standard");
  cockpit.run(60);
  name_preset(cockpit, "draft");
  cockpit.run(10);
  ASSERT_EQ(used(cockpit.status()), "standard");
  test::Cockpit successor(with_200_samples());
  successor.kernel.resume(cockpit.status());
  successor.tick = cockpit.tick;
  const auto expected = cockpit.run(400), sweeps = successor.run(400);
  ASSERT_EQ(sweeps.size(), expected.size());
  EXPECT_EQ(used(successor.status()), "draft") << "the scan behind";
  EXPECT_EQ(sweeps.back().hash, expected.back().hash);
}

TEST(PresetChange, AnUnknownNameChangesNothing) {
  test::Cockpit cockpit(with_200_samples()), other(with_200_samples());
  name_preset(other, "finest");
  const auto expected = cockpit.run(400), sweeps = other.run(400);
  ASSERT_EQ(sweeps.size(), expected.size());
  EXPECT_EQ(sweeps.back().hash, expected.back().hash);
}

}  // namespace
}  // namespace yars::model::kernel
