// Helpers of the tests of config/: fields() gives all values of a configuration as one tuple, for comparison. A new
// member of a structure stops the build here until its tuple has the member. Folder is a temporary folder.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <tuple>

#include "config/schema/load.hpp"
#include "lib/values/fields.hpp"

namespace yars::config::testing {

inline auto fields(const radar::AntennaConfiguration& antenna) {
  const auto& [az_rate, el_rate, az_limit, el_limit, tolerance, drift, az_beam, el_beam, circular, bars, start_az,
               start_el] = antenna;
  return std::tuple(az_rate, el_rate, az_limit, el_limit, tolerance, drift, az_beam, el_beam, circular, bars, start_az,
                    start_el);
}

inline auto fields(const radar::Rgb& color) {
  const auto& [red, green, blue] = color;
  return std::tuple(red, green, blue);
}

inline auto fields(const radar::ViewConfiguration& view) {
  const auto& [width_min, width_max, height_min, height_max, size, arcs, colors] = view;
  const auto& [preset, video, symbols, lines] = colors;
  return std::tuple(width_min, width_max, height_min, height_max, size, arcs, preset, fields(video), fields(symbols),
                    fields(lines));
}

// The value, or -1e9 for NaN, so that two unknown values are equal.
inline double comparable(double value) {
  return std::isnan(value) ? -1e9 : value;
}

inline auto fields(const radar::Fidelity& fidelity) {
  const auto& [name, automatic, share, algorithm, earth, factor, samples, knots, interpolation, posts, beams, slant,
               noise, azimuth, pulse, beam, diffraction, lobes, size, oversampling, layover, response, detail, ground,
               bounce, map_noise] = fidelity;
  return std::tuple(name, automatic, share, algorithm, earth, comparable(factor), samples, knots, interpolation, posts,
                    beams, slant, noise, azimuth, pulse, beam, diffraction, lobes, size, oversampling, layover,
                    response, detail, ground, bounce, map_noise);
}

inline auto fields(const radar::ReceiverConfiguration& receiver) {
  const auto& [frequency, stc, automatic, dynamic, step, floor, land, looks] = receiver;
  return std::tuple(frequency, comparable(stc), automatic, dynamic, step, floor, land, looks);
}

inline auto fields(const radar::HighResolutionConfiguration& map) {
  const auto& [looks, broadening, sidelobes, cap, blind, sector, dwell, step, dynamic, brightest, noise, bounce,
               material, detail] = map;
  return std::tuple(looks, broadening, sidelobes, cap, blind, sector, dwell, step, dynamic, brightest, noise, bounce,
                    material, detail);
}

inline auto fields(const radar::NavigationConfiguration& navigation) {
  const auto& [error_north, error_east, drift_north, drift_east, drift_down, walk, validity, period, noise, model,
               folder, year, beam_azimuths, beam_depressions, dwell] = navigation;
  return std::tuple(error_north, error_east, drift_north, drift_east, drift_down, walk, validity, period, noise, model,
                    folder, year, beam_azimuths, beam_depressions, dwell);
}

inline auto fields(const radar::TerrainConfiguration& terrain) {
  const auto& [directory, sea] = terrain;
  return std::tuple(directory, sea);
}

// An unknown elevation (NaN) becomes -1e9, so that two unknown elevations are equal.
inline auto fields(const radar::RoutePoint& point) {
  const auto& [name, kind, position, elevation] = point;
  const auto& [latitude, longitude] = position;
  return std::tuple(name, kind, latitude, longitude, std::isnan(elevation) ? -1e9 : elevation);
}

inline auto fields(const radar::Material& material) {
  const auto& [code, name, gamma, cardinal, texture] = material;
  return std::tuple(code, name, gamma, cardinal, comparable(texture));
}

// Position and values of an entry of a list of the world.
template <class Entry>
auto given(const Entry& entry) {
  return std::apply(
      [&entry](const auto&... member) {
        return std::tuple(entry.position.latitude_deg, entry.position.longitude_deg, comparable(member(entry))...);
      },
      Entry::Values::members);
}
inline auto fields(const radar::Jammer& jammer) {
  return std::tuple(jammer.name, given(jammer), jammer.band, jammer.channels);
}
inline auto fields(const radar::Mover& mover) {
  return std::tuple(mover.name, given(mover), mover.since / geo::Duration::seconds(1.0), mover.echo, mover.facing_deg,
                    mover.tilt_deg, comparable(mover.displacement_t), comparable(mover.edge_m));
}
template <class Entry>
  requires requires { Entry::Values::list; }
auto fields(const Entry& entry) {
  return given(entry);
}

inline auto fields(const radar::Scene& scene) {
  const auto& [file, position, heading, heights, without] = scene;
  const auto& [latitude, longitude] = position;
  return std::tuple(file, comparable(latitude), comparable(longitude), heading, heights, without);
}

inline auto fields(const radar::Beacon& beacon) {
  const auto& [name, position, altitude, code, delay, replies, spacing, power] = beacon;
  const auto& [latitude, longitude] = position;
  return std::tuple(name, latitude, longitude, comparable(altitude), code, delay, replies, spacing, power);
}

inline auto fields(const radar::DeviceButton& button) {
  const auto& [code, press, release, repeat] = button;
  return std::tuple(code, press, release, repeat);
}

inline auto fields(const radar::DeviceAxis& axis) {
  const auto& [code, use, low, high, centre, dead, curve, inverted, positive, negative, repeat, lowest, highest,
               steps] = axis;
  return std::tuple(code, use, comparable(low), comparable(high), comparable(centre), dead, curve, inverted, positive,
                    negative, repeat, lowest, highest, steps);
}

inline auto fields(const radar::Device& device) {
  const auto& [name, vendor, products, pattern, has, buttons, axes] = device;
  std::vector<decltype(fields(buttons[0]))> all_buttons;
  for (const auto& button : buttons) all_buttons.push_back(fields(button));
  std::vector<decltype(fields(axes[0]))> all_axes;
  for (const auto& axis : axes) all_axes.push_back(fields(axis));
  return std::tuple(name, vendor, products, pattern, has, all_buttons, all_axes);
}

template <class Record>
auto fields_of_all(const std::vector<Record>& records) {
  std::vector<decltype(fields(records[0]))> all;
  all.reserve(records.size());
  for (const Record& record : records) all.push_back(fields(record));
  return all;
}

inline auto fields(const radar::WorldConfiguration& world) {
  const auto& [slope, reference, street, land_texture, materials] = world.land;
  const auto& [state, wind, from, polarization, horizontal, vertical, factor, sea_texture, sea_model, life, specular] =
      world.sea;
  const auto& [a, b, dielectric, k, exponent, cells] = world.rain;
  const auto& [gases, temperature, pressure, water, refractivity, per_km, profile] = world.atmosphere;
  const auto& [radar_power, sidelobes, jammers] = world.jamming;
  const auto& [beacon_code, beacons] = world.beacons;
  const auto lists =
      std::apply([](const auto&... list) { return std::tuple(fields_of_all(list)...); }, radar::lists_of(world));
  return std::tuple(std::tuple(slope, reference, street, comparable(land_texture), fields_of_all(materials)),
                    std::tuple(comparable(state), wind, from, polarization, horizontal, vertical, factor,
                               comparable(sea_texture), sea_model, life, specular),
                    std::tuple(a, b, dielectric, comparable(k), comparable(exponent)),
                    std::tuple(gases, temperature, pressure, water, refractivity, per_km),
                    std::tuple(radar_power, sidelobes), lists, fields_of_all(world.scenes),
                    std::tuple(beacon_code, fields_of_all(beacons)));
}

inline auto fields(const radar::WindowLimits& limits) {
  const auto& [windows, least, greatest, blank_least, blank_windows, blank_up_to, power_up] = limits;
  return std::tuple(windows, least, greatest, blank_least, blank_windows, blank_up_to, power_up);
}

inline auto fields(const radar::HeightRanges& table) {
  const auto& [heights, ranges] = table;
  return std::tuple(heights, ranges);
}

inline auto fields(const radar::NetworkSettings& network) {
  const auto& [name, priority, domain, interfaces, peers, in, out, participants, rows, bytes, security] = network;
  return std::tuple(name, priority, domain, interfaces, peers, in, out, participants, rows, bytes, security);
}

inline auto fields(const radar::RadarConfiguration& configuration) {
  const auto& [name, ranges, widths, windows, pulses, antenna, view, fidelity, receiver, terrain, high, navigation,
               world, route, seed, variation, limits, heights, devices] = configuration;
  std::vector<decltype(fields(route[0]))> points;
  points.reserve(route.size());
  for (const auto& point : route) points.push_back(fields(point));
  return std::tuple(name, ranges, widths, windows, pulses, fields(antenna), fields(view), fields(fidelity),
                    fields(receiver), fields(terrain), fields(high), fields(navigation), fields(world), points, seed,
                    comparable(variation), fields(limits), fields(heights), fields_of_all(devices));
}

// Configuration of a text. A refused text fails the test.
inline LoadedConfiguration loaded(const std::string& text) {
  auto configuration = load_configuration_text(text, "text.guf");
  EXPECT_TRUE(configuration) << configuration.error().message();
  return configuration ? *configuration : LoadedConfiguration{};
}

// Message with which a text is refused. An accepted text fails the test.
inline std::string refusal(const std::string& text) {
  const auto configuration = load_configuration_text(text, "text.guf");
  EXPECT_FALSE(configuration) << text;
  return configuration ? std::string() : configuration.error().message();
}

// Temporary folder with files; the destructor removes both.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "yars_config_XXXXXX").string();
    path_ = ::mkdtemp(name.data());
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((path_ / name).parent_path());
    std::ofstream(path_ / name) << text;
    return path_ / name;
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace yars::config::testing
