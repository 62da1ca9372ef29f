// All that one picture is made of, besides the stored sweeps: copies of what the session holds, and who is silent.
#pragma once

#include "databuffer/records/model_records.hpp"
#include "databuffer/records/ownship.hpp"
#include "databuffer/records/patch_map.hpp"
#include "databuffer/records/radar_state.hpp"

namespace yars::display {

struct GlassInput {
  databuffer::RadarState state{};
  databuffer::ModelStatus model{};
  databuffer::Ownship ownship{};  // present truth
  databuffer::Nav nav{};          // goes with it
  databuffer::PatchMap map{};     // the one that the state shows; another id: it could not be read
  bool state_machine_alive = true;
  bool model_alive = true;
  bool ownship_fresh = true;
};

}  // namespace yars::display
