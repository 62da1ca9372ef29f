#include "display/symbology/radar_video.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "lib/geo/frames.hpp"

namespace yars::display {

namespace {
constexpr float kNeutralContrast = 8.0F;
constexpr float kStepsToDouble = 4.0F;  // contrast steps that double the slope
constexpr float kMaxBrightness = 15.0F;
constexpr float kBrightnessPower = 0.35F;  // the power-up brightness 8 gives 80 % of the light
}  // namespace

std::array<float, 256> video_light(int brightness, int contrast) {
  const float slope = std::exp2((static_cast<float>(contrast) - kNeutralContrast) / kStepsToDouble);
  const float brightness_fraction = std::clamp(static_cast<float>(brightness), 0.0F, kMaxBrightness) / kMaxBrightness;
  const float peak = std::pow(brightness_fraction, kBrightnessPower);
  std::array<float, 256> light{};
  for (std::size_t video = 0; video < light.size(); ++video) {
    const float contrasted = std::clamp(0.5F + (static_cast<float>(video) / 255.0F - 0.5F) * slope, 0.0F, 1.0F);
    const float gray = std::min(std::floor(contrasted * kGrays), kGrays - 1.0F);
    light[video] = peak * gray / (kGrays - 1.0F);
  }
  return light;
}

namespace {

constexpr double kEdgeLength_m = 1000.0;  // relative difference of chord and geodesic: below 1e-8
constexpr double kMaxWidth_deg = 45.0;    // maximum width of a wedge, which is drawn as a quadrangle
constexpr double kRounding_deg = 1e-6;    // tolerance for azimuths computed in earth-centred coordinates

geo::Vector3 on_ellipsoid(geo::GeoPoint point) {
  return geo::ecef_from_geodetic(point, geo::HeightAboveEllipsoid::metres(0.0));
}

StoredSweep stored_sweep_of(const databuffer::Sweep& sweep) {
  StoredSweep stored;
  const geo::Bearing left = geo::Bearing::degrees(sweep.azimuth_left_deg);
  const geo::Bearing right = geo::Bearing::degrees(sweep.azimuth_right_deg);
  const geo::Length edge = geo::Length::metres(kEdgeLength_m);
  stored.apex = {sweep.apex_latitude_deg, sweep.apex_longitude_deg};
  stored.apex_ecef = on_ellipsoid(stored.apex);
  stored.left_ecef = on_ellipsoid(geo::geodesic_direct(stored.apex, left, edge));
  stored.right_ecef = on_ellipsoid(geo::geodesic_direct(stored.apex, right, edge));
  const geo::Bearing middle = left + (right - left) / 2.0;
  const geo::Length near = geo::Length::metres(PolarStore::kNearFraction * sweep.range_m);
  stored.near_ecef = on_ellipsoid(geo::geodesic_direct(stored.apex, middle, near));
  stored.ground_track = geo::Bearing::degrees(sweep.ground_track_deg);
  stored.half_width_rad = (right - left).radians() / 2.0;
  stored.range_m = sweep.range_m;
  stored.scan = sweep.scan;
  return stored;
}

bool key_less(const StoredSweep& sweep, double key_deg) {
  return sweep.azimuth_key_deg < key_deg;
}

}  // namespace

PolarStore::PolarStore() : video_(static_cast<std::size_t>(kRows) * kRowSamples) {
  sweeps_.reserve(kRows + 1);
  clear();
}

void PolarStore::clear() {
  sweeps_.clear();
  swept_ = {};
  ended_.reset();
  free_rows_.resize(kRows);
  for (int row = 0; row < kRows; ++row) free_rows_[static_cast<std::size_t>(row)] = kRows - 1 - row;
  ++version_;
  ++erasures_;
  ++losses_;
}

Insertion PolarStore::insert(const databuffer::Sweep& sweep) {
  const geo::Bearing left = geo::Bearing::degrees(sweep.azimuth_left_deg);
  const double width_deg = (geo::Bearing::degrees(sweep.azimuth_right_deg) - left).degrees();
  if ((sweep.flags & databuffer::kSweepBlank) != 0 || sweep.samples == 0) {
    const bool of_this_picture = !sweeps_.empty() && sweep.epoch == epoch_ && sweep.mode == mode_;
    if (of_this_picture && (sweep.flags & databuffer::kSweepScanEnd) != 0) end_scan(sweep.scan);
    return Insertion::ignored;
  }
  if (!std::isfinite(sweep.apex_latitude_deg) || !std::isfinite(sweep.apex_longitude_deg)) return Insertion::ignored;
  if (!(width_deg > 0.0 && width_deg <= kMaxWidth_deg) || !(sweep.range_m > 0.0)) return Insertion::ignored;

  if (!sweeps_.empty() && (sweep.epoch != epoch_ || sweep.mode != mode_)) clear();
  const geo::Bearing middle = left + geo::Angle::degrees(width_deg / 2.0);
  if (sweeps_.empty()) {
    reference_ = middle;
    epoch_ = sweep.epoch;
    mode_ = sweep.mode;
  }
  const bool was_empty = sweeps_.empty();
  newest_range_m_ = sweep.range_m;
  swept_.extend(sweep.scan, left, width_deg);
  const std::size_t covered = cover((left - reference_).degrees(), width_deg);
  erase_swept({sweep.apex_latitude_deg, sweep.apex_longitude_deg});

  StoredSweep stored = stored_sweep_of(sweep);
  stored.azimuth_key_deg = (middle - reference_).degrees();
  stored.serial = ++serial_;
  stored.row = take_row();
  store_video(sweep, stored);
  const auto position = std::lower_bound(sweeps_.begin(), sweeps_.end(), stored.azimuth_key_deg, key_less);
  const bool at_front = position == sweeps_.begin();
  const bool at_back = position == sweeps_.end();
  sweeps_.insert(position, stored);
  ++version_;
  if ((sweep.flags & databuffer::kSweepScanEnd) != 0) end_scan(sweep.scan);
  if (was_empty) return Insertion::first;
  if (covered > 0) return Insertion::replaced;
  if (at_front) return Insertion::before_first;
  return at_back ? Insertion::after_last : Insertion::between;
}

void PolarStore::SweptSector::extend(std::uint32_t to_scan, geo::Bearing left, double width_deg) {
  if (to_scan != scan || left_deg == right_deg) *this = {to_scan, left, 0.0, 0.0};
  const double from_deg = (left - first).degrees();
  left_deg = std::min(left_deg, from_deg);
  right_deg = std::max(right_deg, from_deg + width_deg);
}

bool PolarStore::SweptSector::has_swept(geo::Bearing azimuth) const {
  const double at_deg = (azimuth - first).degrees();
  return at_deg >= left_deg - kRounding_deg && at_deg <= right_deg + kRounding_deg;
}

std::size_t PolarStore::cover(double left_key_deg, double width_deg) {
  const double right_key_deg = left_key_deg + width_deg;
  std::size_t covered = cover_between(left_key_deg, right_key_deg);
  // A wedge across +180 deg continues at -180 deg.
  if (right_key_deg >= 180.0) covered += cover_between(-180.0, right_key_deg - 360.0);
  return covered;
}

std::size_t PolarStore::cover_between(double first_key_deg, double last_key_deg) {
  const auto begin = std::lower_bound(sweeps_.begin(), sweeps_.end(), first_key_deg, key_less);
  auto end = begin;
  while (end != sweeps_.end() && end->azimuth_key_deg <= last_key_deg) ++end;
  const auto count = static_cast<std::size_t>(end - begin);
  const bool narrowed = std::ranges::any_of(
      sweeps_, [this](const StoredSweep& sweep) { return !sweep.covered && sweep.scan + 1 < swept_.scan; });
  auto kept = begin;
  for (auto at = begin; at != end; ++at) {
    if (at->covered && *at->covered != swept_.scan && !narrowed) {
      give_back(*at);
      continue;
    }
    at->covered = swept_.scan;
    *kept++ = *at;
  }
  sweeps_.erase(kept, end);
  return count;
}

// Counts an erased sweep, whose row another sweep may take.
void PolarStore::give_back(const StoredSweep& erased) {
  constexpr double kRounding = 1.001;  // a sweep with a number of samples that cannot be averaged evenly is shortened
  free_rows_.push_back(erased.row);
  ++erasures_;
  if (!erased.covered || erased.range_m > newest_range_m_ * kRounding) ++losses_;
}

template <typename Predicate>
void PolarStore::erase_if(Predicate gone) {
  std::erase_if(sweeps_, [&](const StoredSweep& sweep) {
    if (!gone(sweep)) return false;
    give_back(sweep);
    return true;
  });
}

// Erases covered sweeps whose near point (near_ecef) is inside the swept sector, seen from the aircraft at `apex`.
// As the aircraft flies, the azimuth of ground beyond the near point changes more slowly than that of the near point.
// The scan has therefore swept that ground, too.
void PolarStore::erase_swept(geo::GeoPoint apex) {
  const geo::LocalTangentFrame here(apex, geo::HeightAboveEllipsoid::metres(0.0));
  erase_if([&](const StoredSweep& sweep) {
    if (!sweep.covered) return false;
    const geo::Vector3 near = here.enu_from_ecef(sweep.near_ecef);
    return swept_.has_swept(geo::Bearing::degrees(std::atan2(near.x, near.y) / geo::kRadiansPerDegree));
  });
}

// Erases the sweeps that neither `scan` nor the completed scan before it has renewed. A scan that a new range or width
// cuts short has no kSweepScanEnd, so it erases no sweep.
void PolarStore::end_scan(std::uint32_t scan) {
  if (ended_ && *ended_ < scan) {
    erase_if([this](const StoredSweep& sweep) { return sweep.scan < *ended_; });
    ++version_;
  }
  ended_ = scan;
}

int PolarStore::take_row() {
  if (free_rows_.empty()) {
    const auto oldest = std::min_element(sweeps_.begin(), sweeps_.end(), [](const auto& a, const auto& b) {
      return a.covered.has_value() != b.covered.has_value() ? a.covered.has_value() : a.serial < b.serial;
    });
    give_back(*oldest);
    sweeps_.erase(oldest);
  }
  const int row = free_rows_.back();
  free_rows_.pop_back();
  return row;
}

void PolarStore::store_video(const databuffer::Sweep& sweep, StoredSweep& stored) {
  const std::size_t samples = std::min<std::size_t>(sweep.samples, radar::kMaxSamples);
  const std::size_t merge = (samples + kRowSamples - 1) / kRowSamples;
  std::uint8_t* row = &video_[static_cast<std::size_t>(stored.row) * kRowSamples];
  stored.samples = static_cast<int>(samples / merge);
  for (int i = 0; i < stored.samples; ++i) {
    std::size_t sum = 0;
    for (std::size_t j = 0; j < merge; ++j) sum += sweep.video[static_cast<std::size_t>(i) * merge + j];
    row[i] = static_cast<std::uint8_t>((sum + merge / 2) / merge);
  }
  // Each stored sample is the mean of `merge` samples. Remaining samples are dropped; the range is shortened to match.
  stored.range_m = sweep.range_m * static_cast<double>(static_cast<std::size_t>(stored.samples) * merge) /
                   static_cast<double>(samples);
}

const StoredSweep* PolarStore::newest() const {
  if (sweeps_.empty()) return nullptr;
  return &*std::max_element(sweeps_.begin(), sweeps_.end(),
                            [](const auto& a, const auto& b) { return a.serial < b.serial; });
}

std::optional<std::uint8_t> PolarStore::mode() const {
  if (sweeps_.empty()) return std::nullopt;
  return mode_;
}

std::span<const std::uint8_t> PolarStore::video(int row) const {
  return {&video_[static_cast<std::size_t>(row) * kRowSamples], static_cast<std::size_t>(kRowSamples)};
}

}  // namespace yars::display
