// Event maps of cockpit hardware: the radar events of each button and axis of a Linux input device. Map in this file:
// an event map.
// config/schema reads the maps from GUF files; inputmonitor/ applies them.
// The conditions of a map select the devices to which it applies: vendor, products, device name, a control.
// Source: codes of linux/input-event-codes.h; events as `yars inject` accepts them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace yars::radar {

inline constexpr std::size_t kMaxDevices = 64;    // maximum number of maps
inline constexpr std::size_t kMaxControls = 256;  // maximum number of buttons per map; also of axes per map

struct DeviceButton {
  std::string code;       // for example BTN_TRIGGER; config/schema/devices.hpp has all spellings
  std::string press;      // event sent when the button is pressed; empty: none
  std::string release;    // event sent when the button is released; empty: none
  double repeat_s = 0.0;  // [s] time between repetitions of `press` while the button is held; 0: none
};

// Use of an axis. tdc_x, tdc_y: throttle designator control (TDC), right and up positive. elevation: the position of
// the axis sets the antenna elevation above the horizontal. directions: a move to either end acts as a button, for hats
// (four-way switches) and rockers (switches that rest in the middle). lever: each step of the travel sends an event.
enum class AxisUse : std::uint8_t { tdc_x = 0, tdc_y = 1, elevation = 2, directions = 3, lever = 4 };

struct DeviceAxis {
  // Value of low, high and centre if the map does not give them. Then low and high are the limits that the device
  // reports, and centre is the middle between low and high.
  static constexpr double kAsDevice = std::numeric_limits<double>::quiet_NaN();

  std::string code;  // for example ABS_X; config/schema/devices.hpp has all spellings
  AxisUse use = AxisUse::tdc_x;
  double low = kAsDevice;     // raw value at the low end
  double high = kAsDevice;    // raw value at the high end
  double centre = kAsDevice;  // raw value at rest
  double dead_zone = 0.05;    // fraction of the travel from the centre to each end that has no effect, [0, 0.9]
  double curve = 0.0;         // response: 0 = linear, 1 = cubic; between: weighted mean of both
  bool inverted = false;      // true: the high end acts as the low end, and the low end as the high end
  std::string positive;       // directions, lever: event of a move to the high end, after inversion
  std::string negative;       // directions, lever: event of a move to the low end, after inversion
  double repeat_s = 0.0;      // [s] directions: time between repetitions at full deflection; 0: none
  double lowest_deg = -60.0;  // [deg] elevation: antenna above the horizontal at the low end, after inversion
  double highest_deg = 60.0;  // [deg] elevation: antenna above the horizontal at the high end, after inversion
  int steps = 16;             // lever: number of positions over the travel
};

// Map for one kind of device, with the conditions vendor, products, pattern and has. A map fits a device that meets all
// its conditions; an empty condition is always met. If vendor, pattern and has are empty, the map fits no device. It is
// then used only if the user names it.
struct Device {
  std::string name;      // name of the map
  std::string vendor;    // USB vendor: four hexadecimal digits, as lsusb shows them
  std::string products;  // USB products: four hexadecimal digits each, separated by blanks
  std::string pattern;   // pattern of the device's name, with * and ?
  std::string has;       // code of a control that the device must have
  std::vector<DeviceButton> buttons;
  std::vector<DeviceAxis> axes;
};

}  // namespace yars::radar
