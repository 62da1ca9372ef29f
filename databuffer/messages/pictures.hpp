// Records of the pictures in a session: patch maps and frames of the display.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace yars::databuffer {

// Ids of the pictures in a session, patch maps and frames of the glass: they count up from 1. A greater one is damage:
// at a thousand a second a session comes to it in 280,000 years.
inline constexpr std::uint64_t kLatestPictureId = std::uint64_t{1} << 53U;

inline constexpr std::uint32_t kMaxPatchPixels = 1024;  // on an edge

inline constexpr std::uint32_t kPatchNotReady = 1U;     // some posts were not loaded yet
inline constexpr std::uint32_t kPatchBlind = 2U;        // part of it lies in the blind zone and is blank
inline constexpr std::uint32_t kPatchWindowBlank = 4U;  // its window was chosen by range: none was selected

// What a patch map is and where it lies on the earth: goes with the pixels of its slot. The picture is square, row 0
// at the far edge, line of sight up, 0 black to 255 white. A place on the picture: right and up of the centre [m] are
// those of the plane that keeps distance and bearing from the apex (azimuthal equidistant), turned so that the bearing
// of the centre points up.
struct PatchMap {
  std::uint64_t id;            // counts up over the session; 0 = no map
  std::int64_t start_tick;     // when the radar began it
  std::int64_t end_tick;       // when it was complete
  double latitude_deg;         // [deg] centre
  double longitude_deg;        // [deg]
  double elevation_msl_m;      // [m] of the plane on which it is drawn
  double up_deg;               // [deg] true bearing of the centre from the apex
  double window_nm;            // [NM] edge
  double apex_latitude_deg;    // [deg] the aircraft at the start
  double apex_longitude_deg;   // [deg]
  double apex_altitude_msl_m;  // [m]
  double distance_m;           // [m] over ground, apex to centre
  double squint_deg;           // [deg] line of sight against the ground track, right positive
  double resolution_m;         // [m] of a cell in range and azimuth
  double formation_s;          // [s] that the radar took
  std::uint64_t hash;          // XXH3 64 of the fields above but for id and ticks, then of the pixels
  std::uint32_t epoch;
  std::uint32_t request;  // RadarState::map_request that it answers
  std::uint32_t size;     // [pixels] on an edge
  std::uint32_t looks;
  std::uint32_t flags;  // kPatch...
  std::uint32_t reserved0;
  char fidelity[16];
  std::uint64_t reserved[11];
};
static_assert(sizeof(PatchMap) == 256 && std::is_trivially_copyable_v<PatchMap>);

inline constexpr std::uint32_t kMaxFramePixels = 1024;  // on an edge
inline constexpr std::size_t kFrameSlots = 3;

// What a picture of the glass is: goes with the pixels of its slot. Rows from the top, without padding, 4 bytes a pixel
// in the order red, green, blue, 255.
struct GlassFrame {
  std::uint64_t id;          // counts up over the session; 0 = none
  std::int64_t tick;         // of the radar state that is on it
  std::int64_t sim_time_ns;  // [ns] when it was drawn
  std::uint32_t width;       // [pixels]
  std::uint32_t height;      // [pixels]
  std::uint64_t reserved[4];
};
static_assert(sizeof(GlassFrame) == 64 && std::is_trivially_copyable_v<GlassFrame>);

}  // namespace yars::databuffer
