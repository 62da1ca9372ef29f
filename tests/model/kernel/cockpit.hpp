// Fixture: a radar kernel with an aircraft and a pilot's command, stepped tick by tick.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "lib/radar/configuration.hpp"
#include "lib/radar/modes.hpp"
#include "model/kernel/radar_kernel.hpp"
#include "tests/model/terrain/shapes.hpp"

namespace yars::test {

class Cockpit {
 public:
  explicit Cockpit(const radar::RadarConfiguration& configuration = {},
                   model::terrain::AnalyticTerrain::Height height = model::terrain::flat(100.0))
      : kernel(configuration), terrain(std::move(height)) {
    tick.ownship.latitude_deg = 37.0;
    tick.ownship.longitude_deg = -122.0;
    tick.ownship.altitude_msl_m = 4572.0;
    tick.ownship.heading_deg = 45.0;
    tick.ownship.velocity_north_mps = 170.0;
    tick.ownship.velocity_east_mps = 170.0;
    tick.ownship.radar_altitude_m = std::numeric_limits<double>::quiet_NaN();
    tick.flags = databuffer::kTickOwnshipValid;
    tick.epoch = 1;
    tick.command.power = static_cast<std::uint8_t>(radar::Power::operate);
    tick.command.mode = static_cast<std::uint8_t>(radar::Mode::rbm);
    tick.command.range_nm = 40.0;
    tick.command.scan_width_deg = 100.0;
    tick.command.antenna_elevation_deg = -4.0;
    tick.command.gain = 3;
    tick.command.cursor_latitude_deg = 37.3;
    tick.command.cursor_longitude_deg = -122.0;
    tick.command.window_nm = 4.7;
  }

  // Steps one tick. Returns its sweep; null if the tick gives none.
  const databuffer::Sweep* step() {
    ++tick.tick;
    tick.sim_time_ns = tick.tick * radar::kTickNanoseconds;
    const bool has_sweep = kernel.step(tick, {terrain, scenes.get(), scenes_ready}, sweep);
    return has_sweep ? &sweep : nullptr;
  }

  // Steps many ticks. Returns their sweeps.
  std::vector<databuffer::Sweep> run(int ticks) {
    std::vector<databuffer::Sweep> sweeps;
    for (int i = 0; i < ticks; ++i) {
      if (const auto* next = step()) sweeps.push_back(*next);
    }
    return sweeps;
  }

  // Steps until a sweep satisfies the condition. Returns nullopt after 10 s of sim time.
  template <class Condition>
  std::optional<databuffer::Sweep> run_until(const Condition& condition) {
    for (int i = 0; i < 2000; ++i) {
      if (const auto* next = step(); next != nullptr && condition(*next)) return *next;
    }
    return std::nullopt;
  }

  databuffer::ModelStatus status() const {
    databuffer::ModelStatus status{};
    kernel.describe(terrain, status);
    return status;
  }

  void set_flag(std::uint32_t flag, bool on) {
    tick.command.flags = on ? tick.command.flags | flag : tick.command.flags & ~flag;
  }

  databuffer::ModelTick tick{};
  model::kernel::RadarKernel kernel;
  model::terrain::AnalyticTerrain terrain;
  model::scene::SceneViewPointer scenes;  // none at first
  bool scenes_ready = true;
  databuffer::Sweep sweep{};
};

inline bool is_scan_start(const databuffer::Sweep& sweep) {
  return (sweep.flags & databuffer::kSweepScanStart) != 0U;
}
inline bool is_scan_end(const databuffer::Sweep& sweep) {
  return (sweep.flags & databuffer::kSweepScanEnd) != 0U;
}

}  // namespace yars::test
