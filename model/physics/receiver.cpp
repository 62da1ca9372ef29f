#include "model/physics/receiver.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lib/radar/sensor.hpp"
#include "lib/radar/world.hpp"
#include "model/physics/reflectivity.hpp"

namespace yars::model::physics {

namespace {
constexpr double kDefaultPulse_us = 1.0;        // used if the configuration lists no pulse
constexpr double kRangeTolerance = 1.0 + 1e-9;  // allows for the rounding of ranges converted to metres and back

double gaussian(double angle_rad, double beamwidth_rad) {
  const double beamwidths = angle_rad / beamwidth_rad;
  return std::exp(-kTwoWayExponent * beamwidths * beamwidths);
}

// Integral of the Gaussian pattern from its centre to an angle.
double gaussian_integral(double angle_rad, double beamwidth_rad) {
  const double root = std::sqrt(kTwoWayExponent) / beamwidth_rad;
  return 0.5 * std::sqrt(std::numbers::pi) / root * std::erf(root * angle_rad);
}

// Exponent n of sensitivity time control with which flat land is even in range. Its power before it is proportional to
// G^2 / R^4, with G^2 ~ R^4 of the mapping beam and R^2 of cosecant_squared. The others have the law of clutter in the
// beam's centre.
double even_exponent(radar::BeamPattern pattern) {
  switch (pattern) {
    case radar::BeamPattern::mapping:
      return 0.0;
    case radar::BeamPattern::cosecant_squared:
      return 2.0;
    default:
      return 3.0;
  }
}

// Integral of the pattern from its centre to an angle below the centre (negative: above). For the cosecant patterns the
// centre has the depression `centre_rad`.
double integral_below(radar::BeamPattern pattern, double beamwidth_rad, double centre_rad, double below_rad) {
  switch (pattern) {
    case radar::BeamPattern::hard_edge:
      return std::clamp(below_rad, -0.5 * beamwidth_rad, 0.5 * beamwidth_rad);
    case radar::BeamPattern::gaussian:
      return gaussian_integral(below_rad, beamwidth_rad);
    case radar::BeamPattern::cosecant_squared:
    case radar::BeamPattern::mapping:
      break;
  }
  if (below_rad < 0.0) return gaussian_integral(below_rad, beamwidth_rad);
  const double sine2 = std::pow(std::sin(centre_rad), 2.0);
  const double from = 1.0 / std::tan(centre_rad);
  const double to = 1.0 / std::tan(std::min(centre_rad + below_rad, std::numbers::pi - centre_rad));
  // Integrals of csc^2 and csc^4: -cot x, -cot x - cot^3 x / 3.
  if (pattern == radar::BeamPattern::cosecant_squared) return sine2 * (from - to);
  return sine2 * sine2 * (from - to + (from * from * from - to * to * to) / 3.0);
}
}  // namespace

Receivers::Receivers(const RadarParameters& parameters)
    : ranges_nm_(parameters.ranges_nm), pulse_us_(parameters.pulse_us) {
  const radar::ReceiverConfiguration& settings = parameters.receiver;
  receiver_.azimuth_beamwidth_rad = parameters.azimuth_beamwidth_deg * geo::kRadiansPerDegree;
  receiver_.azimuth_cell_rad = azimuth_cell_rad(receiver_.azimuth_beamwidth_rad);
  receiver_.elevation_beamwidth_rad = parameters.elevation_beamwidth_deg * geo::kRadiansPerDegree;
  const double frequency_db = frequency_term_db(parameters.world.land, settings.frequency_ghz);
  receiver_.land_gamma = ratio(settings.land_gamma_db + frequency_db);
  receiver_.stc_exponent = std::isnan(settings.stc_exponent) ? even_exponent(parameters.beam) : settings.stc_exponent;
  receiver_.automatic_gain = settings.automatic_gain;
  receiver_.noise = ratio(settings.noise_floor_db);
  receiver_.dynamic_range_db = settings.dynamic_range_db;
  receiver_.gain_step_db = settings.gain_step_db;
  receiver_.looks = std::clamp(settings.looks, 0, kMaxLooks);
  receiver_.wavelength_m = wavelength_m(settings.frequency_ghz);
  receiver_.dwell_s = parameters.azimuth_beamwidth_deg / parameters.antenna.azimuth_rate_dps;
  receiver_.sharpened_dwell_s = parameters.high_resolution.dwell_s;
}

// Extent of the pulse in range, c tau / 2: 150 m for 1 microsecond. `range`: the selected range.
geo::Length Receivers::pulse_length(geo::Length range) const {
  const auto& ranges = ranges_nm_;
  const auto& pulses = pulse_us_;
  if (pulses.empty()) return geo::Length::metres(kDefaultPulse_us * kMetresPerMicrosecond);
  std::size_t index = 0;
  while (index + 1 < pulses.size() && index < ranges.size() &&
         range.nautical_miles() > ranges[index] * kRangeTolerance) {
    ++index;
  }
  return geo::Length::metres(pulses[index] * kMetresPerMicrosecond);
}

Receiver Receivers::at(geo::Length range) const {
  Receiver receiver = receiver_;
  receiver.pulse_length_m = pulse_length(range).metres();
  receiver.range_m = range.metres();
  const double bandwidth = pulse_length(kFullScaleRange).metres() / receiver.pulse_length_m;
  receiver.noise *= bandwidth * bandwidth;  // of the noise, and of the full scale, which is proportional to the pulse
  const double sin_grazing = std::numbers::sqrt2 / 2.0;
  const double at_m = kFullScaleRange.metres();
  const double cross_section_m2 = receiver.land_gamma * sin_grazing * at_m * receiver.azimuth_cell_rad *
                                  illuminated_length_m(receiver, at_m, sin_grazing);
  receiver.full_scale = returned_power(cross_section_m2, 1.0, at_m);
  return receiver;
}

int looks_of(const Receiver& receiver, double width_rad, double dwell_s, geo::Speed ground_speed,
             geo::Angle off_track) {
  if (receiver.looks > 0) return receiver.looks;
  const double spread_hz = 2.0 * ground_speed.metres_per_second() * width_rad *
                           std::abs(std::sin(off_track.radians())) / receiver.wavelength_m;
  return static_cast<int>(std::lround(std::clamp(spread_hz * dwell_s, 1.0, static_cast<double>(kMaxLooks))));
}

double illuminated_length_m(const Receiver& receiver, double slant_range_m, double sin_grazing) {
  const double cos_grazing = std::sqrt(std::max(0.0, 1.0 - sin_grazing * sin_grazing));
  // The smaller length has the larger inverse. Inverses avoid a division by zero at 0 and 90 degrees.
  const double pulse_inverse = cos_grazing / receiver.pulse_length_m;
  const double beam_inverse = sin_grazing / (slant_range_m * receiver.elevation_beamwidth_rad);
  return 1.0 / std::max(pulse_inverse, beam_inverse);
}

double returned_power(double cross_section_m2, double gain, double slant_range_m) {
  const double range_squared = slant_range_m * slant_range_m;
  return cross_section_m2 * gain / (range_squared * range_squared);
}

double two_way_gain(radar::BeamPattern pattern, double beamwidth_rad, double antenna_elevation_rad,
                    double elevation_rad) {
  const double below_rad = antenna_elevation_rad - elevation_rad;
  switch (pattern) {
    case radar::BeamPattern::hard_edge:
      return std::abs(below_rad) <= 0.5 * beamwidth_rad ? 1.0 : 0.0;
    case radar::BeamPattern::gaussian:
      return gaussian(below_rad, beamwidth_rad);
    case radar::BeamPattern::cosecant_squared:
    case radar::BeamPattern::mapping:
      break;
  }
  if (below_rad < 0.0) return gaussian(below_rad, beamwidth_rad);
  const double centre_rad = std::max(-antenna_elevation_rad, 0.5 * beamwidth_rad);
  const double sine_ratio = std::sin(centre_rad) / std::max(std::sin(centre_rad + below_rad), std::sin(centre_rad));
  const double square = sine_ratio * sine_ratio;
  return pattern == radar::BeamPattern::mapping ? square * square : square;
}

double beam_integral(radar::BeamPattern pattern, double beamwidth_rad, double antenna_elevation_rad, double from_rad,
                     double to_rad) {
  const double centre_rad = std::max(-antenna_elevation_rad, 0.5 * beamwidth_rad);
  const auto below = [&](double elevation_rad) {
    return integral_below(pattern, beamwidth_rad, centre_rad, antenna_elevation_rad - elevation_rad);
  };
  return to_rad > from_rad ? below(from_rad) - below(to_rad) : 0.0;
}

double azimuth_gain(double beamwidth_rad, double offset_rad) {
  return gaussian(offset_rad, beamwidth_rad);
}

double azimuth_cell_rad(double beamwidth_rad) {
  return std::sqrt(std::numbers::pi / kTwoWayExponent) * beamwidth_rad;
}

double received(const Receiver& receiver, double power, double slant_range_m) {
  return power * time_control(receiver, slant_range_m) / receiver.full_scale;
}

double time_control(const Receiver& receiver, double slant_range_m) {
  if (receiver.stc_exponent == 0.0) return 1.0;
  return std::pow(slant_range_m / kFullScaleRange.metres(), receiver.stc_exponent);
}

double automatic_gain_db(const Receiver& receiver, radar::BeamPattern pattern, geo::AltitudeMsl altitude,
                         geo::Angle antenna_elevation) {
  if (!receiver.automatic_gain) return 0.0;
  constexpr double kLowest_db = -30.0, kHighest_db = 40.0;
  constexpr double kMinAltitude_m = 100.0;  // nearer the ground the level would go to 0
  const double height_m = std::max(altitude.metres(), kMinAltitude_m);
  const double range_m = std::hypot(0.5 * receiver.range_m, height_m);
  const double sine = height_m / range_m;
  const double cross_section_m2 =
      receiver.land_gamma * sine * range_m * receiver.azimuth_cell_rad * illuminated_length_m(receiver, range_m, sine);
  const double gain =
      two_way_gain(pattern, receiver.elevation_beamwidth_rad, antenna_elevation.radians(), -std::asin(sine));
  const double level = received(receiver, returned_power(cross_section_m2, gain, range_m), range_m);
  return std::clamp(-kLandLevel_db - 10.0 * std::log10(std::max(level, 1e-30)), kLowest_db, kHighest_db);
}

double pulse_weight(double pulse_samples, double offset_samples) {
  // Integral of the cell up to an offset, and the integral of that.
  const auto cell = [](double u) { return std::clamp(u + 0.5, 0.0, 1.0); };
  const auto cells = [&](double u) { return u > 0.5 ? u : 0.5 * cell(u) * cell(u); };
  constexpr double kShort = 1e-6;  // [samples] a pulse without extent
  if (pulse_samples < kShort) return cell(offset_samples);
  const double half = 0.5 * pulse_samples;
  return (cells(offset_samples + half) - cells(offset_samples - half)) / pulse_samples;
}

namespace {
constexpr double kMaxPulse = 2.0 * static_cast<double>(PulseSmear::kMaxRadius) - 1.0;  // [samples]
}  // namespace

double point_smear_gain(double pulse_samples) {
  return pulse_samples > 0.0 ? std::min(pulse_samples, kMaxPulse) : 1.0;
}

PulseSmear make_pulse_smear(double pulse_samples) {
  PulseSmear smear;
  const double length = std::min(pulse_samples, kMaxPulse);
  smear.reach = static_cast<std::ptrdiff_t>(std::ceil(0.5 * length));
  for (std::ptrdiff_t offset = -smear.reach; offset <= smear.reach; ++offset) {
    const auto centre = static_cast<double>(offset);
    smear.weights[static_cast<std::size_t>(offset + smear.reach)] =
        pulse_weight(length, centre + 0.5) - pulse_weight(length, centre - 0.5);
  }
  return smear;
}

}  // namespace yars::model::physics
