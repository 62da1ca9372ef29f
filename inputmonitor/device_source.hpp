// Device as a source of events: its descriptor, and what happens when it goes and comes.
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

// A descriptor that yields struct input_event: a device of the kernel's input layer, a FIFO or a recording in a file.
// Never waits. What only a device can tell is asked by ioctl and left out for the others.
class DeviceReader {
 public:
  // An error when there is nothing at the path, it may not be read, or it is none of the three.
  static error::Expected<std::unique_ptr<DeviceReader>> open(const std::filesystem::path& path);
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

using DeviceMaps = std::shared_ptr<const std::vector<radar::Device>>;

inline constexpr std::int64_t kLookAgain_ns = 250'000'000;  // [ns] sooner than a hand that has plugged it in lets go

// One device: reads it, lets go of everything when it goes, and looks for it again four times a second. What a single
// take() reads is bounded, so that a device that floods holds up nobody.
class DeviceSource final : public EventSource {
 public:
  // `map_name` empty: the map that fits; for a descriptor that tells nothing of itself, the only one. A device that is
  // not there yet is waited for; one that may not be read or has no map is an error.
  static error::Expected<std::unique_ptr<DeviceSource>> create(std::filesystem::path path, std::string map_name,
                                                               DeviceMaps maps);

  bool add_descriptors(std::vector<pollfd>& wanted) const override;
  std::optional<std::int64_t> deadline_ns() const override;
  std::vector<databuffer::InputEvent> take(const Moment& moment) override;
  std::vector<databuffer::InputEvent> release() override;
  bool ended() const override { return false; }
  bool follows_sim_time() const override { return false; }
  std::vector<News> news() override { return std::exchange(news_, {}); }
  std::string description() const override;

  const std::filesystem::path& path() const { return path_; }
  bool is_open() const { return reader_ != nullptr; }

 private:
  DeviceSource(std::filesystem::path path, std::string map_name, DeviceMaps maps);
  error::Expected<void> connect();
  void look_for_it();
  void read_some(std::int64_t now_ns);
  void lose(const std::string& why);
  void report_dropped();

  std::filesystem::path path_;
  std::string map_name_;
  DeviceMaps maps_;
  std::unique_ptr<DeviceReader> reader_;  // none: it is away
  std::optional<DeviceDecoder> decoder_;
  RecordStream stream_;
  std::vector<databuffer::InputEvent> left_behind_;  // of a device that has gone
  std::vector<News> news_;
  std::string last_problem_;  // said once, not at every look
  std::int64_t look_again_ns_ = 0;
  std::uint64_t dropped_ = 0;  // presses that the log knows of
  std::uint64_t losses_ = 0;   // SYN_DROPPED, since the log was told
  bool played_ = false;        // a recording that has come to its end
};

}  // namespace yars::inputmonitor
