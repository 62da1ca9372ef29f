// The ground along a ray between two distances, in plain double: what the reference raises its horizon with between its
// samples. Steps of a tenth of the posts' spacing, exact geodesic places at most 500 m apart and straight ways in
// latitude and longitude between them: 5 mm off up to 60 degrees of latitude, 0.2 m from 88 to the pole, where places
// lie closer.
// Source: docs/spec/physics.md#shadow.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "lib/geo/geodesic.hpp"
#include "lib/radar/configuration.hpp"
#include "model/rbm/earth.hpp"
#include "model/rbm/look.hpp"
#include "model/rbm/movers.hpp"
#include "model/terrain/terrain_view.hpp"

namespace yars::model::rbm {

class GroundWalk {
 public:
  static constexpr double kStepsAPost = 10.0;

  // All are kept by reference.
  GroundWalk(const Look& look, const EffectiveEarth& earth, const terrain::TerrainView& terrain,
             radar::Interpolation interpolation, double steps_a_post = kStepsAPost)
      : look_(look), earth_(earth), terrain_(terrain), interpolation_(interpolation), steps_a_post_(steps_a_post) {}

  const EffectiveEarth& earth() const { return earth_; }

  // The greatest tangent of the ground strictly between two distances over ground [m]; minus infinity: void all the
  // way, or no posts there.
  double highest_tangent(double from_m, double to_m) const;

  // The horizon of a point between samples: `horizon(i)` is that of all ground up to sample i; what is left of the way
  // to the point is walked.
  template <class Horizon>
  double horizon_before(std::span<const double> distance_m, double point_m, const Horizon& horizon) const {
    const std::size_t nearer = samples_nearer(distance_m, point_m);
    const bool known = nearer > 0 && !std::isnan(distance_m[nearer - 1]);
    const double walked = highest_tangent(known ? distance_m[nearer - 1] : 0.0, point_m);
    return known ? std::max(walked, horizon(nearer - 1)) : walked;
  }

 private:
  double highest_of_pieces(const geo::GeodesicRay& ray, double from_m, double to_m) const;
  // A way that counts as straight in latitude and longitude, `east_deg` unwrapped.
  struct Piece {
    geo::GeoPoint begin;
    double north_deg, east_deg;
    double from_m, to_m;
    terrain::PostSpacing posts;
  };
  double highest_of_piece(const geo::GeodesicRay& ray, double from_m, double to_m, bool with_end) const;
  double highest_of_columns(const Piece& piece) const;
  double tangent_along(const Piece& piece, double share) const;
  double tangent(geo::GeoPoint place, double distance_m) const;

  const Look& look_;
  const EffectiveEarth& earth_;
  const terrain::TerrainView& terrain_;
  radar::Interpolation interpolation_;
  double steps_a_post_;
};

}  // namespace yars::model::rbm
