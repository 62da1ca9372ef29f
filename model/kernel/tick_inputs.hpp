// Inputs of a scan derived from a tick: ownship (the radar's own aircraft) as a pose, traffic as points, terrain
// detail, fidelity preset.
// Units: records have metres and degrees. Velocities are north, east, down [m/s].
// Errors: an invalid ownship record gives no pose. Processor loads that are not finite are ignored.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <string_view>
#include <vector>

#include "databuffer/messages/model_records.hpp"
#include "databuffer/messages/world_state.hpp"
#include "lib/geo/frames.hpp"
#include "lib/geo/quantity.hpp"
#include "lib/radar/mission.hpp"
#include "lib/values/presets.hpp"
#include "model/antenna/antenna.hpp"
#include "model/physics/environment.hpp"

namespace yars::radar {
struct Fidelity;
}  // namespace yars::radar

namespace yars::model::kernel {

inline constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();  // an unknown value in a status record

// Position, attitude and velocity of the aircraft. All values are finite and within the ranges of a valid record.
struct Pose {
  geo::GeoPoint position;
  geo::AltitudeMsl altitude;
  radar::Platform platform;
  geo::Speed ground_speed{};
  geo::Vector3 velocity_mps{};  // north, east, down
};

// nullopt if a value of the record is not finite or out of range.
std::optional<Pose> pose_of(const databuffer::Ownship& ownship);

radar::MapViewpoint viewpoint_of(const Pose& pose);

// True if the command requests a scan: power switch at OPR (operate), a range of 0.01 to 1000 NM, and one of the modes
// real beam map (RBM), sector scan with Doppler beam sharpening (HRM PPI) and beacon (BCN).
bool requests_scan(const databuffer::RadarCommand& command);

// Traffic of a record as moving points. Each starts at the record's tick from its recorded position.
std::vector<physics::MovingPoint> points_of(const databuffer::Traffic& traffic);

// Terrain detail of a scan with this range (TerrainRegion::detail: posts closer than 2^detail metres are not needed),
// from the fidelity's samples and posts per sample; 0: the finest posts.
int scan_detail(const radar::Fidelity& fidelity, geo::Length range);

// Fidelity `automatic`: moves by at most one preset per scan towards the finest preset with a processor load within a
// configured fraction of a core. The governor uses no clock; the shell measures the load. Ticks record the selected
// preset, so a replay repeats it.
class FidelityGovernor {
 public:
  // `core_share`: maximum fraction of one core, (0, 1].
  explicit FidelityGovernor(double core_share) : core_share_(core_share) {}

  // Presets in ascending order of cost. Those that make a different picture are not included.
  static constexpr auto kLadder = values::kComparablePresets;

  std::string_view preset() const { return kLadder[preset_index_].name; }
  // Records the load [fraction of a core] of a scan with the current preset, and selects the preset of the next scan.
  void record_load(double load);

 private:
  double expected_load(std::size_t index, double load) const;

  double core_share_;
  std::size_t preset_index_ = static_cast<std::size_t>(
      std::ranges::find(kLadder, "standard", &values::ComparablePreset::name) - kLadder.begin());
  struct Measurement {
    double load = 0.0;  // load of the preset's last scan
    int scans_ago = 0;  // number of scans since then
    bool known = false;
  };
  std::array<Measurement, kLadder.size()> measurements_{};
};

}  // namespace yars::model::kernel
