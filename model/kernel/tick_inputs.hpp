// Inputs of a scan from tick to tick: ownship, traffic, terrain detail, and the preset that time allows.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "databuffer/messages/model_records.hpp"
#include "databuffer/messages/world_state.hpp"
#include "lib/geo/frames.hpp"
#include "lib/geo/quantity.hpp"
#include "lib/radar/configuration.hpp"
#include "lib/radar/mapping.hpp"
#include "model/antenna/antenna.hpp"
#include "model/physics/environment.hpp"

namespace yars::model::kernel {

// An ownship record as the kernel uses it; nothing comes through that could make a number go astray.
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

// The traffic that a tick latched, as points that the radar sees.
// Each goes on from where it was at the tick at which it was latched.
std::vector<physics::MovingPoint> points_of(const databuffer::Traffic& traffic);

// How fine the terrain of a scan has to be: the fidelity's posts a sample at a range. "A scene costs what is in view."
// Of TerrainRegion; 0 = the finest.
int scan_detail(const radar::Fidelity& fidelity, geo::Length range);

// Fidelity `automatic`: picks the finest preset that holds a share of a core, from what each scan took. Pure: the shell
// measures, the tick log records what was picked, so a replay follows it.
class FidelityGovernor {
 public:
  // `core_share` of one core, (0, 1].
  explicit FidelityGovernor(double core_share) : core_share_(core_share) {}

  // From least to most work; "1996" is another picture, not another price.
  static constexpr std::array<std::string_view, 4> kLadder{"draft", "standard", "fine", "reference"};

  std::string_view preset() const { return kLadder[rung_]; }
  // A scan at the present preset took this share of a core.
  void scanned(double load);

 private:
  double expected_load(std::size_t rung, double load) const;

  double core_share_;
  std::size_t rung_ = 1;
  struct Memory {
    double load = 0.0;  // when it was last in force
    int scans_ago = 0;
    bool known = false;
  };
  std::array<Memory, kLadder.size()> memory_{};
};

}  // namespace yars::model::kernel
