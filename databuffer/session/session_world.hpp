// World of a session: what is in effect, and changes of it.
// Inputs: the containers world, world_configured and world_latched of the segment (docs/shared_memory.md#world).
// Outputs: the world in effect; a new wanted world, which radar-model latches at its next tick. While radar-model is on
// another host, a request to that host instead, through the gateways (docs/network.md#the-world).
// Errors: no radar-model; the replay of a recording; a change that is refused; no answer of another host; another
// program that holds the role instructor for 0.2 s, with radar-model on another host for 2.5 s.
// Threads: any number of programs may change the world: each waits for the others, and no change is lost.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "databuffer/messages/world_state.hpp"
#include "databuffer/session/session.hpp"
#include "lib/error/error.hpp"

namespace yars::databuffer {

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
