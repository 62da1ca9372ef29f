// From `--source KIND:...` to the bridge that it names and where its packets come from:
//   flightgear:[HOST:]PORT        jsbsim:[HOST:]PORT[,COLUMN,COLUMN...]
//   xplane:HOST:PORT              dis:[HOST:]PORT[,SITE,APP,ENTITY]
// HOST is where to listen (127.0.0.1 unless told: then nothing from other machines is heard; 0.0.0.0 for all), for
// X-Plane the machine to ask. PORT 1 to 65535; 0, where it listens, is any free one. COLUMNs as JSBSim's labels name
// them.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "databuffer/bridges/bridge.hpp"

namespace yars::databuffer::bridges {

struct BridgeSource {
  std::unique_ptr<Bridge> bridge;
  std::string name;  // the kind
  std::string host;
  std::uint16_t port = 0;
  bool asks = false;  // host and port are whom to ask; else where to listen
};

// Whether the text names a bridge at all.
bool names_bridge(std::string_view text);

// An error counts as bad usage.
failure::Expected<BridgeSource> open_bridge(std::string_view text);

}  // namespace yars::databuffer::bridges
