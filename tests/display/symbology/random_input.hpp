// Random inputs of the display: all modes and cursor functions, clusters of points, any cursor, all indications.
#pragma once

#include <array>
#include <cmath>
#include <random>
#include <string>

#include "display/symbology/draw_list.hpp"
#include "tests/display/symbology/display_states.hpp"

namespace yars::display::testing {

class RandomDisplayInput {
 public:
  explicit RandomDisplayInput(unsigned seed) : random_(seed) {}

  DisplayInput next() {
    using radar::Mode;
    const Mode mode = one_of(std::array{Mode::rbm, Mode::hrm, Mode::patch, Mode::beacon, Mode::pvu, Mode::air_to_air,
                                        Mode::ranging, Mode::menu});
    DisplayInput input = operating(mode, one_of(std::array{4.7, 10.0, 20.0, 40.0, 80.0, 160.0}));
    set_indications(input);
    const bool may_show_map = mode == Mode::hrm || mode == Mode::air_to_air || mode == Mode::ranging;
    if (mode == Mode::patch || (may_show_map && chance(0.3))) {
      put_map(input, number(-20.0, 80.0), number(5.0, 60.0), one_of(kWindows_nm));
    }
    if (chance(0.4)) {
      const Point at = anywhere();
      const geo::GeoPoint centre = ground_at(input, at);
      put_forming_map(input, number(-20.0, 80.0), 20.0, one_of(kWindows_nm));
      input.model.map_latitude_deg = centre.latitude_deg;
      input.model.map_longitude_deg = centre.longitude_deg;
    }
    add_cluster_of_points(input);
    if (chance(0.8)) place_cursor(input);
    return input;
  }

  bool chance(double probability) { return number(0.0, 1.0) < probability; }
  double number(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }

 private:
  static constexpr std::array kWindows_nm{0.67, 1.3, 3.3, 4.7, 10.0, 20.0, 40.0};

  template <typename T, std::size_t N>
  T one_of(const std::array<T, N>& all) {
    return all[std::uniform_int_distribution<std::size_t>(0, N - 1)(random_)];
  }
  int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }

  // A random position on the display [units]. 9 of 14 are near fixed texts and scales: at the edges and about the apex.
  Point anywhere() {
    const auto x = static_cast<float>(number(0.0, 480.0)), y = static_cast<float>(number(0.0, 480.0));
    const auto near = static_cast<float>(number(0.0, 50.0));
    switch (whole(0, 13)) {
      case 0:
        return {x, near};
      case 1:
        return {x, kDisplayUnits - near};
      case 2:
        return {near, y};
      case 3:
        return {kDisplayUnits - near, y};
      case 10:  // behind the aircraft
        return {x, 440.0F + 0.8F * near};
      case 11:  // about the gray scale
        return {400.0F + near, static_cast<float>(number(330.0, 440.0))};
      case 12:  // about the message
        return {240.0F + 5.0F * (near - 25.0F), 388.0F + near};
      case 13:  // about the name of the mode
        return {240.0F + 4.0F * (near - 25.0F), 20.0F + near};
      case 4:  // about the apex
        return {240.0F + near - 25.0F, 425.0F + near};
      default:
        return {x, y};
    }
  }

  void set_indications(DisplayInput& input) {
    databuffer::RadarState& state = input.state;
    if (chance(0.05)) state.power = static_cast<std::uint8_t>(radar::Power::standby);
    state.boxed = static_cast<std::uint32_t>(whole(0, 0x1fffff));
    state.brightness = static_cast<std::uint8_t>(whole(0, 15));
    state.cursor_function = static_cast<std::uint8_t>(whole(0, 4));
    state.window_nm = chance(0.8) ? one_of(kWindows_nm) : 0.0;
    if (chance(0.5)) state.flags |= databuffer::kFreeze;
    if (chance(0.3))
      set_text(state.message, one_of(std::array{"MIN RANGE", "BLIND ZONE", "NO RECORDER", "MARK 10",
                                                "A MESSAGE AS LONG AS ONE CAN BE"}));
    if (chance(0.3)) put_update(input, number(-40'000.0, 40'000.0), number(-40'000.0, 40'000.0), whole(-1, 30));
    if (chance(0.1)) state.flags |= databuffer::kUpdateInvalid;
    if (chance(0.3)) put_velocities(input, number(-190.0, 190.0), number(-190.0, 190.0), number(-9.0, 9.0));
    input.model.velocity_beam = static_cast<std::uint8_t>(whole(0, 3));
    input.model.map_timer_s = chance(0.7) ? number(0.0, 400.0) : kNone;
    input.model.antenna_azimuth_deg = chance(0.9) ? number(-64.0, 64.0) : kNone;
    input.model.antenna_elevation_deg = chance(0.9) ? number(-60.0, 60.0) : kNone;
    input.model.scan_centre_deg = number(-50.0, 110.0);
    input.model.scan_width_deg = one_of(std::array{25.0, 50.0, 100.0});
    input.ownship.pitch_deg = number(-30.0, 30.0);
    input.model_alive = !chance(0.05);
    input.ownship_fresh = !chance(0.05);
    input.state_machine_alive = !chance(0.05);
  }

  void add_cluster_of_points(DisplayInput& input) {
    using radar::PointKind;
    const int count = whole(0, radar::kMaxPointsDrawn);
    const int selected = whole(0, radar::kMaxPointsDrawn);
    // [units] half width of the cluster: from points on top of each other to points all over the display.
    const double spread = one_of(std::array{2.0, 10.0, 25.0, 60.0, 200.0});
    const Point middle = anywhere();
    for (int i = 0; i < count; ++i) {
      const Point at{middle.x + static_cast<float>(number(-spread, spread)),
                     middle.y + static_cast<float>(number(-spread, spread))};
      const auto kind = static_cast<PointKind>(whole(0, 4));
      std::string name = std::to_string(10 * whole(0, 9) + i + 1);
      if (kind == PointKind::target) name += ".";
      if (kind == PointKind::steer_offset) name.append(".").append(std::to_string(whole(1, 9)));
      if (kind == PointKind::target_offset) name.append(".").append(std::to_string(whole(10, 99)));
      const geo::GeoPoint position = ground_at(input, at);
      add_point(input, name, kind, position);
      input.state.points[i].selected = i == selected ? 1 : 0;
      const bool target = kind == PointKind::target || kind == PointKind::target_offset;
      if (target && chance(0.6)) {
        put_target(input, position, number(0.0, 360.0), static_cast<databuffer::SteeringLine>(whole(0, 3)));
        set_text(input.state.target_name, name);
      }
    }
  }

  void place_cursor(DisplayInput& input) {
    databuffer::RadarState& state = input.state;
    geo::GeoPoint position = ground_at(input, anywhere());
    if (state.points_drawn > 0 && chance(0.4)) position = {state.points[0].latitude_deg, state.points[0].longitude_deg};
    state.flags |= databuffer::kCursorValid;
    state.cursor_latitude_deg = position.latitude_deg;
    state.cursor_longitude_deg = position.longitude_deg;
    state.cursor_bearing_deg = number(0.0, 360.0);
    state.cursor_range_nm = number(0.0, 170.0);
  }

  std::mt19937 random_;
};

}  // namespace yars::display::testing
