// Radar video on the display: light (0..1) of the eight grays, and a store of sweeps in polar coordinates.
// Inputs: sweeps from radar-model; brightness and contrast as the pilot sets them.
// Outputs: table of light by video level; stored sweeps with their video, sorted by azimuth.
// Source: docs/pilots_manual.md#sweeps, docs/pilots_manual.md#video
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "databuffer/messages/model_records.hpp"
#include "lib/geo/frames.hpp"
#include "lib/geo/quantity.hpp"

namespace yars::display {

inline constexpr int kGrays = 8;

// Light 0..1 for each 8-bit video level, in eight grays. `brightness` and `contrast` are 0..15.
// Contrast changes the slope about the middle gray: 8 is neutral, four steps double or halve it.
// At brightness b the highest gray has the light (b / 15)^0.35: 0 at b = 0, 0.8 at b = 8.
std::array<float, 256> video_light(int brightness, int contrast);

// One sweep as a wedge: the sector of ground in which the sweep was measured.
struct StoredSweep {
  double azimuth_key_deg = 0.0;        // [-180, 180) azimuth of the middle, relative to the middle of the first sweep
  std::uint64_t serial = 0;            // number of the insertion; greater numbers are drawn later
  int row = 0;                         // row of the video, the argument of PolarStore::video
  int samples = 0;                     // used entries of the row
  geo::GeoPoint apex;                  // position of the aircraft
  geo::Vector3 apex_ecef;              // [m]
  geo::Vector3 left_ecef, right_ecef;  // [m] points 1 km from the apex on either edge
  geo::Vector3 near_ecef;              // [m] point on the middle azimuth, at kNearFraction of the range
  geo::Bearing ground_track;           // true, at the time of the sweep
  double half_width_rad = 0.0;
  double range_m = 0.0;  // ground range of the far end
  std::uint32_t scan = 0;
  std::optional<std::uint32_t> covered;  // last scan that covered this sweep (PolarStore); nullopt: none
};

// Position of an inserted sweep in the order by azimuth. ignored: the sweep was not stored. first: the store was empty.
// replaced: the new wedge covers the middle of stored sweeps.
enum class Insertion : std::uint8_t { ignored, first, before_first, after_last, between, replaced };

// Sweeps of one mode and epoch (the picture), sorted by true azimuth. The order begins opposite to the first sweep.
// A sweep of another mode or epoch starts a new picture. Sweeps that are blank, have no position, range or width, or
// are wider than 45 deg, are not stored.
// A blank sweep of this picture with the flag kSweepScanEnd still ends its scan.
// A new wedge covers the stored sweeps whose middle azimuth is inside it. Covered sweeps are drawn below newer sweeps.
// They are not erased at once, because equal azimuth is not equal ground while the aircraft moves.
// A covered sweep is erased
// (1) when the current scan has swept the ground of the covered sweep beyond kNearFraction of the range, or
// (2) when a later scan covers the sweep again.
// Case (2) does not apply while the store has an uncovered sweep that is two or more scans old. This happens after a
// change to a narrower scan.
// Sweeps that two complete scans did not renew are erased. A full store drops covered sweeps first, then the oldest.
class PolarStore {
 public:
  static constexpr int kRows = 2048;             // [sweeps] twice the 1024 sweeps of the session's ring
  static constexpr int kRowSamples = 1024;       // longer sweeps are averaged to at most this many samples
  static constexpr double kNearFraction = 0.05;  // fraction of the range; case (1) ignores nearer ground

  PolarStore();
  Insertion insert(const databuffer::Sweep& sweep);
  void clear();

  std::span<const StoredSweep> by_azimuth() const { return sweeps_; }
  const StoredSweep* newest() const;
  std::optional<std::uint8_t> mode() const;            // radar::Mode of the picture
  std::span<const std::uint8_t> video(int row) const;  // kRowSamples values, near to far, `samples` of them used
  std::uint64_t version() const { return version_; }   // changes with the content
  // Changes when sweeps are erased: any sweeps; sweeps whose ground no newer sweep covers, or not to the same range.
  std::uint64_t erasures() const { return erasures_; }
  std::uint64_t losses() const { return losses_; }

 private:
  // Sector that the current scan has swept, as angles from `first`, the left edge of its first sweep.
  struct SweptSector {
    std::uint32_t scan = 0;
    geo::Bearing first;
    double left_deg = 0.0, right_deg = 0.0;
    void extend(std::uint32_t to_scan, geo::Bearing left, double width_deg);
    bool has_swept(geo::Bearing azimuth) const;
  };

  std::size_t cover(double left_key_deg, double width_deg);
  std::size_t cover_between(double first_key_deg, double last_key_deg);
  void erase_swept(geo::GeoPoint apex);
  void end_scan(std::uint32_t scan);
  template <typename Predicate>
  void erase_if(Predicate gone);
  void give_back(const StoredSweep& erased);
  int take_row();
  void store_video(const databuffer::Sweep& sweep, StoredSweep& stored);

  std::vector<StoredSweep> sweeps_;
  std::vector<std::uint8_t> video_;
  std::vector<int> free_rows_;
  geo::Bearing reference_;
  SweptSector swept_;
  std::optional<std::uint32_t> ended_;  // the last completed scan
  double newest_range_m_ = 0.0;
  std::uint64_t serial_ = 0;
  std::uint64_t version_ = 0, erasures_ = 0, losses_ = 0;
  std::uint32_t epoch_ = 0;
  std::uint8_t mode_ = 0;
};

}  // namespace yars::display
