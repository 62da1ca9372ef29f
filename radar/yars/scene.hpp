// Scenes: polygons of buildings, bridges, airfields on a terrain; and targets that move.
// Inputs: OpenFlight files. Outputs: the objects that labels of maps and scans name by index.
// Units: degrees WGS84, metres, metres above mean sea level.
// Errors: ErrorCode::argument for a text that names no scene, ErrorCode::failed for a file that cannot be read.
// Threads: a Scene is not changed after it was read.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "yars/call.hpp"
#include "yars/error.hpp"
#include "yars/terrain.hpp"

namespace yars {

struct SceneObject {
  std::string name;            // empty: the faces outside objects, the first object of each file
  double latitude_deg = 0.0;   // of the middle
  double longitude_deg = 0.0;  // of the middle
  double base_msl_m = 0.0;     // lowest point
  double height_m = 0.0;       // above the base
  double length_m = 0.0;       // longer side of the box of least area, seen from above
  double width_m = 0.0;        // its shorter side
  double heading_deg = 0.0;    // true, of the longer side, [0, 180)
  std::uint8_t material = 0;   // code of DFAD of most of the surface
};

// A target that moves on the ground. It is at its place when the map begins.
struct Mover {
  double latitude_deg = 0.0;
  double longitude_deg = 0.0;
  double heading_deg = 0.0;          // true
  double speed_kt = 0.0;             // over ground
  double cross_section_m2 = 1000.0;  // radar cross section; with noise the mean of Swerling 1
  double height_m = 6.096;           // of the reflecting point above the ground
};

class YARS_EXPORT Scene {
 public:
  // Reads scenes on a terrain. `files`: FILE or FILE@LAT,LON,HDG, or a folder of files. `without`: names of objects or
  // groups to leave out, with the wildcards * and ?.
  static Expected<Scene> read(const std::vector<std::string>& files, const Terrain& terrain,
                              const std::vector<std::string>& without = {}, const Call& call = {});

  const Terrain& terrain() const;
  const std::vector<SceneObject>& objects() const;
  std::size_t triangles() const;  // of all files

  struct Parts;  // used by the library
  const Parts& parts() const { return *parts_; }
  explicit Scene(std::shared_ptr<const Parts> parts) : parts_(std::move(parts)) {}

 private:
  std::shared_ptr<const Parts> parts_;
};

}  // namespace yars
