// Event source that reads an input device (Linux evdev) and reconnects to it after a disconnection.
// Inputs: path of an evdev device, a FIFO or a file of recorded evdev events; device maps from GUF.
// Outputs: input events; notices for the log.
// Errors: the path cannot be read, or is no device, FIFO or file; no device map fits.
// Threads: one thread. Reads are non-blocking.
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
#include "inputmonitor/event_source.hpp"
#include "lib/error/error.hpp"

namespace yars::inputmonitor {

// Non-blocking reader of struct input_event from a device, a FIFO or a file.
// Name, ids, axes and state of the controls are read by ioctl. A FIFO or a file has none of these.
class DeviceReader {
 public:
  // Errors: the path does not exist, cannot be read, or is no device, FIFO or file.
  static error::Expected<std::unique_ptr<DeviceReader>> open(const std::filesystem::path& path);
  DeviceReader(const DeviceReader&) = delete;
  DeviceReader& operator=(const DeviceReader&) = delete;
  ~DeviceReader();

  int descriptor() const { return descriptor_; }
  const DeviceInfo& info() const { return info_; }
  // Present state of the controls; nullopt for a FIFO or a file.
  std::optional<DeviceState> state() const;

  enum class Outcome { nothing, some, gone };  // gone: unplugged, FIFO closed by its writer, or end of file
  // Reads available bytes, at most bytes.size(), into `bytes` and stores their number in `count`.
  Outcome read(std::span<std::byte> bytes, std::size_t& count);
  // True if the path still names the opened file (same device and inode).
  bool is_at(const std::filesystem::path& path) const;
  // True for a file. A file is read once and is not reopened at its end.
  bool plays_once() const { return is_file_; }

 private:
  explicit DeviceReader(int descriptor) : descriptor_(descriptor) {}

  int descriptor_;
  DeviceInfo info_;
  bool is_file_ = false;
};

// Advice in messages about a missing read permission.
inline constexpr const char* kDevicePermission =
    "add yourself to the group input (sudo usermod -aG input NAME, then log in again) or install the udev rule of "
    "docs/hardware.md";

// Paths of the devices `folder`/eventN, in the order of N.
std::vector<std::filesystem::path> device_paths(const std::filesystem::path& folder);

using DeviceMaps = std::shared_ptr<const std::vector<radar::Device>>;

// Interval between checks of a device's path: 250 ms, so that a user hardly notices the delay after plugging in.
inline constexpr std::int64_t kCheckInterval_ns = 250'000'000;

// Event source of one device. When the device disconnects, DeviceDecoder::release_all() releases its controls. The path
// is checked every kCheckInterval_ns for a reconnection. One take() reads a bounded number of bytes, so that a device
// with many events does not delay other sources.
class DeviceSource final : public EventSource {
 public:
  // An empty `map_name` selects the last map that fits the device. A FIFO or a file has no name and no ids; for these
  // an empty `map_name` is valid only if there is exactly one map.
  // A missing device is no error: the source opens the device when the path appears.
  // Errors: the device cannot be read; no map has the name or fits the device.
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
  std::vector<databuffer::InputEvent> releases_;  // last events of a device that was disconnected
  std::vector<Notice> notices_;
  std::string last_problem_;  // last reason why connect() failed; a notice reports it once, not at every check
  std::int64_t next_check_ns_ = 0;
  std::uint64_t dropped_ = 0;  // number of dropped presses that notices have reported
  std::uint64_t losses_ = 0;   // SYN_DROPPED events since the last notice
  bool played_ = false;        // the source is a file that was read to its end
};

}  // namespace yars::inputmonitor
