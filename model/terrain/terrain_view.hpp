// Terrain as the kernel reads it: immutable, in memory, made by prepare() on a loader's thread and read by
// compute() on any number of threads. A change of terrain is a new view with a higher generation.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "lib/geo/geodesic.hpp"

namespace yars::model::terrain {

// The ground at one place.
struct Surface {
  double elevation_m = 0.0;   // [m] MSL; NaN = void
  double water = 0.0;         // [0, 1] share of posts at exactly 0 m
  std::uint8_t material = 0;  // nearest surface material code; 0 = none given: land or sea by `water`
};

class TerrainView {
 public:
  TerrainView() = default;
  TerrainView(const TerrainView&) = delete;
  TerrainView& operator=(const TerrainView&) = delete;
  virtual ~TerrainView() = default;

  // Counts up with every view of a store; part of the tick log.
  virtual std::uint64_t generation() const = 0;
  virtual std::uint64_t resident_bytes() const = 0;

  // Bilinear elevation and share of water at one place. Any longitude (wrapped), latitude clamped to the poles.
  // A void among the four posts is left out and the weights of the others are scaled; all four void = NaN.
  virtual Surface surface_at(geo::GeoPoint place) const = 0;
  double elevation_m(geo::GeoPoint place) const { return surface_at(place).elevation_m; }

  // The same for a run of places, in float, NaN = void: the fast path. Error against elevation_m at most 0.05 m
  // + 1e-6 of the cell's relief. `water` [0, 1] is the share of water (posts at exactly 0 m, absent cells) by the
  // same weights. Returns how many places met a cell that is not loaded yet (their elevation is NaN).
  virtual std::size_t elevations(std::span<const double> latitude_deg, std::span<const double> longitude_deg,
                                 std::span<float> elevation_m, std::span<float> water) const = 0;
};

using TerrainViewPointer = std::shared_ptr<const TerrainView>;

// What a scan can reach: a disc on the earth.
struct TerrainRegion {
  geo::GeoPoint centre;
  double radius_m = 0.0;
};

// Where views come from. prepare() may read files and wait; it is called by one thread at a time.
class TerrainStore {
 public:
  TerrainStore() = default;
  TerrainStore(const TerrainStore&) = delete;
  TerrainStore& operator=(const TerrainStore&) = delete;
  virtual ~TerrainStore() = default;

  // A view that holds all that exists within the region; posts outside may be dropped from memory.
  // The same view (same generation) is returned while nothing has to change.
  virtual TerrainViewPointer prepare(const TerrainRegion& region) = 0;

  // What prepare() has met since the last call and a person should know: unreadable cells, odd files. Each once,
  // a sentence each; same thread as prepare().
  virtual std::vector<std::string> take_problems() { return {}; }
};

}  // namespace yars::model::terrain
