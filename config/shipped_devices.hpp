// config/devices.guf as it was when this was built: the maps of cockpit hardware that need no file.
#pragma once

#include <string_view>

namespace yars::config {

std::string_view shipped_devices_text();

}  // namespace yars::config
