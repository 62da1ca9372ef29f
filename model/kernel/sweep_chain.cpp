#include "model/kernel/sweep_chain.hpp"

#include <xxhash.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "databuffer/messages/derived_values.hpp"
#include "lib/radar/fidelity.hpp"
#include "lib/radar/modes.hpp"
#include "lib/radar/world.hpp"

namespace yars::model::kernel {

namespace {
constexpr XXH64_hash_t kHashSeed = 0;
}  // namespace

void write_header(const SweepHeader& header, databuffer::Sweep& sweep) {
  sweep.apex_latitude_deg = header.apex.latitude_deg;
  sweep.apex_longitude_deg = header.apex.longitude_deg;
  sweep.apex_altitude_msl_m = header.altitude.metres();
  sweep.azimuth_left_deg = header.left.degrees();
  sweep.azimuth_right_deg = header.right.degrees();
  sweep.ground_track_deg = header.ground_track.degrees();
  sweep.elevation_deg = header.elevation.degrees();
  sweep.range_m = header.range.metres();
  sweep.direction = header.direction > 0 ? 1 : 0;
}

physics::SweepGeometry geometry_of(const SweepHeader& header) {
  const geo::Bearing middle = header.left + 0.5 * (header.right - header.left);
  physics::SweepGeometry geometry{header.apex,      header.altitude, header.beam_azimuth.value_or(middle),
                                  header.elevation, header.range,    header.sim_time,
                                  header.band,      header.channel};
  geometry.bars_above = header.bars_above;
  geometry.bars_below = header.bars_below;
  if (header.dbs_cell_width) {
    const double half_rad = 0.5 * header.dbs_cell_width->radians();
    geometry.sharpened_cell = physics::AzimuthInterval{-half_rad, half_rad};
  }
  return geometry;
}

std::uint64_t scan_hash(std::span<const databuffer::Sweep> sweeps) {
  XXH64_hash_t hash = kHashSeed;
  for (const databuffer::Sweep& sweep : sweeps) hash = XXH3_64bits_withSeed(&sweep.hash, sizeof sweep.hash, hash);
  return hash;
}

namespace {
constexpr std::uint32_t kNoEchoFlags = databuffer::kSweepBlank | databuffer::kSweepNoiseOnly;

bool is_beacon(const SweepChain::Labels& labels) {
  return labels.mode == static_cast<std::uint8_t>(radar::Mode::beacon);
}
}  // namespace

SweepChain::SweepChain(const physics::RadarParameters& parameters)
    : beam_(parameters),
      seed_(parameters.seed),
      samples_(rbm::sample_count(parameters)),
      strobes_(parameters),
      beacons_(parameters) {
  for (Measured& measured : measured_) {
    measured.power.assign(samples_, 0.0F);
    measured.steady.reserve(samples_);
  }
}

void SweepChain::use_world(const physics::RadarParameters& parameters, const radar::WorldChanges& changes) {
  beam_.use_world(parameters, changes);
  if (changes.jammers) strobes_.use_jammers(parameters);
}

bool SweepChain::advance(const SweepHeader& header, const Labels& labels, const physics::Environment& environment,
                         databuffer::Sweep& sweep) {
  Measured& measured = measured_[next_];
  next_ = (next_ + 1) % measured_.size();
  measured.header = header;
  measured.labels = labels;
  if (held_ == 0 || (labels.flags & databuffer::kSweepScanStart) != 0U) begin_pass();
  receive(measured, environment);
  const bool ready = held_ > 0;
  if (ready) finish(held_ > 1 ? newest(2) : newest(1), newest(1), newest(0), sweep);
  held_ = std::min<std::size_t>(held_ + 1, 2);
  return ready;
}

void SweepChain::begin_pass() {
  beam_.begin_pass();
  not_ready_until_ns_.reset();
}

void SweepChain::receive(Measured& measured, const physics::Environment& environment) {
  const Labels& labels = measured.labels;
  const physics::SweepGeometry geometry = geometry_of(measured.header);
  const bool blank = (labels.flags & databuffer::kSweepBlank) != 0U;
  measured.steady.clear();
  measured.jamming = blank ? 0.0 : strobes_.level(geometry, environment.terrain);
  if ((labels.flags & kNoEchoFlags) != 0U || labels.no_return) {
    std::fill(measured.power.begin(), measured.power.end(), 0.0F);
  } else if (is_beacon(labels)) {
    beacons_.measure(geometry, environment.terrain, measured.power);
    for (std::size_t i = 0; i < measured.power.size(); ++i)
      if (measured.power[i] > 0.0F) measured.steady.push_back({static_cast<std::uint32_t>(i), measured.power[i]});
  } else {
    physics::Environment in_scan = environment;
    in_scan.scan = labels.scan;
    const std::size_t pending = beam_.measure(geometry, in_scan, measured.power);
    measured.steady.assign(beam_.steady().begin(), beam_.steady().end());
    posts_pending_ += pending;
    if (pending > 0) measured.labels.flags |= databuffer::kSweepNotReady;
    flag_descendant(measured.labels);
  }
}

// Flags a sweep as not ready if it may use what a sweep that was not ready has left.
void SweepChain::flag_descendant(Labels& labels) {
  const auto memory_ns = static_cast<std::int64_t>(std::ceil(beam_.memory().seconds() * 1e9));
  if (memory_ns == 0) return;
  if ((labels.flags & databuffer::kSweepNotReady) != 0U) {
    not_ready_until_ns_ = labels.sim_time_ns + memory_ns;
  } else if (not_ready_until_ns_ && labels.sim_time_ns <= *not_ready_until_ns_) {
    labels.flags |= databuffer::kSweepNotReady;
  }
}

bool SweepChain::flush(databuffer::Sweep& sweep) {
  if (held_ == 0) return false;
  finish(held_ > 1 ? newest(1) : newest(0), newest(0), newest(0), sweep);
  held_ = 0;
  return true;
}

void SweepChain::finish(const Measured& before, const Measured& centre, const Measured& after,
                        databuffer::Sweep& sweep) {
  Labels labels = centre.labels;
  // The smear mixes in the neighbours' power, so their flag kSweepNotReady applies to this sweep too.
  labels.flags |= (before.labels.flags | after.labels.flags) & databuffer::kSweepNotReady;
  physics::PowerWindow window{before.power, centre.power, after.power, centre.jamming};
  window.steady = {before.steady, centre.steady, after.steady};
  finish_sweep(beam_, seed_, centre.header, labels, window, sweep);
}

void finish_sweep(rbm::Beam& beam, std::uint64_t seed, const SweepHeader& header, const SweepChain::Labels& labels,
                  const physics::PowerWindow& window, databuffer::Sweep& sweep) {
  write_header(header, sweep);
  sweep.tick = labels.tick;
  sweep.sim_time_ns = labels.sim_time_ns;
  sweep.epoch = labels.epoch;
  sweep.scan = labels.scan;
  sweep.number = labels.number;
  sweep.samples = static_cast<std::uint32_t>(window.centre.size());
  sweep.flags = labels.flags;
  sweep.mode = labels.mode;
  sweep.gain = labels.gain;
  const std::span<std::uint8_t> video(sweep.video, window.centre.size());
  if ((labels.flags & databuffer::kSweepBlank) != 0U || labels.no_return) {
    std::fill(video.begin(), video.end(), std::uint8_t{0});
  } else {
    physics::PowerWindow amplified = window;
    const physics::SweepGeometry geometry = geometry_of(header);
    amplified.looks = beam.looks(geometry, header.ground_speed, header.ground_track);
    const bool ground = (labels.flags & kNoEchoFlags) == 0U && !is_beacon(labels);
    if (ground) amplified.automatic_gain_db = beam.automatic_gain_db(geometry);
    beam.form_video(amplified, header.range, labels.gain, {seed, labels.scan, labels.number}, video);
  }
  sweep.hash = databuffer::sweep_hash(sweep);
}

}  // namespace yars::model::kernel
