#include "tools/command/input_checks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lib/radar/gimbal.hpp"
#include "lib/radar/mission.hpp"
#include "lib/radar/sensor.hpp"
#include "lib/text/plain_text.hpp"
#include "model/terrain/store/directory_store.hpp"

namespace yars::tools {

namespace {

constexpr const char* kForce = "or give --force to ignore the limit";
// [deg] A message proposes a heading with this angle between ground track and target, clamped to the limits. The margin
// keeps the proposed heading within the limits when it is rounded to an integer.
constexpr double kProposedOffTrack_deg = 45.0;
constexpr double kHeadingMargin_deg = 1.0;

std::string number(double value, int decimals) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
  return text.data();
}

// At most two decimals, without trailing zeros: 0.67, 3.3, 80.
std::string short_number(double value) {
  std::string text = number(value, 2);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

std::string list_of(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : ", ") + short_number(value);
  return text;
}

// Platform in level flight along the ground track.
radar::Platform level_flight(const model::hrm::PatchOrder& order) {
  return {order.ground_track, {}, {}, order.ground_track};
}

// Advice on a heading that puts the target between blind zone and gimbal limit, on the same side as now.
// `off_track_deg`: angle from the ground track to the target, right positive.
std::string proposed_heading(const geo::GeodesicInverse& to_target, double off_track_deg,
                             const radar::MapLimits& limits) {
  const double min_deg = limits.blind_zone_deg + kHeadingMargin_deg;
  const double max_deg = std::min(limits.antenna.azimuth_limit_deg, 180.0 - limits.blind_zone_deg) - kHeadingMargin_deg;
  if (min_deg > max_deg) return "no heading is possible: the configured gimbal limits lie within the blind zone";
  const double side = off_track_deg < 0.0 ? 1.0 : -1.0;
  const double off_deg = std::clamp(kProposedOffTrack_deg, min_deg, max_deg);
  const geo::Bearing heading = to_target.azimuth_at_start + geo::Angle::degrees(side * off_deg);
  return "give --heading " + number(std::fmod(std::round(heading.degrees()) + 360.0, 360.0), 0);
}

error::Error blind_zone_error(const geo::GeodesicInverse& to_target, double off_deg, const radar::MapLimits& limits) {
  return {"BLIND ZONE",
          "a target " + short_number(limits.blind_zone_deg) + " to " + short_number(180.0 - limits.blind_zone_deg) +
              " deg off the ground track",
          "one " + number(std::abs(off_deg), 1) + " deg off it",
          proposed_heading(to_target, off_deg, limits) + ", " + kForce};
}

error::Error gimbal_error(const geo::GeodesicInverse& to_target, double off_deg, const radar::MapLimits& limits) {
  return {"GIMBAL", "a target within " + short_number(limits.antenna.azimuth_limit_deg) + " deg of the nose",
          "one " + number(std::abs(off_deg), 1) + " deg " + (off_deg < 0.0 ? "left" : "right") + " of it",
          proposed_heading(to_target, off_deg, limits) + ", " + kForce};
}

error::Error depression_error(geo::Angle elevation, const radar::MapLimits& limits) {
  return {"GIMBAL", "a target at most " + short_number(limits.antenna.elevation_limit_deg) + " deg below the horizon",
          "one " + number(-elevation.degrees(), 1) + " deg below it",
          std::string("fly lower or farther away, ") + kForce};
}

error::Error window_error(std::string_view reason, const geo::GeodesicInverse& to_target, geo::Length window,
                          const radar::WindowLimits& table) {
  const auto limits = radar::cursor_limits(window, table);
  const std::string side = short_number(window.nautical_miles());
  if (!limits)
    return {std::string(reason), "a window of the radar: " + list_of(table.windows_nm) + " NM", side + " NM",
            std::string("give one of these as --window-nm, ") + kForce};
  return {std::string(reason),
          "for a window of " + side + " NM a target " + short_number(limits->min.nautical_miles()) + " to " +
              short_number(limits->max.nautical_miles()) + " NM away",
          number(to_target.distance.nautical_miles(), 2) + " NM",
          std::string("move the aircraft or give another --window-nm, ") + kForce};
}

}  // namespace

std::optional<error::Error> beyond_limits(const model::hrm::PatchOrder& order, const radar::MapLimits& limits,
                                          std::optional<double> target_ground_m) {
  const auto reason = radar::map_rejection({order.apex, order.altitude, level_flight(order)},
                                           {order.centre, target_ground_m}, {order.window}, limits);
  if (!reason) return std::nullopt;
  const geo::GeodesicInverse to_target = geo::geodesic_inverse(order.apex, order.centre);
  const double off_deg = (to_target.azimuth_at_start - order.ground_track).degrees();
  if (*reason == "BLIND ZONE") return blind_zone_error(to_target, off_deg, limits);
  if (*reason != "GIMBAL") return window_error(*reason, to_target, order.window, limits.windows);
  if (!target_ground_m || std::abs(off_deg) > limits.antenna.azimuth_limit_deg)
    return gimbal_error(to_target, off_deg, limits);
  return depression_error(radar::elevation_to_ground(order.altitude, to_target.distance, *target_ground_m), limits);
}

std::optional<error::Error> beyond_gimbal(geo::Angle elevation, geo::Angle width,
                                          const radar::AntennaConfiguration& antenna) {
  const auto broken = [](const char* option, double min_deg, double max_deg, geo::Angle found) {
    return error::Error{option,
                        short_number(min_deg) + " to " + short_number(max_deg) + " deg, the configured gimbal limits",
                        short_number(found.degrees()) + " deg", std::string("give an angle within them, ") + kForce};
  };
  const double steepest_deg = antenna.elevation_limit_deg, widest_deg = 2.0 * antenna.azimuth_limit_deg;
  if (std::abs(elevation.degrees()) > steepest_deg)
    return broken("--elevation", -steepest_deg, steepest_deg, elevation);
  if (width.degrees() > widest_deg) return broken("--scan-width", 0.0, widest_deg, width);
  return std::nullopt;
}

std::optional<error::Error> beneath_ground(geo::AltitudeMsl altitude, double ground_m) {
  if (!(altitude.metres() < ground_m)) return std::nullopt;
  return error::Error{
      "--alt-ft",
      "an aircraft above the ground, which is at " + number(geo::Length::metres(ground_m).feet(), 0) + " ft there",
      number(geo::Length::metres(altitude.metres()).feet(), 0) + " ft", std::string("fly higher, ") + kForce};
}

namespace {

// Warns of the number of unreadable files. Throws CommandFailed if all are unreadable. `things`: what
// the files are, in the plural.
void check_unreadable(const Warn& warn, const std::string& subject, const char* things, std::size_t total,
                      std::size_t unreadable) {
  if (unreadable == 0) return;
  const std::string count = std::to_string(unreadable) + " of " + std::to_string(total);
  if (unreadable == total)
    throw_failure({subject, std::string(things) + " that can be read", "none: " + count + " cannot",
                   "see the lines above; repair or replace the files", false});
  warn(count + ' ' + things + " cannot be read; the picture is made without them");
}

}  // namespace

Warn warn_as(const char* command) {
  return [command](const std::string& warning) {
    std::fprintf(stderr, "%s: %s\n", command, text::printable(warning).c_str());
  };
}

void check_terrain_read(const Warn& warn, const std::string& folder, model::terrain::TerrainStore& store,
                        model::terrain::TerrainStore* path_store) {
  std::set<std::string> warned;
  const auto warn_once = [&](const std::vector<std::string>& sentences) {
    for (const std::string& sentence : sentences)
      if (warned.insert(sentence).second) warn(sentence);
  };
  for (model::terrain::TerrainStore* const one : {&store, path_store}) {
    if (one == nullptr) continue;
    warn_once(one->take_problems());
    warn_once(one->take_notes());
  }
  for (model::terrain::TerrainStore* const one : {path_store, &store})
    if (auto* const files = dynamic_cast<model::terrain::DirectoryTerrainStore*>(one)) files->report_again();
  const auto* const directory = dynamic_cast<const model::terrain::DirectoryTerrainStore*>(&store);
  if (directory == nullptr) return;  // the built-in hills have no files
  const model::terrain::RegionCells& cells = directory->region_cells();
  check_unreadable(warn, folder, "cells of the region", cells.files, cells.unreadable);
}

void check_scenes_read(const Warn& warn, model::scene::SceneStore& scenes) {
  for (const std::string& problem : scenes.take_problems()) warn(problem);
  check_unreadable(warn, "--scene", "scenes of the region", scenes.wanted().files, scenes.wanted().unreadable);
}

void LeftOut::add(const std::vector<std::string>& sentences) {
  for (const std::string& sentence : sentences)
    if (std::ranges::find(sentences_, sentence) == sentences_.end()) sentences_.push_back(sentence);
}

void LeftOut::add(const model::terrain::TerrainStore& store) {
  if (const auto* const files = dynamic_cast<const model::terrain::DirectoryTerrainStore*>(&store))
    add(files->left_out());
}

void LeftOut::add(const model::scene::SceneStore& scenes) {
  add(scenes.left_out());
}

void fail_if_left_out(const std::vector<std::string>& left_out) {
  if (!left_out.empty())
    throw_failure({"terrain and scenes", "files that are read whole",
                   text::counted(left_out.size(), "part") + " left out, named above",
                   "repair or remove the files, or leave parts of a scene out with --scene-without", false});
}

}  // namespace yars::tools
