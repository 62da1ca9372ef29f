// Helpers of the device tests: bytes of input records as the kernel writes them, device maps from GUF, events as texts.
#pragma once

#include <gtest/gtest.h>
#include <linux/input.h>

#include <cstddef>
#include <cstring>
#include <string>
#include <vector>

#include "config/schema/devices.hpp"
#include "config/schema/load.hpp"
#include "databuffer/messages/input_event.hpp"
#include "inputmonitor/device_decoder.hpp"

namespace yars::inputmonitor::testing {

inline constexpr std::int64_t kMillisecond_ns = 1'000'000;

inline std::vector<std::byte> bytes_of(const std::vector<RawEvent>& events) {
  std::vector<std::byte> bytes;
  for (const RawEvent& event : events) {
    input_event record{};
    record.type = event.type;
    record.code = event.code;
    record.value = event.value;
    const auto* first = reinterpret_cast<const std::byte*>(&record);
    bytes.insert(bytes.end(), first, first + sizeof record);
  }
  return bytes;
}

inline RawEvent key(std::uint16_t code, int value) {
  return {EV_KEY, code, value};
}
inline RawEvent axis(std::uint16_t code, int value) {
  return {EV_ABS, code, value};
}
inline constexpr RawEvent kReport{EV_SYN, SYN_REPORT, 0};
inline constexpr RawEvent kDropped{EV_SYN, SYN_DROPPED, 0};

inline std::vector<std::string> texts_of(const std::vector<databuffer::InputEvent>& events) {
  std::vector<std::string> texts;
  for (const auto& event : events) texts.push_back(databuffer::text_of(event));
  return texts;
}

// The device maps of a configuration text. Expects that the text is valid.
inline std::vector<radar::Device> maps_of(const std::string& guf) {
  const auto loaded = config::load_configuration_text(guf, "text.guf");
  EXPECT_TRUE(loaded) << loaded.error().message();
  return loaded ? loaded->radar.devices : std::vector<radar::Device>{};
}
inline std::vector<radar::Device> shipped_maps() {
  return maps_of(std::string(config::shipped_devices_text()));
}

// Device map with these buttons and axes, resolved as for a FIFO or a file, which does not report its controls.
inline DeviceMap ready(const std::string& controls) {
  const auto maps = maps_of("( Devices `( ( Device :name \"it\" " + controls + " ) ) )");
  auto map = resolve_map(maps.at(0), {});
  EXPECT_TRUE(map) << map.error().message();
  return map ? *map : DeviceMap{};
}

}  // namespace yars::inputmonitor::testing
