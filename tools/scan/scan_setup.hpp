// Options of one scan, and what follows from them. `yars scan` and the Python module share them.
// Inputs: options of a command line. Outputs: configuration, scan request.
// Errors: check_scan() throws CommandFailed.
// Source of names and ranges: docs/commands.md#scan.
#pragma once

#include <optional>
#include <string>

#include "lib/radar/configuration.hpp"
#include "model/kernel/offline_scan.hpp"
#include "tools/command/command.hpp"
#include "tools/command/theatre.hpp"

namespace yars::tools {

struct ScanOptions {
  ConfigurationOptions configuration;
  PoseOptions pose;
  double range_nm = 40.0, width_deg = 100.0, elevation_deg = 0.0, time_s = 0.0;
  std::optional<int> samples;  // nullopt: as configured
  int threads = 1, gain = 3, channel = 1;
  std::string band = "A";
  bool force = false;
};

// Adds the options that select one scan of a radar over a terrain. Terrain, scenes and preset are not among them.
void add_scan_options(databuffer::Command command, ScanOptions& options);

// Changes the configuration by `options`.
void configure_scan(const ScanOptions& options, radar::RadarConfiguration& configuration);

model::kernel::ScanRequest request_of(const ScanOptions& options);

// Checks gimbal limits, before anything is read; and that the aircraft is above the ground. Both pass with `force`.
void check_scan(const ScanOptions& options, const radar::RadarConfiguration& configuration);
void check_scan_height(const ScanOptions& options, const model::terrain::TerrainView& terrain);

}  // namespace yars::tools
