// World in effect of a session, and changes of it. Changes of the session's clock that users ask for, for
// Session::change_clock(): run, freeze, rate, step, reset, reposition. Inputs: the clock before; the containers world,
// world_configured and world_latched of the segment (docs/shared_memory.md#world). Outputs: the clock after, with the
// present time as its base; the world in effect; a new wanted world, which radar-model latches at its next tick. While
// radar-model is on another host, a request to that host instead, through the gateways (docs/network.md#the-world).
// Errors of a change of the world: no radar-model; the replay of a recording; a change that is refused; no answer of
// another host; another program that holds the role instructor for 0.2 s, with radar-model on another host for 2.5 s.
// Threads: any. The functions of the clock have no state and read CLOCK_MONOTONIC. Programs that change the world wait
// for one another, and no change is lost. Source: docs/commands.md#sim.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "databuffer/messages/inspection.hpp"
#include "databuffer/messages/world_state.hpp"
#include "databuffer/session/session.hpp"
#include "lib/error/error.hpp"
#include "lib/geo/geodesy.hpp"
#include "lib/geo/quantity.hpp"

namespace yars::databuffer {

// Ticks by which a step advances the clock at once. At most kMaxTicksBehind (20): programs skip ticks that are further
// behind the clock.
inline constexpr std::int64_t kStepPortion_ticks = 10;
// [ms] Time that programs need to run the ticks of a portion, and the first tick of an epoch.
inline constexpr int kPortionTime_ms = 30;

// The clock with its base moved to the CLOCK_MONOTONIC time `base_ns`; sim time does not change.
ClockState rebased(ClockState clock, std::int64_t base_ns);
ClockState with_running(const ClockState& clock, bool running);
ClockState with_rate(const ClockState& clock, double rate);
// Freezes and advances by at most kStepPortion_ticks. From any time within a tick, the first step leads to the start
// of the next tick.
ClockState stepped(const ClockState& clock, std::int64_t ticks);
// Begins an epoch at sim time `time_s`, rounded to a whole tick, because a replay shows the picture of that tick.
ClockState reset_to(const ClockState& clock, double time_s);

struct Repositioning {
  geo::GeoPoint position;
  geo::AltitudeMsl altitude;
  geo::Bearing heading;
  std::optional<geo::Speed> ground_speed{};  // the aircraft then flies straight and level; nullopt: its source chooses
};
// Begins an epoch with the aircraft at another position.
ClockState repositioned(const ClockState& clock, const Repositioning& to);

// Notes in a clock whose epoch begins at the position of the aircraft, which no user asked for. A speed of an earlier
// repositioning ends.
void begin_at_aircraft(ClockState& clock, const Ownship& ownship, geo::Bearing heading);

// A frozen clock advanced by one tick, kPortionTime_ms after a new epoch has begun. The programs run the first tick of
// an epoch in no defined order. From the second tick on, each reads the other programs' records of the new epoch.
ClockState after_first_tick(const ClockState& clock);

// World that radar-model has in effect. nullopt: none was published, as before radar-model's first tick.
std::optional<WorldState> world_in_effect(const SessionLayout& layout);

// World with all changes so far: the one in effect, or a newer one that radar-model has not latched yet. A frozen clock
// delays the latching.
std::optional<WorldState> newest_world(const SessionLayout& layout);

// Makes a changed world out of the newest one, or says why not. See world_edit.hpp. It may be called several times for
// one change, because on another host an edit of somebody else may come first; the last result counts.
using WorldChange = std::function<error::Expected<WorldState>(const WorldState&)>;

// Replaces the newest world by change(world) while holding the role instructor, and returns it. Its `edit` is one
// greater. Waits at most 2.2 s for another host.
error::Expected<WorldState> change_world(Session& session, const WorldChange& change);

// The same for a program that must not wait, such as a server. It holds the role instructor until the change is
// decided.
class WorldChangeInProgress {
 public:
  WorldChangeInProgress(Session& session, WorldChange change);

  // Goes on as far as it can without waiting. The changed world, or why there is none, once that is decided; nullopt
  // before. Then it must not be called any more.
  std::optional<error::Expected<WorldState>> poll();

 private:
  std::optional<error::Expected<WorldState>> begin();
  std::optional<error::Expected<WorldState>> request();

  Session* session_;
  WorldChange change_;
  std::int64_t begun_ns_;
  std::optional<Claim> instructor_;
  WorldState requested_{};         // of another host
  std::uint64_t number_ = 0;       // of that request
  std::int64_t requested_ns_ = 0;  // time of that request
  std::int64_t first_request_ns_ = 0;
};

// The same for a caller that holds the role instructor, in a session whose radar-model is on this host. No waiting. The
// change gives source_time_ns, which tells an edit from an equal one of another host.
error::Expected<WorldState> replace_world(Session& session, const Claim& instructor, const WorldChange& change);

// [ns] A request to another host that is older than this has no effect. It may have been under way during a cut.
inline constexpr std::int64_t kMaxWorldRequestAge_ns = 1'000'000'000;

// The change to the world of radar-model's configuration. Error: radar-model has published none.
WorldChange reset_of(const Session& session);

}  // namespace yars::databuffer
