// The rows of the schema, one function a group of forms.
#pragma once

#include "config/schema.hpp"

namespace yars::config {

std::vector<FormSchema> value_forms();     // colours, lat-long
std::vector<FormSchema> system_forms();    // System, Apg70
std::vector<FormSchema> mode_forms();      // Mode, OffMode, StbyMode, RealBeamMode, SarMode
std::vector<FormSchema> antenna_forms();   // AntennaServo, RbmAntenna
std::vector<FormSchema> display_forms();   // Window, Display and its kin
std::vector<FormSchema> database_forms();  // Database, DedDbase, MgDbase, Terrain
std::vector<FormSchema> model_forms();     // Fidelity, Receiver, Noise
std::vector<FormSchema> route_forms();     // Route, Point

// A form based on another: the base's slots, then its own.
inline std::vector<SlotSchema> with_base(std::vector<SlotSchema> base, const std::vector<SlotSchema>& own) {
  base.insert(base.end(), own.begin(), own.end());
  return base;
}

}  // namespace yars::config
