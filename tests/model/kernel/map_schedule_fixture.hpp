// Fixture: a MapSchedule with an aircraft and a pilot's command, stepped tick by tick.
#pragma once

#include <gtest/gtest.h>

#include <optional>

#include "lib/radar/configuration.hpp"
#include "lib/radar/modes.hpp"
#include "model/kernel/map_schedule.hpp"

namespace yars::model::kernel {

inline constexpr double kGround_m = 0.0;

// The aircraft flies north at 480 kt and 15,000 ft. The commanded map of 4.7 NM is 15 NM away at a squint of 30
// degrees.
class MapScheduleTest : public testing::Test {
 protected:
  MapScheduleTest() {
    pose_.position = {37.0, -122.0};
    pose_.altitude = geo::AltitudeMsl::feet(15000.0);
    pose_.platform.heading = pose_.platform.ground_track = geo::Bearing::degrees(0.0);
    pose_.ground_speed = geo::Speed::knots(480.0);
    const geo::GeoPoint target = position_at(30.0, 15.0);
    tick_.command.power = static_cast<std::uint8_t>(radar::Power::operate);
    tick_.command.mode = static_cast<std::uint8_t>(radar::Mode::rbm);
    tick_.command.range_nm = 20.0;
    tick_.command.map_latitude_deg = target.latitude_deg;
    tick_.command.map_longitude_deg = target.longitude_deg;
    tick_.command.map_window_nm = 4.7F;
    tick_.epoch = 1;
    schedule_->step(tick_, pose_, kGround_m);
  }

  geo::GeoPoint position_at(double bearing_deg, double range_nm) const {
    return geo::geodesic_direct(pose_.position, geo::Bearing::degrees(bearing_deg),
                                geo::Length::nautical_miles(range_nm));
  }
  void command_at(double bearing_deg, double range_nm) {
    const geo::GeoPoint target = position_at(bearing_deg, range_nm);
    tick_.command.map_latitude_deg = target.latitude_deg;
    tick_.command.map_longitude_deg = target.longitude_deg;
  }
  void restart() {
    schedule_.emplace(configuration_);
    tick_.command.flags = 0;
    tick_.command.mode = static_cast<std::uint8_t>(radar::Mode::rbm);
    tick_.command.map_request = 0;
    schedule_->step(tick_, pose_, kGround_m);
  }
  databuffer::ModelStatus status() const {
    databuffer::ModelStatus status{};
    schedule_->describe(tick_.tick, status);
    return status;
  }
  void command_map() {
    ++tick_.command.map_request;
    tick_.command.flags |= databuffer::kMapping;
    step();
  }
  void step() {
    ++tick_.tick;
    schedule_->step(tick_, pose_, ground_m_);
  }
  // Steps until the map is due, then completes it. Returns the number of ticks.
  int ticks_until_done() {
    int ticks = 0;
    while (schedule_->forming() && !schedule_->due(tick_.tick) && ticks < 100'000) {
      step();
      ++ticks;
    }
    if (schedule_->forming()) schedule_->complete();
    return ticks;
  }
  // Commands and completes a map within the limits. The next step starts a re-map.
  void show_first_map() {
    restart();
    command_at(30.0, 15.0);
    command_map();
    ticks_until_done();
    show_patch();
  }
  void show_patch() {
    tick_.command.flags &= ~databuffer::kMapping;
    tick_.command.mode = static_cast<std::uint8_t>(radar::Mode::patch);
  }

  radar::RadarConfiguration configuration_;
  Pose pose_;
  double ground_m_ = kGround_m;  // elevation at the next centre
  databuffer::ModelTick tick_{};
  std::optional<MapSchedule> schedule_{configuration_};
};

}  // namespace yars::model::kernel
