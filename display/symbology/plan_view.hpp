// Plan view of one picture: its inputs, where ground lies on the display, and its sweeps as wedges.
#pragma once

#include <vector>

#include "databuffer/messages/model_records.hpp"
#include "databuffer/messages/pictures.hpp"
#include "databuffer/messages/radar_state.hpp"
#include "databuffer/messages/world_state.hpp"
#include "display/symbology/draw_list.hpp"
#include "display/symbology/radar_video.hpp"
#include "lib/geo/geodesy.hpp"
#include "lib/geo/quantity.hpp"
#include "lib/radar/configuration.hpp"

namespace yars::display {

// All that one picture is made of, besides the stored sweeps: copies of what the session holds, and who is silent.
struct DisplayInput {
  databuffer::RadarState state{};
  databuffer::ModelStatus model{};
  databuffer::Ownship ownship{};  // present truth
  databuffer::Nav nav{};          // goes with it
  databuffer::PatchMap map{};     // the one that the state shows; another id: it could not be read
  bool state_machine_alive = true;
  bool model_alive = true;
  bool ownship_fresh = true;
};

// Where ground lies on the glass. The view is a plan of the radar's surroundings in fractions of the selected
// range (RadarConfiguration::view), fitted into the square with equal scales; by default the apex is 40 units up
// in the middle and the range is 400 units.
// Ground: geodesic distance and bearing from the frame's apex, the ground track upwards (azimuthal equidistant).
// A patch map fills the square with its window: the same plan about the map's own apex, its line of sight upwards.

// The picture's place on the earth.
struct ViewFrame {
  geo::GeoPoint apex;
  geo::Bearing up;       // true bearing that points up: the ground track, or a map's line of sight
  double range_m = 0.0;  // [m] selected range, or a map's window
};

class PlanView {
 public:
  explicit PlanView(const radar::ViewConfiguration& view);
  explicit PlanView(const databuffer::PatchMap& map);  // far below the glass lies the apex

  Point apex() const { return apex_; }
  float units_per_range() const { return units_per_range_; }  // [units] length of the selected range

  // `right_deg`: clockwise from up [deg]; `fraction` of the selected range.
  Point at_polar(double right_deg, double fraction) const;
  Point at_ground(const ViewFrame& frame, geo::GeoPoint place) const;

 private:
  Point apex_;
  float units_per_range_ = 0.0F;
};

ViewFrame frame_of(const databuffer::PatchMap& map);

// How far a picture drawn in `drawn` is off at its outer edge when `present` is the truth [units].
double displacement_units(const PlanView& view, const ViewFrame& drawn, const ViewFrame& present);

// The frame in which everything is drawn: ground track up, own apex; frozen, the last sweep's.

// `newest` is the last sweep of the mode shown, or null.
ViewFrame present_frame(const DisplayInput& input, const StoredSweep* newest);

// A stored sweep as it lies in the present frame, on the glass.
struct Wedge {
  Point apex;               // where the aircraft was
  Point left, right;        // unit vectors along the edges
  float range = 0.0F;       // [units] of the far end
  float half_width = 0.0F;  // [rad]
  int row = 0;              // of PolarStore::video
  int samples = 0;
  std::uint64_t serial = 0;
};

// All sweeps of the store, oldest first. A sweep's plan is flat about its own apex: exact in range and azimuth
// there; the apex itself is off by distance^3 / (6 R^2), 0.1 m after 30 km of flight.
void place_wedges(const PolarStore& store, const PlanView& view, const ViewFrame& frame, std::vector<Wedge>& wedges);

}  // namespace yars::display
