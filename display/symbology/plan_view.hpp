// Plan view of one picture: projection of ground positions to the display, and conversion of stored sweeps to wedges.
// Inputs: records of the session (DisplayInput), stored sweeps.
// Outputs: positions in display units (draw_list.hpp).
// Frame: geodesic distance and bearing from the apex, ground track up (azimuthal equidistant).
//        On a patch map: the map's apex, and the map's line of sight up.
// Accuracy: a sweep measured at another apex is displaced by d^3 / (6 R^2), 0.1 m after 30 km of flight. d is the
//   distance between the two apexes, R the earth radius.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "databuffer/messages/caption.hpp"
#include "databuffer/messages/model_records.hpp"
#include "databuffer/messages/pictures.hpp"
#include "databuffer/messages/radar_state.hpp"
#include "databuffer/messages/world_state.hpp"
#include "display/symbology/draw_list.hpp"
#include "display/symbology/radar_video.hpp"
#include "lib/geo/geodesy.hpp"
#include "lib/geo/quantity.hpp"

namespace yars::radar {
struct ViewConfiguration;
}  // namespace yars::radar

namespace yars::display {

// Inputs of one picture besides the stored sweeps: copies of the session's records, and which other programs are alive.
struct DisplayInput {
  databuffer::RadarState state{};
  databuffer::ModelStatus model{};
  databuffer::Ownship ownship{};  // true position and motion
  databuffer::Nav nav{};          // navigation data of the same time
  databuffer::PatchMap map{};     // map with the id state.map_shown; another id: that map could not be read
  databuffer::Caption caption{};  // of the tour that runs; step 0: none
  double slant_range_m = std::numeric_limits<double>::quiet_NaN();  // to the designated target; NaN: unknown
  bool state_machine_alive = true;
  bool model_alive = true;
  bool ownship_fresh = true;         // a source still delivers the position and motion of the aircraft
  databuffer::PilotAdvice advice{};  // what each button does; remedy of the message
  bool hints = false;                // a state without a picture says how to get back; OFF says how to switch on
  bool help = false;                 // the help covers the picture
};

// Position, orientation and scale of a picture on the ground.
struct ViewFrame {
  geo::GeoPoint apex;
  geo::Bearing up;       // true bearing that points up: ground track, or line of sight of a map
  double range_m = 0.0;  // selected range, or side length of a patch map
};

// Projection from polar coordinates about the apex to display units. Source: docs/pilots_manual.md#view.
class PlanView {
 public:
  // Fits the configured width and height, in fractions of the selected range, into the square with equal scales.
  // By default the apex is 40 units above the middle of the lower edge, and the range is 400 units long.
  explicit PlanView(const radar::ViewConfiguration& view);
  // The map fills the square. The apex is below the lower edge if it is more than half a window from the map's centre.
  explicit PlanView(const databuffer::PatchMap& map);

  Point apex() const { return apex_; }
  float units_per_range() const { return units_per_range_; }  // [units] length of ViewFrame::range_m

  // `right_deg`: azimuth clockwise from up. `fraction`: distance as a fraction of ViewFrame::range_m.
  Point at_polar(double right_deg, double fraction) const;
  Point at_ground(const ViewFrame& frame, geo::GeoPoint position) const;

 private:
  Point apex_;
  float units_per_range_ = 0.0F;
};

ViewFrame frame_of(const databuffer::PatchMap& map);  // frame of a picture that shows the map

// Upper bound of the displacement [units] that ground within the selected range has between a picture in frame `drawn`
// and a picture in frame `present`. Infinity if the ranges differ.
double displacement_units(const PlanView& view, const ViewFrame& drawn, const ViewFrame& present);

// How far ground within the selected range is displaced between a picture in frame `drawn` and one in frame `present`,
// along the direction up of `drawn` and across it. A turn displaces the far end of the range most, and counts as
// across.
struct Movement {
  double along = 0.0;   // [units] the apex has moved up
  double across = 0.0;  // [units] 0 or greater
};
// nullopt: the ranges differ, or the apexes are more than the range apart.
std::optional<Movement> movement_units(const PlanView& view, const ViewFrame& drawn, const ViewFrame& present);

// Frame of the present picture: the aircraft's position, ground track up. While radar-model is frozen, the frame has
// the apex and ground track of `newest`, the last sweep of the mode shown. nullptr: there is no such sweep, and the
// frame has the aircraft's position and ground track.
ViewFrame present_frame(const DisplayInput& input, const StoredSweep* newest);

// A stored sweep in the present frame [units].
struct Wedge {
  Point apex;                // position of the aircraft at the time of the sweep
  Point left, right;         // unit vectors along the edges
  float range = 0.0F;        // [units] distance of the far end from the apex
  float half_width = 0.0F;   // [rad]
  int row = 0;               // argument of PolarStore::video
  int samples = 0;           // number of samples in the row
  std::uint64_t serial = 0;  // StoredSweep::serial
};

// Replaces `wedges` by the sweeps of the store with a serial above `after`, oldest first; 0: all sweeps. A sweep keeps
// its measured range and azimuth about its own apex. A sweep of a longer range than the frame's is cut off at the
// frame's outer arc.
void place_wedges(const PolarStore& store, const PlanView& view, const ViewFrame& frame, std::vector<Wedge>& wedges,
                  std::uint64_t after = 0);

}  // namespace yars::display
