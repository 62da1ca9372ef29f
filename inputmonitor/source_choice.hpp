// Selection of event sources by the option --source; detection of input devices that have a map.
// Inputs: texts of the option, device maps from GUF, folder of the device nodes.
// Outputs: one EventSource.
// Errors: an unknown source text is a usage error; errors of opening a source are passed on.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "inputmonitor/device_source.hpp"
#include "inputmonitor/event_source.hpp"
#include "lib/error/error.hpp"

namespace yars::inputmonitor {

// Interval between searches of the device folder: 1 s. A search lists the folder and opens only new or changed nodes.
inline constexpr std::int64_t kScanInterval_ns = 1'000'000'000;

// Event source of all devices of a folder that have a map and read permission. Devices that are connected later are
// added. When a device disconnects, its controls are released and the device is removed. Missing read permission is
// reported once for all devices.
class FoundDevicesSource final : public EventSource {
 public:
  // `excluded`: paths of devices that other sources read.
  FoundDevicesSource(std::filesystem::path folder, DeviceMaps maps, std::vector<std::filesystem::path> excluded);

  bool add_descriptors(std::vector<pollfd>& wanted) const override;
  std::optional<std::int64_t> deadline_ns() const override;
  std::vector<databuffer::InputEvent> take(const Moment& moment) override;
  std::vector<databuffer::InputEvent> release() override;
  bool ended() const override { return false; }
  bool follows_sim_time() const override { return false; }
  std::vector<Notice> notices() override;
  std::string description() const override;

 private:
  // Inode number and change time [ns] of a node. A new node of the same name or new permissions change these values.
  using Node = std::pair<std::uint64_t, std::int64_t>;
  void scan_folder();
  void try_device(const std::filesystem::path& path);

  std::filesystem::path folder_;
  DeviceMaps maps_;
  std::vector<std::filesystem::path> excluded_;
  std::map<std::filesystem::path, Node> seen_;  // nodes examined so far
  std::vector<std::unique_ptr<DeviceSource>> devices_;
  std::vector<Notice> notices_;
  bool permission_reported_ = false;
  std::int64_t next_scan_ns_ = 0;
};

enum class SourceKind { window, terminal, script, tour, device, automatic };

// Parsed argument of --source.
struct SourceChoice {
  SourceKind kind = SourceKind::automatic;
  std::string file;        // path of a script, a tour or a device
  std::string map_name;    // device only; empty: the map that fits
  bool for_pilot = false;  // tour only; it waits for the pilot
};

// Parses window, terminal, script:FILE, tour:FILE[,pilot], evdev:PATH[,MAP] or auto. Error: any other text is a usage
// error.
error::Expected<SourceChoice> parse_source(std::string_view text);

// Parameters common to all choices.
struct SourceContext {
  std::string session;
  DeviceMaps maps = std::make_shared<const std::vector<radar::Device>>();
  std::filesystem::path device_folder = "/dev/input";
};

// Opens all choices as one source. `auto` opens a window, else the terminal if there is one.
// `auto` also opens all devices that have a map and read permission and that no other choice names.
error::Expected<std::unique_ptr<EventSource>> open_sources(const std::vector<SourceChoice>& choices,
                                                           const SourceContext& context);

}  // namespace yars::inputmonitor
