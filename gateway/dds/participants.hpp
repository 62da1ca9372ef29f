// Other DDS participants of the domain that are no hosts of this session, so that a user learns why hosts do not meet.
// Inputs: the topics about participants and writers that every DDS program has (DCPSParticipant, DCPSPublication).
// Outputs: one line for each gateway that was heard and yet exchanges nothing: it has another session, or DDS Security
//   on one side only. What others write about themselves is not trusted: it appears in messages alone.
// Units: times [ns], CLOCK_MONOTONIC.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "gateway/pace.hpp"

namespace yars::gateway::dds {

// One line about a participant.
struct Remark {
  std::string text;
  std::string note;       // shorter, for the flight recorder
  bool is_fault = false;  // false: it may be meant so
};

// The line about gateway `name` at `address`, which exchanges nothing. `secured`: this side has an identity.
Remark silence_of(const std::string& name, const std::string& address, bool secured);

// Permission to join again, a few times and then every two minutes: others can cause it, and it disturbs the session.
struct RejoinLimit : Allowance {
  static constexpr int kAtOnce = 3;
  RejoinLimit() : Allowance(120'000'000'000, kAtOnce) {}
};

class Participants {
 public:
  // `participant`: entity of Cyclone DDS. `session`: name of the session. `secured`: this side has an identity.
  void open(std::int32_t participant, std::string session, bool secured);
  // Lines about participants that were found since the last call. Each is named once.
  std::vector<Remark> take_remarks(std::int64_t now_ns);
  // With security: the name of a gateway with which this one should try the handshake of DDS Security again, by a
  // participant of its own that is new; empty: none. Cyclone DDS 0.10 can lose a handshake for good on a line that
  // loses messages (eclipse-cyclonedds/cyclonedds, issue 1895). Of two gateways the one with the greater GUID is told
  // so. Each participant is named once.
  std::string take_lost_handshake(std::int64_t now_ns);

 private:
  using Key = std::pair<std::uint64_t, std::uint64_t>;  // GUID of a participant
  struct Other {
    std::string name, address;  // of a gateway; empty: it is none
    std::int64_t first_ns = 0;  // when it was first heard
    bool is_here = false;       // writes in this session
    std::string session;        // of its writers, another one; empty: none known
    bool is_named = false;
    bool is_lost = false;  // take_lost_handshake() has named it
  };
  void take_participants(std::int64_t now_ns);
  void take_writers();
  Remark remark_on(const Other& other) const;

  std::int32_t participants_ = 0, writers_ = 0;  // readers
  Key self_{};
  std::string session_;
  bool secured_ = false;
  std::map<Key, Other> others_;
};

}  // namespace yars::gateway::dds
