// What the slots of GUF write into: the configuration, and the form in hand where forms come in numbers.
#pragma once

#include <set>
#include <string>

#include "lib/radar/configuration.hpp"

namespace yars::config {

// ( lat-long N 35 44 51 ) while it is read.
struct SexagesimalAngle {
  int direction = 0;  // index into N S E W
  double degrees = 0.0;
  double minutes = 0.0;
  double seconds = 0.0;
};

// ( hsv 120 1 0.5 ) while it is read.
struct HueSaturationValue {
  double hue_deg = 0.0;
  double saturation = 0.0;
  double value = 0.0;
};

inline constexpr int kKindByName = -1;  // the name alone tells what a point is

struct Draft {
  radar::RadarConfiguration radar{};
  int window_height_pixels = radar::ViewConfiguration{}.size_pixels;  // equals the width: the glass is square
  // SarMode's samples and width, 0 while it has not given them.
  int map_samples = radar::Fidelity{}.map_size;
  int map_sweeps = radar::Fidelity{}.map_size;
  std::string scene_folder{};  // of MgDbase
  radar::RoutePoint point{};
  int point_kind = kKindByName;             // a radar::PointKind when it is given
  std::set<std::string> kinds_left_open{};  // names of points of the route whose kind the file does not tell
  SexagesimalAngle angle{};
  radar::Rgb color{};  // in hand, until the slot it stands in takes it
  HueSaturationValue hue{};
  radar::Material material{};
  radar::RainCell rain_cell{};
  radar::Jammer jammer{};
  radar::Mover mover{};
  radar::Scene scene{};
  radar::Beacon beacon{};
  radar::Device device{};
  radar::DeviceButton device_button{};
  radar::DeviceAxis device_axis{};
};

// A draft that stands for a finished configuration.
inline Draft draft_of(const radar::RadarConfiguration& configuration) {
  return {.radar = configuration, .window_height_pixels = configuration.view.size_pixels};
}

}  // namespace yars::config
