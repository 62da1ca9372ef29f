// An ownship record as the kernel uses it; nothing comes through that could make a number go astray.
#pragma once

#include <optional>

#include "databuffer/records/model_records.hpp"
#include "lib/geo/geodesic.hpp"
#include "lib/geo/height.hpp"
#include "lib/geo/vector.hpp"
#include "lib/radar/mappable.hpp"
#include "model/antenna/stabilization.hpp"

namespace yars::model::kernel {

struct Pose {
  geo::GeoPoint place;
  geo::AltitudeMsl altitude;
  antenna::Platform platform;
  geo::Speed ground_speed{};
  geo::Vector3 velocity_mps{};  // north, east, down
};

// Nothing if a value is not finite or outside the record's range.
std::optional<Pose> pose_of(const databuffer::Ownship& ownship);

radar::MapViewpoint viewpoint_of(const Pose& pose);

// True if the command asks for a scan in this mode (RBM, HRM PPI, BCN) with a range that can be scanned, [0.01, 1000]
// NM.
bool asks_for_video(const databuffer::RadarCommand& command);

}  // namespace yars::model::kernel
