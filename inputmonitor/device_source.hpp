// Device as an event source: its descriptor, disconnection and reconnection.
// Inputs: path of a device of the kernel's input layer, of a FIFO, or of a recording; maps from GUF.
// Outputs: input events; notices for the log.
// Errors: a path that cannot be read or is not a device, a device without a map.
// Threads: one thread. Reads never wait.
// Source: docs/spec/formats.md#devices
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
#include "inputmonitor/event_source.hpp"
#include "lib/error/error.hpp"

namespace yars::inputmonitor {

// Reader of struct input_event from a device, a FIFO or a recording in a file. Never waits. Facts and state come from
// ioctl calls, which only a device answers.
class DeviceReader {
 public:
  // Errors: the path does not exist, cannot be read, or is none of the three.
  static error::Expected<std::unique_ptr<DeviceReader>> open(const std::filesystem::path& path);
  DeviceReader(const DeviceReader&) = delete;
  DeviceReader& operator=(const DeviceReader&) = delete;
  ~DeviceReader();

  int descriptor() const { return descriptor_; }
  const DeviceFacts& facts() const { return facts_; }
  // Present state of the controls. Nothing for a FIFO or a file.
  std::optional<DeviceState> state() const;

  enum class Outcome { nothing, some, gone };  // gone: unplugged, FIFO closed by its writer, end of file
  // Reads the available bytes into `bytes`. `count`: number of bytes read.
  Outcome read(std::span<std::byte> bytes, std::size_t& count);
  // True when the path still is the opened node.
  bool is_at(const std::filesystem::path& path) const;
  // True for a file: a recording is played once.
  bool plays_once() const { return is_file_; }

 private:
  explicit DeviceReader(int descriptor) : descriptor_(descriptor) {}

  int descriptor_;
  DeviceFacts facts_;
  bool is_file_ = false;
};

// Advice in messages about a device without read permission.
inline constexpr const char* kDevicePermission =
    "add yourself to the group input (sudo usermod -aG input NAME, then log in again) or install the udev rule of "
    "docs/hardware.md";

// Paths of the devices `folder`/eventN, in the order of N.
std::vector<std::filesystem::path> device_paths(const std::filesystem::path& folder);

using DeviceMaps = std::shared_ptr<const std::vector<radar::Device>>;

// Interval between checks of a device's path: 250 ms, an unnoticeable delay after plugging it in.
inline constexpr std::int64_t kCheckInterval_ns = 250'000'000;

// Source of one device. When the device disconnects, held controls are released, and the path is checked every
// kCheckInterval_ns. One take() reads at most a fixed number of bytes: a flooding device does not delay other sources.
class DeviceSource final : public EventSource {
 public:
  // `map_name` empty: the map that fits; for a FIFO or a file, the only map. An absent device is waited for.
  // Errors: a device that cannot be read, or one without a map.
  static error::Expected<std::unique_ptr<DeviceSource>> create(std::filesystem::path path, std::string map_name,
                                                               DeviceMaps maps);

  bool add_descriptors(std::vector<pollfd>& wanted) const override;
  std::optional<std::int64_t> deadline_ns() const override;
  std::vector<databuffer::InputEvent> take(const Moment& moment) override;
  std::vector<databuffer::InputEvent> release() override;
  bool ended() const override { return false; }
  bool follows_sim_time() const override { return false; }
  std::vector<Notice> notices() override { return std::exchange(notices_, {}); }
  std::string description() const override;

  const std::filesystem::path& path() const { return path_; }
  bool is_open() const { return reader_ != nullptr; }

 private:
  DeviceSource(std::filesystem::path path, std::string map_name, DeviceMaps maps);
  error::Expected<void> connect();
  void check_path();
  void read_some(std::int64_t now_ns);
  void disconnect(const std::string& why);
  void report_dropped();

  std::filesystem::path path_;
  std::string map_name_;
  DeviceMaps maps_;
  std::unique_ptr<DeviceReader> reader_;  // null: disconnected
  std::optional<DeviceDecoder> decoder_;
  RecordStream stream_;
  std::vector<databuffer::InputEvent> releases_;  // of a disconnected device
  std::vector<Notice> notices_;
  std::string last_problem_;  // reported once, not at every check
  std::int64_t next_check_ns_ = 0;
  std::uint64_t dropped_ = 0;  // presses reported as dropped
  std::uint64_t losses_ = 0;   // SYN_DROPPED since the last report
  bool played_ = false;        // a recording at its end
};

}  // namespace yars::inputmonitor
