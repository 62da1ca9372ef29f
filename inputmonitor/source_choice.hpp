// Which source `--source TEXT` names, and opening those that were named.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "inputmonitor/device_source.hpp"
#include "inputmonitor/event_source.hpp"
#include "lib/failure/error.hpp"

namespace yars::inputmonitor {

enum class SourceKind { window, terminal, script, device, automatic };

struct SourceChoice {
  SourceKind kind = SourceKind::automatic;
  std::string file;      // of a script or a device
  std::string map_name;  // of a device; empty: the map that fits
};

// window, terminal, script:FILE, evdev:PATH[,MAP] or auto; anything else is bad usage.
failure::Expected<SourceChoice> parse_source(std::string_view text);

// What sources need from outside.
struct OpeningNeeds {
  std::string session;
  DeviceMaps maps = std::make_shared<const std::vector<radar::Device>>();
  std::filesystem::path device_folder = "/dev/input";
};

// All of them as one. `auto` takes a window where there is a display, else the terminal where there is one, and every
// device that has a map and may be read.
failure::Expected<std::unique_ptr<EventSource>> open_sources(const std::vector<SourceChoice>& choices,
                                                             const OpeningNeeds& needs);

}  // namespace yars::inputmonitor
