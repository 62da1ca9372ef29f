// Data of a Scan: configuration, request, environment, and the computation or its result.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lib/radar/configuration.hpp"
#include "model/kernel/offline_scan.hpp"
#include "radar/ray_samples.hpp"
#include "radar/stores.hpp"
#include "yars/scan.hpp"

namespace yars {

struct Scan::Work {
  radar::RadarConfiguration configuration;
  model::kernel::ScanRequest request;
  int threads = 1;
  std::optional<Scene> scene;
  radar::ScanEnvironment environment;
  std::vector<std::string> left_out;
  std::unique_ptr<model::kernel::OfflineScan> scan;  // null: before run(), and after finish()
  model::kernel::OfflineScan::Result result;         // after finish()
  std::size_t rays = 0;                              // after finish()
  std::optional<ScanLabels> labels;

  // The computation, made at the first call.
  model::kernel::OfflineScan& ready();
  std::span<const databuffer::Sweep> sweeps() const { return scan ? scan->sweeps() : std::span(result.sweeps); }
  std::span<const model::kernel::SweepHeader> headers() const {
    return scan ? scan->headers() : std::span(result.headers);
  }
  std::span<const float> power() const { return scan ? scan->power() : std::span<const float>(result.power); }
  std::vector<radar::RaySample> ray_samples(const parallel::GoesOn& goes_on = {}) const {
    return radar::ray_samples(configuration, headers(), *environment.terrain, goes_on);
  }
};

}  // namespace yars
