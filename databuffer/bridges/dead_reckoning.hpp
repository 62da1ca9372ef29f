// Where an aircraft, ship or vehicle is a while after its last report, or a little before it: along the geodesic of its
// velocity, which itself changes by the acceleration told; attitude by its rates. Heading and velocity turn with the
// meridian, so that it holds near the poles.
#pragma once

#include "databuffer/bridges/external_sample.hpp"
#include "lib/geo/quantity.hpp"

namespace yars::databuffer::bridges {

// The record at that time after the sample; without rates the attitude stands. Angles are wrapped, pitch is held to the
// vertical. The altitude may leave the record's range.
Ownship dead_reckoned(const ExternalSample& sample, geo::Duration after);

}  // namespace yars::databuffer::bridges
