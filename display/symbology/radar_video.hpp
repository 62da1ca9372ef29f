// Radar video on the display: its eight grays, and the sweeps that are stored as wedges.
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

// From the receiver's 8-bit video to light on the glass: eight grays, with the pilot's brightness and contrast.
// Contrast turns the curve about the middle, 8 leaves it as it is; four steps double or halve the slope.
// Brightness is the light of the highest gray: (b / 15)^0.35, so that 0 is dark and 8 is four fifths.
inline constexpr int kGrays = 8;

// [video] -> light 0..1; `brightness` and `contrast` 0..15.
std::array<float, 256> video_light(int brightness, int contrast);

// The sweeps on the glass, each kept as the wedge in which it was measured until a later one sweeps its place.
// Ordered by true azimuth; a new sweep enters in one of five ways: into an empty store, before the first, after
// the last, between two, or in the place of those whose middle its wedge covers. Order runs from the direction
// opposite to the first sweep of a picture.
// The aircraft flies on, so an equal azimuth is not yet the same ground: a covered sweep lies beneath the newer ones
// until their scan has swept its ground from kNearShare of its range on, at the latest until the scan after that; but
// while older sweeps stand beside a narrowed scan, what lies between the two stays.
// What two whole scans have not swept again, because they are narrower or look elsewhere, is erased.
// Holds kRows sweeps; covered ones make way first, then the oldest. A sweep of another mode or epoch begins a new
// picture. Blank sweeps carry no video and are ignored, as are wedges that are not 0-45 degrees wide.
struct StoredSweep {
  double azimuth_key_deg = 0.0;        // [deg] [-180, 180) of the wedge's middle, against the picture's first
  std::uint64_t serial = 0;            // counts insertions: the order of drawing
  int row = 0;                         // of the video
  int samples = 0;                     // used entries of the row
  geo::GeoPoint apex;                  // where it was measured
  geo::Vector3 apex_ecef;              // [m]
  geo::Vector3 left_ecef, right_ecef;  // [m] kEdgeLength_m from the apex along either edge
  geo::Vector3 near_ecef;              // [m] on the middle line, kNearShare of the range from the apex
  geo::Bearing ground_track;           // at the time
  double half_width_rad = 0.0;
  double range_m = 0.0;  // ground range of the far end
  std::uint32_t scan = 0;
  std::optional<std::uint32_t> covered;  // the scan whose wedge has covered its azimuth
};

enum class Insertion : std::uint8_t { ignored, first, before_first, after_last, between, replaced };

class PolarStore {
 public:
  static constexpr int kRows = 2048;          // a scan of as many sweeps as the ring holds, and the one beneath it
  static constexpr int kRowSamples = 1024;    // finer sweeps are averaged down: a glass has fewer pixels along a range
  static constexpr double kNearShare = 0.05;  // nearer ground than this is left open at the edge of a scan

  PolarStore();
  Insertion insert(const databuffer::Sweep& sweep);
  void clear();

  std::span<const StoredSweep> by_azimuth() const { return sweeps_; }
  const StoredSweep* newest() const;
  std::optional<std::uint8_t> mode() const;            // radar::Mode of the picture
  std::span<const std::uint8_t> video(int row) const;  // kRowSamples values, near to far, `samples` of them used
  std::uint64_t version() const { return version_; }   // changes with the content

 private:
  // The azimuths that the scan under way has swept, against its first sweep.
  struct Pass {
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
  int take_row();
  void store_video(const databuffer::Sweep& sweep, StoredSweep& stored);

  std::vector<StoredSweep> sweeps_;
  std::vector<std::uint8_t> video_;
  std::vector<int> free_rows_;
  geo::Bearing reference_;
  Pass pass_;
  std::optional<std::uint32_t> ended_;  // the last scan that came to its end
  std::uint64_t serial_ = 0;
  std::uint64_t version_ = 0;
  std::uint32_t epoch_ = 0;
  std::uint8_t mode_ = 0;
};

}  // namespace yars::display
