// Options of one patch map, and what follows from them. `yars patch` and the Python module share them.
// Inputs: options of a command line. Outputs: configuration, order, checks against the radar's limits.
// Errors: the check_... functions throw CommandFailed.
// Source of names and ranges: docs/commands.md#patch.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "lib/radar/configuration.hpp"
#include "model/hrm/patch_formation.hpp"
#include "tools/command/command.hpp"
#include "tools/command/theatre.hpp"

namespace yars::tools {

// Limits of options of a map, beside those of its pose.
inline constexpr Limits kSpeeds_kt{0.0, 10000.0}, kWindows_nm{0.01, 200.0}, kTimes_s{0.0, 1e8}, kLooks{1.0, 16.0};

struct PatchOptions {
  ConfigurationOptions configuration;
  PoseOptions pose;
  double speed_kt = 480.0;
  double target_latitude_deg = 37.9, target_longitude_deg = -122.3, time_s = 0.0;
  std::optional<double> window_nm;  // nullopt: as at power-up
  std::optional<int> looks, size;   // nullopt: as configured
  std::optional<int> threads;       // nullopt: one for each processor
  std::uint64_t map = 1;            // number of the map; selects the noise together with the seed
  bool force = false;
};

// Adds the options that select one map of a radar over a terrain. Terrain, scenes and preset are not among them.
void add_patch_options(databuffer::Command command, PatchOptions& options);

// Changes the configuration by `options`. Throws CommandFailed for a size that the algorithm does not allow.
void configure_patch(const PatchOptions& options, radar::RadarConfiguration& configuration);

model::hrm::PatchOrder order_of(const PatchOptions& options, const radar::RadarConfiguration& configuration);
std::size_t threads_of(const PatchOptions& options);

// Checks the radar's limits, unless `force`; and, always, that the map does not extend behind the aircraft.
void check_order(const model::hrm::PatchOrder& order, const radar::RadarConfiguration& configuration, bool force);
// Checks that the aircraft is above the ground, and that the antenna can look down at the target.
void check_heights(const model::hrm::PatchOrder& order, const model::hrm::PatchEnvironment& environment,
                   const radar::RadarConfiguration& configuration);

// Hash of a picture: XXH3, 64 bits, of its video, row after row.
std::uint64_t picture_hash(std::span<const std::uint8_t> picture);

// Affine transform from pixel to the plane of a GeoTIFF [m], in GDAL's order of coefficients. The map's plane is
// azimuthal equidistant about the aircraft. That plane has the same origin with north up, so the transform rotates by
// the bearing of the map's centre.
std::array<double, 6> plane_from_pixel(const model::hrm::PatchGeometry& geometry, int size);

}  // namespace yars::tools
