// Flies a recorded track: between two rows along the geodesic at a steady speed, attitude turned the shorter way
// (heading with respect to the geodesic, so that it holds at the poles too); velocity is that of the rows' places.
// At the end it stands where the last row is, or begins anew. It follows its file alone: it cannot be placed, but
// goes on from the time into the track that a predecessor told.
#pragma once

#include "databuffer/flight/flight_model.hpp"
#include "databuffer/flight/leg.hpp"
#include "databuffer/flight/track.hpp"

namespace yars::databuffer::flight {

class TrackFlight final : public FlightModel {
 public:
  explicit TrackFlight(Track track);
  FlightSample step(geo::Duration dt) override;
  void reset() override;
  bool reposition(const Placement& placement) override;
  bool resume(const Ownship& last, geo::Duration gap) override;

 private:
  // Between a row and the next.
  struct Stretch {
    geo::GeodesicRay ray;
    geo::Length length;
    geo::Angle nose_at_start;  // heading against the geodesic
    geo::Angle nose_turn;      // by which that changes until the next row
  };
  static Stretch stretch_between(const TrackRow& from, const TrackRow& to);

  FlightSample present();
  void find_row();
  FlightSample sample_between(double share) const;
  FlightSample sample_at_end() const;

  Track track_;
  geo::Duration elapsed_;  // since the first row
  std::size_t row_ = 0;    // the stretch begins here
  Stretch stretch_;
};

}  // namespace yars::databuffer::flight
