#include "tools/scan/scan_setup.hpp"

#include "tools/command/input_checks.hpp"

namespace yars::tools {

void add_scan_options(databuffer::Command command, ScanOptions& options) {
  add_pose_options(command, options.pose);
  command.option("--range-nm", options.range_nm, "[NM] range of the scan").range(0.1, 1000.0);
  command.option("--scan-width", options.width_deg, "[deg] width of the scan in azimuth").range(1.0, 120.0);
  command.option("--elevation", options.elevation_deg, "[deg] antenna elevation above the horizontal")
      .range(-90.0, 90.0);
  command.flag("--force", options.force, "allow angles beyond the gimbal limits, and an aircraft below the ground");
  command.option("--samples", options.samples, "samples of a sweep")
      .range(1, radar::kMaxSamples)
      .otherwise("the configuration's");
  command.option("--gain", options.gain, "receiver gain").range(0, 3);
  command.option("--band", options.band, "band of the radar; a jammer acts only in its own bands")
      .one_of({"A", "B", "C", "D", "E"});
  command.option("--channel", options.channel, "frequency channel").range(1, 8);
  command.option("--time-s", options.time_s, "[s] sim time of the first sweep, for moving targets").range(0.0, 1e8);
  command.option("--threads", options.threads, "number of threads").range(1, 256);
  add_seed_option(command, options.configuration);
}

void configure_scan(const ScanOptions& options, radar::RadarConfiguration& configuration) {
  apply_options(options.configuration, configuration);
  if (options.samples) configuration.fidelity.samples = *options.samples;
}

model::kernel::ScanRequest request_of(const ScanOptions& options) {
  model::kernel::ScanRequest request;
  request.pose.position = {options.pose.latitude_deg, options.pose.longitude_deg};
  request.pose.altitude = geo::AltitudeMsl::feet(options.pose.altitude_ft);
  request.pose.platform.heading = geo::Bearing::degrees(options.pose.heading_deg);
  request.pose.platform.ground_track = request.pose.platform.heading;
  request.range = geo::Length::nautical_miles(options.range_nm);
  request.width = geo::Angle::degrees(options.width_deg);
  request.elevation = geo::Angle::degrees(options.elevation_deg);
  request.gain = options.gain;
  request.sim_time_ns = static_cast<std::int64_t>(options.time_s * 1e9);
  request.band = static_cast<std::uint8_t>(options.band.front() - 'A');
  request.channel = static_cast<std::uint8_t>(options.channel);
  return request;
}

void check_scan(const ScanOptions& options, const radar::RadarConfiguration& configuration) {
  if (options.force) return;
  if (const auto problem = beyond_gimbal(geo::Angle::degrees(options.elevation_deg),
                                         geo::Angle::degrees(options.width_deg), configuration.antenna))
    throw_failure(*problem);
}

void check_scan_height(const ScanOptions& options, const model::terrain::TerrainView& terrain) {
  if (options.force) return;
  const geo::GeoPoint position{options.pose.latitude_deg, options.pose.longitude_deg};
  if (const auto problem =
          beneath_ground(geo::AltitudeMsl::feet(options.pose.altitude_ft), terrain.elevation_m(position)))
    throw_failure(*problem);
}

}  // namespace yars::tools
