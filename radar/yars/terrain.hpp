// Terrain: elevation that scans and patch maps are computed over.
// Inputs: a folder of elevation cells (DTED, HGT, DED, packs, rasters), or the built-in hills. Outputs: elevations.
// Units: degrees WGS84, metres above mean sea level.
// Errors: ErrorCode::failed for a folder that is missing or has no cell that can be read.
// Memory: what has been read stays in memory for later calls, up to 512 MiB for each use.
// Threads: any number. Calls that read files wait for each other.
// Example: examples/first_picture.cpp.
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>
#include <string>

#include "yars/call.hpp"
#include "yars/error.hpp"

namespace yars {

struct TerrainSettings {
  std::string folder{};             // of elevation cells; empty: the built-in hills
  bool missing_cell_is_sea = true;  // a cell without a file is sea; false: it is void
};

// Copies share what has been read.
class YARS_EXPORT Terrain {
 public:
  static Expected<Terrain> open(const TerrainSettings& settings);

  const std::string& folder() const;  // empty: the built-in hills
  // Elevation [m MSL] at positions [deg], bilinear between posts of the finest level; NaN where the terrain is void.
  // The three spans have one size. Positions outside the folder's cells count as sea, or void, with a warning.
  // Errors: ErrorCode::range for a position that is none.
  Expected<void> elevations(std::span<const double> latitude_deg, std::span<const double> longitude_deg,
                            std::span<double> elevation_m, const Call& call = {}) const;

  class Stores;  // used by the library
  const std::shared_ptr<Stores>& stores() const { return stores_; }
  explicit Terrain(std::shared_ptr<Stores> stores) : stores_(std::move(stores)) {}

 private:
  std::shared_ptr<Stores> stores_;
};

}  // namespace yars
