#include "tools/patch/patch_setup.hpp"

#include <xxhash.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <thread>

#include "lib/radar/mapping.hpp"
#include "tools/command/input_checks.hpp"

namespace yars::tools {

namespace {
namespace hrm = model::hrm;
constexpr int kMaxThreads = 256;
}  // namespace

void add_patch_options(databuffer::Command command, PatchOptions& options) {
  add_pose_options(command, options.pose);
  command.option("--speed-kt", options.speed_kt, "[kt] speed over ground").range(kSpeeds_kt.min, kSpeeds_kt.max);
  command.option("--target-lat", options.target_latitude_deg, "[deg] latitude of the map's centre")
      .range(kLatitudes_deg.min, kLatitudes_deg.max);
  command.option("--target-lon", options.target_longitude_deg, "[deg] longitude of the map's centre")
      .range(kLongitudes_deg.min, kLongitudes_deg.max);
  command.option("--window-nm", options.window_nm, "[NM] side of the map")
      .range(kWindows_nm.min, kWindows_nm.max)
      .otherwise("the configuration's at power-up");
  command.flag("--force", options.force, "ignore the radar's limits; the blind zone stays blank");
  command.option("--looks", options.looks, "number of looks to average")
      .range(static_cast<int>(kLooks.min), static_cast<int>(kLooks.max))
      .otherwise("that of ML1");
  command.option("--size", options.size, "[pixels] per side; up to 1024 with the preset reference")
      .range(16, hrm::max_map_size(radar::Algorithm::standard))
      .otherwise("the configuration's");
  command.option("--time-s", options.time_s, "[s] sim time at the start, for moving targets")
      .range(kTimes_s.min, kTimes_s.max);
  command.option("--threads", options.threads, "number of threads")
      .range(1, kMaxThreads)
      .otherwise("one for each processor");
  add_seed_option(command, options.configuration);
  command.option("--map", options.map, "number of the map; selects the noise together with the seed")
      .range(std::uint64_t{0}, std::uint64_t{std::numeric_limits<std::uint32_t>::max()});
}

void configure_patch(const PatchOptions& options, radar::RadarConfiguration& configuration) {
  apply_options(options.configuration, configuration);
  if (options.size) configuration.fidelity.map_size = *options.size;
  if (const int most = hrm::max_map_size(configuration.fidelity.algorithm); configuration.fidelity.map_size > most)
    throw_failure(error::usage_error("--size", "at most " + std::to_string(most) + " with the algorithm reference",
                                     std::to_string(configuration.fidelity.map_size),
                                     "give a smaller --size, or --fidelity fine"));
}

hrm::PatchOrder order_of(const PatchOptions& options, const radar::RadarConfiguration& configuration) {
  hrm::PatchOrder order;
  order.apex = {options.pose.latitude_deg, options.pose.longitude_deg};
  order.altitude = geo::AltitudeMsl::feet(options.pose.altitude_ft);
  order.ground_track = geo::Bearing::degrees(options.pose.heading_deg);
  order.ground_speed = geo::Speed::knots(options.speed_kt);
  order.centre = {options.target_latitude_deg, options.target_longitude_deg};
  order.window = geo::Length::nautical_miles(options.window_nm.value_or(configuration.window_limits.power_up_nm));
  order.looks = options.looks.value_or(static_cast<int>(configuration.high_resolution.looks.front()));
  order.sim_time = geo::Duration::seconds(options.time_s);
  order.map = static_cast<std::uint32_t>(options.map);
  return order;
}

namespace {
// Minimum target distance as a fraction of the window's side; --force does not override this minimum. Below 0.5 the
// map would extend behind the aircraft. hrm::PatchOrder requires more than 0.71, half the window's diagonal.
constexpr double kMinDistanceFraction = 0.75;
}  // namespace

void check_order(const hrm::PatchOrder& order, const radar::RadarConfiguration& configuration, bool force) {
  if (!force)
    if (const auto problem = beyond_limits(order, configuration)) throw_failure(*problem);
  const double distance_nm = geo::geodesic_inverse(order.apex, order.centre).distance.nautical_miles();
  if (distance_nm < kMinDistanceFraction * order.window.nautical_miles())
    throw_failure(error::usage_error("--target-lat, --target-lon",
                                     "a target at a distance of at least 0.75 of the window's side",
                                     std::to_string(distance_nm) + " NM"));
}

std::size_t threads_of(const PatchOptions& options) {
  const auto processors = static_cast<int>(std::thread::hardware_concurrency());
  return static_cast<std::size_t>(options.threads.value_or(std::clamp(processors, 1, kMaxThreads)));
}

void check_heights(const hrm::PatchOrder& order, const hrm::PatchEnvironment& environment,
                   const radar::RadarConfiguration& configuration) {
  if (const auto problem = beneath_ground(order.altitude, environment.path->elevation_m(order.apex)))
    throw_failure(*problem);
  const double target_ground_m = environment.window->elevation_m(order.centre);
  if (const auto problem = beyond_limits(order, configuration, target_ground_m)) throw_failure(*problem);
}

std::array<double, 6> plane_from_pixel(const model::hrm::PatchGeometry& geometry, int size) {
  const double pixel_m = geometry.window_m() / size;
  const double sine = std::sin(geometry.up().radians());
  const double cosine = std::cos(geometry.up().radians());
  const double left_m = -0.5 * geometry.window_m();
  const double top_m = geometry.distance_m() + 0.5 * geometry.window_m();
  return {left_m * cosine + top_m * sine,  pixel_m * cosine, -pixel_m * sine,
          -left_m * sine + top_m * cosine, -pixel_m * sine,  -pixel_m * cosine};
}

std::uint64_t picture_hash(std::span<const std::uint8_t> picture) {
  return XXH3_64bits(picture.data(), picture.size());
}

}  // namespace yars::tools
