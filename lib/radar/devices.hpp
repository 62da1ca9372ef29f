// What the controls of a cockpit's hardware do: maps of devices of the kernel's input layer, found by vendor and
// product, by name or by what they have. Pure values; config/ fills them from GUF, inputmonitor/ plays them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace yars::radar {

inline constexpr std::size_t kMaxDevices = 64;
inline constexpr std::size_t kMaxControls = 256;  // buttons of a device, and as many axes

// Codes are texts, as in linux/input-event-codes.h; events are texts, as `yars inject` takes them.
struct DeviceButton {
  std::string code;
  std::string press;      // empty: nothing
  std::string release;    // empty: nothing
  double repeat_s = 0.0;  // [s] between repetitions of `press` while it is held; 0: none
};

// tdc_x, tdc_y: deflection right and up. elevation: the antenna's, absolute. directions: either way is a button, as of
// a hat or a rocker. lever: travel in steps, each an event.
enum class AxisUse : std::uint8_t { tdc_x = 0, tdc_y = 1, elevation = 2, directions = 3, lever = 4 };

struct DeviceAxis {
  static constexpr double kAsDevice = std::numeric_limits<double>::quiet_NaN();  // the device tells

  std::string code;
  AxisUse use = AxisUse::tdc_x;
  double low = kAsDevice;  // raw values at the ends and in the middle
  double high = kAsDevice;
  double centre = kAsDevice;  // half way between the ends where nothing else is given
  double dead_zone = 0.05;    // share of the travel from the centre that counts as none, [0, 0.9]
  double curve = 0.0;         // 0: straight, 1: the cube
  bool inverted = false;
  std::string positive;  // of directions and lever: what a move to the high end does, after inversion
  std::string negative;
  double repeat_s = 0.0;      // [s] of directions: between repetitions at full deflection; 0: none
  double lowest_deg = -60.0;  // [deg] of elevation, at the low end
  double highest_deg = 60.0;  // [deg] at the high end
  int steps = 16;             // of a lever: places over its travel
};

struct Device {
  std::string name;
  std::string vendor;    // four hexadecimal digits, as lsusb shows them; empty: any
  std::string products;  // the same, several with blanks between; empty: any
  std::string pattern;   // of the device's own name, with * and ?; empty: any
  std::string has;       // code of a control that it must have; empty: any
  std::vector<DeviceButton> buttons;
  std::vector<DeviceAxis> axes;
};

}  // namespace yars::radar
