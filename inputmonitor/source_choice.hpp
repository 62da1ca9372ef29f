// Sources that an option names, opened; every device found that has a map.
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

// Every device of a folder that has a map and may be read, now or later: looks once a second for what is new. A device
// that goes is let go of and forgotten; what may not be read is told once.
inline constexpr std::int64_t kLookForNew_ns = 1'000'000'000;  // [ns] listing a folder is cheap; opening is done once

class FoundDevicesSource final : public EventSource {
 public:
  // `others`: devices that another source reads.
  FoundDevicesSource(std::filesystem::path folder, DeviceMaps maps, std::vector<std::filesystem::path> others);

  bool add_descriptors(std::vector<pollfd>& wanted) const override;
  std::optional<std::int64_t> deadline_ns() const override;
  std::vector<databuffer::InputEvent> take(const Moment& moment) override;
  std::vector<databuffer::InputEvent> release() override;
  bool ended() const override { return false; }
  bool follows_sim_time() const override { return false; }
  std::vector<News> news() override;
  std::string description() const override;

 private:
  // What tells a node from a later one of the same name, and one whose permissions have changed.
  using Node = std::pair<std::uint64_t, std::int64_t>;
  void look_for_new();
  void try_device(const std::filesystem::path& path);

  std::filesystem::path folder_;
  DeviceMaps maps_;
  std::vector<std::filesystem::path> others_;
  std::map<std::filesystem::path, Node> seen_;
  std::vector<std::unique_ptr<DeviceSource>> devices_;
  std::vector<News> news_;
  bool told_of_permission_ = false;
  std::int64_t look_again_ns_ = 0;
};

// Which source `--source TEXT` names, and opening those that were named.
enum class SourceKind { window, terminal, script, device, automatic };

struct SourceChoice {
  SourceKind kind = SourceKind::automatic;
  std::string file;      // of a script or a device
  std::string map_name;  // of a device; empty: the map that fits
};

// window, terminal, script:FILE, evdev:PATH[,MAP] or auto; anything else is bad usage.
error::Expected<SourceChoice> parse_source(std::string_view text);

// What sources need from outside.
struct OpeningNeeds {
  std::string session;
  DeviceMaps maps = std::make_shared<const std::vector<radar::Device>>();
  std::filesystem::path device_folder = "/dev/input";
};

// All of them as one. `auto` takes a window where there is a display, else the terminal where there is one, and every
// device that has a map and may be read.
error::Expected<std::unique_ptr<EventSource>> open_sources(const std::vector<SourceChoice>& choices,
                                                           const OpeningNeeds& needs);

}  // namespace yars::inputmonitor
