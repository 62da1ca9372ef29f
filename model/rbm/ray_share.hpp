// Which part of the beam a ray stands for, where points are concerned: of several rays across the beam each sees those
// in its own part, so that none is seen twice; of a sharpened beam a ray sees its resolution cell and nothing else.
#pragma once

#include <limits>

namespace yars::model::rbm {

// Angles off the ray's azimuth [rad], clockwise. A ray alone stands for all of the beam about it.
struct RayShare {
  double left_rad = -std::numeric_limits<double>::infinity();
  double right_rad = std::numeric_limits<double>::infinity();
  double beam_rad = 0.0;   // where the beam's centre is
  double factor = 1.0;     // on what the pattern gives: 1 over the weight that the ray is joined with
  bool sharpened = false;  // [left, right] is one cell of a synthetic aperture
};

struct Angles {
  double left_rad = 0.0, right_rad = 0.0;
};

// Where a ray sees points, at most two beam widths off the beam's centre: beyond they are 96 dB down.
Angles seen_angles(const RayShare& share, double beamwidth_rad);

// Two-way gain in azimuth of a point that is so wide [rad]. A sharpened cell gathers for as long as the real beam would
// take ground of its width in: what ground is scaled by the beam's width a point gains.
double azimuth_share(const RayShare& share, double beamwidth_rad, double off_rad, double wide_rad = 0.0);

}  // namespace yars::model::rbm
