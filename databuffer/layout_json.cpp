#include "databuffer/layout_json.hpp"

#include <cstddef>

#include "databuffer/layout_identity.hpp"
#include "databuffer/session_layout.hpp"

namespace yars::databuffer {

std::string layout_json() {
  std::string text = "{\"version\": " + std::to_string(kLayoutIdentity.version) +
                     ", \"size\": " + std::to_string(kLayoutIdentity.size) +
                     ", \"hash\": " + std::to_string(kLayoutIdentity.hash) + ", \"offsets\": {";
  const auto part = [&text](const char* name, std::size_t offset, bool last = false) {
    text += "\"" + std::string(name) + "\": " + std::to_string(offset) + (last ? "" : ", ");
  };
  part("lockstep", offsetof(SessionLayout, lockstep));
  part("clock", offsetof(SessionLayout, clock));
  part("ownship_priority", offsetof(SessionLayout, ownship_priority));
  part("ownship", offsetof(SessionLayout, ownship));
  part("nav", offsetof(SessionLayout, nav));
  part("radar_state", offsetof(SessionLayout, radar_state));
  part("model_status", offsetof(SessionLayout, model_status));
  part("model_ticks", offsetof(SessionLayout, model_ticks));
  part("applied_events", offsetof(SessionLayout, applied_events));
  part("sweeps", offsetof(SessionLayout, sweeps));
  part("input", offsetof(SessionLayout, input));
  part("processes", offsetof(SessionLayout, processes));
  part("note_counts", offsetof(SessionLayout, note_counts));
  part("notes", offsetof(SessionLayout, notes));
  part("patches", offsetof(SessionLayout, patches), true);
  return text + "}}";
}

}  // namespace yars::databuffer
