// The loops of the standard algorithm from power to video, by vectors (Highway, chosen at run time; equal bits on every
// target).
#pragma once

#include <cstddef>
#include <cstdint>

#include "model/rbm/noise.hpp"

namespace yars::model::rbm::lanes {

// variate[cell] = gamma-distributed variate of mean 1 and `looks` looks, for resolution cells 0..cells-1; 16 entries
// more are overwritten.
void speckle(std::size_t cells, NoiseState state, int looks, float* variate);

struct VideoInputs {
  const float* before;  // power of three sweeps, `count` entries each
  const float* centre;
  const float* after;
  const float* weights;      // of the three
  float noise;               // added to their sum
  const float* variate;      // of each resolution cell; null: no speckle; 16 entries more are read
  const std::int32_t* cell;  // of each sample, neighbours in the same or the next; null: each its own; 16 more are read
  float gain_db;
  float decibels_per_scale;
};

// Joined sweeps and noise, speckle, log receiver: video = 255 (1 + (10 log10 power + gain_db) / decibels_per_scale),
// clipped. `video` has exactly `count` entries.
void develop(std::size_t count, const VideoInputs& inputs, std::uint8_t* video);

}  // namespace yars::model::rbm::lanes
