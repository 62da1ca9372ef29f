// Any bytes from a device, in fragments, as input of three parts: the record stream, the decoder with a map of all
// kinds of controls, and the learning of a map. All events pass validation, and the learned map can be read.
#include <cstdint>
#include <string>

#include "config/schema/load.hpp"
#include "config/schema/slot_text.hpp"
#include "databuffer/messages/validation.hpp"
#include "inputmonitor/device_decoder.hpp"
#include "inputmonitor/learning.hpp"
#include "lib/error/error.hpp"

using namespace yars;
using namespace yars::inputmonitor;

namespace {

constexpr const char* kMap = R"(( Devices `( ( Device "it"
  :buttons `( ( Button "button 1" "tdc press" ) ( Button "button 2" "pb 13" "pb 14" 0.01 ) ( Button "button 3" "tdc 0 0.5" ) )
  :axes `( ( Axis "ABS_X" tdcX -100 100 20 0.1 0.5 ) ( Axis "ABS_Y" tdcY 0 255 :inverted true )
           ( Axis "ABS_HAT0X" directions :positive "tdc press" :negative "pb 8" :repeat 0.01 )
           ( Axis "ABS_RZ" elevation 0 100 ) ( Axis "ABS_THROTTLE" lever 0 100 :steps 256 :positive "contrast up" ) ) ) ) ))";

DeviceMap map_of() {
  const auto loaded = config::load_configuration_text(kMap, "fuzz.guf");
  return *resolve_map(loaded->radar.devices.at(0), {});
}

void check(const std::vector<databuffer::InputEvent>& events) {
  for (const auto& event : events) YARS_REQUIRE(validate(event).has_value(), ==, false);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const DeviceMap kReady = map_of();
  if (size == 0) return 0;
  const std::size_t fragment = 1 + data[0] % 64;  // [bytes]
  const std::span<const std::byte> bytes = std::as_bytes(std::span(data + 1, size - 1));
  RecordStream stream;
  DeviceDecoder decoder(kReady);
  Learning learning({}, {}, Typing::none);
  learning.begin(0);
  std::int64_t now_ns = 0;
  for (std::size_t at = 0; at < bytes.size(); at += fragment) {
    for (const RawEvent& raw : stream.feed(bytes.subspan(at, std::min(fragment, bytes.size() - at)))) {
      decoder.feed(raw, now_ns);
      if (decoder.needs_resync()) decoder.resync(std::nullopt, now_ns);
      learning.feed(raw, now_ns);
    }
    now_ns += 3'000'000;
    learning.wait(now_ns);
    check(decoder.take(now_ns));
  }
  decoder.release_all();
  check(decoder.take(now_ns));
  radar::RadarConfiguration configuration;
  configuration.devices.push_back(learning.device("learned"));
  YARS_REQUIRE(config::load_configuration_text(config::print_devices(configuration.devices), "learned.guf").has_value(),
               ==, true);
  return 0;
}
