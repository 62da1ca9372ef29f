// The rows of the schema, one function a group of forms.
#pragma once

#include "config/schema.hpp"

namespace yars::config {

std::vector<FormSchema> value_forms();       // colours, lat-long
std::vector<FormSchema> system_forms();      // System, Apg70
std::vector<FormSchema> mode_forms();        // Mode, OffMode, StbyMode, RealBeamMode, SarMode
std::vector<FormSchema> antenna_forms();     // AntennaServo, RbmAntenna
std::vector<FormSchema> display_forms();     // Window, Display and its kin
std::vector<FormSchema> database_forms();    // Database, DedDbase, MgDbase, Terrain
std::vector<FormSchema> model_forms();       // Fidelity, Receiver, Noise
std::vector<FormSchema> route_forms();       // Route, Point
std::vector<FormSchema> world_forms();       // Land, Materials, Material, Sea, Rain, RainCell
std::vector<FormSchema> navigation_forms();  // Navigation
std::vector<FormSchema> traffic_forms();     // Jammers, Jammer, Movers, Mover, Scenes, Scene
std::vector<FormSchema> limit_forms();       // WindowLimits, HeightRanges
std::vector<FormSchema> beacon_forms();      // Beacons, Beacon
std::vector<FormSchema> device_forms();      // Devices, Device, Button, Axis

// The windows that can be selected are those of SarMode; where they can be mapped tells WindowLimits.
std::optional<Complaint> check_windows_have_limits(const Draft& draft);

inline SlotSchema number_slot(std::string_view name, std::string_view unit, double lowest, double highest,
                              NumberSlot binding, std::string_view purpose) {
  return {.name = name, .unit = unit, .lowest = lowest, .highest = highest, .binding = binding, .purpose = purpose};
}

inline SlotSchema latitude_slot(double& (*of)(Draft&)) {
  return {.name = "latitude",
          .unit = "deg",
          .lowest = -90,
          .highest = 90,
          .binding = AngleSlot{of, true},
          .purpose = "WGS84, north positive"};
}

inline SlotSchema longitude_slot(double& (*of)(Draft&)) {
  return {.name = "longitude",
          .unit = "deg",
          .lowest = -180,
          .highest = 180,
          .binding = AngleSlot{of, false},
          .purpose = "WGS84, east positive"};
}

// A form based on another: the base's slots, then its own.
inline std::vector<SlotSchema> with_base(std::vector<SlotSchema> base, const std::vector<SlotSchema>& own) {
  base.insert(base.end(), own.begin(), own.end());
  return base;
}

}  // namespace yars::config
