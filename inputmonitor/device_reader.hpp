// A descriptor that yields struct input_event: a device of the kernel's input layer, a FIFO or a recording in a file.
// Never waits. What only a device can tell is asked by ioctl and left out for the others.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "inputmonitor/device_decoder.hpp"
#include "inputmonitor/device_map.hpp"
#include "lib/failure/error.hpp"

namespace yars::inputmonitor {

class DeviceReader {
 public:
  // An error when there is nothing at the path, it may not be read, or it is none of the three.
  static failure::Expected<std::unique_ptr<DeviceReader>> open(const std::filesystem::path& path);
  DeviceReader(const DeviceReader&) = delete;
  DeviceReader& operator=(const DeviceReader&) = delete;
  ~DeviceReader();

  int descriptor() const { return descriptor_; }
  const DeviceFacts& facts() const { return facts_; }
  // Where its controls are now; nothing for a FIFO or a file.
  std::optional<DeviceState> state() const;

  enum class Outcome { nothing, some, gone };  // gone: unplugged, the writer has left, or the file has ended
  // Fills `bytes` as far as there is something; `count` of them.
  Outcome read(std::span<std::byte> bytes, std::size_t& count);
  // The path still leads to what was opened.
  bool is_at(const std::filesystem::path& path) const;
  // A recording is played once.
  bool plays_once() const { return is_file_; }

 private:
  explicit DeviceReader(int descriptor) : descriptor_(descriptor) {}

  int descriptor_;
  DeviceFacts facts_;
  bool is_file_ = false;
};

// What to do where a device may not be read.
inline constexpr const char* kDevicePermission =
    "add yourself to the group input (sudo usermod -aG input NAME, then log in again) or install the udev rule of "
    "docs/hardware.md";

// The devices that there are, /dev/input/event*, in the order of their numbers.
std::vector<std::filesystem::path> device_paths(const std::filesystem::path& folder);

}  // namespace yars::inputmonitor
