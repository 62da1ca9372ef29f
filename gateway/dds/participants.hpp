// Other DDS participants of the domain that are no hosts of this session, so that a user learns why hosts do not meet.
// Inputs: the topics about participants and writers that every DDS program has (DCPSParticipant, DCPSPublication).
// Outputs: one line for each gateway that was heard and yet exchanges nothing: it has another session, or DDS Security
//   on one side only. The name of a gateway whose handshake was lost.
// What others write about themselves is not trusted. It appears in messages. With security a host's name also decides
// whether this gateway joins again, which RejoinLimit bounds.
// Units: times [ns], CLOCK_MONOTONIC.
#pragma once

#include <dds/dds.h>

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "databuffer/messages/note.hpp"
#include "gateway/message_limit.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::gateway::dds {

// Calls take(sample, info) for each sample that has arrived on a reader; the rest of a flood is left for the next call.
template <class Take>
void take_samples(dds_entity_t reader, int max, const Take& take) {
  for (int taken = 0; reader > 0 && taken < max; ++taken) {
    void* sample = nullptr;  // Cyclone DDS lends it
    dds_sample_info_t info;
    if (dds_take(reader, &sample, &info, 1, 1) <= 0) return;
    take(sample, info);
    dds_return_loan(reader, &sample, 1);
  }
}

// One line about a participant.
struct Remark {
  std::string text;
  std::string note = {};  // shorter, for the flight recorder
  bool is_fault = false;  // false: it may be meant so
};

inline std::string gateway_text(const std::string& name, const std::string& address) {
  return "the gateway of " + name + " (" + address + ')';
}

// The line about gateway `name` at `address`, which exchanges nothing. `secured`: this side has an identity.
inline Remark silence_of(const std::string& name, const std::string& address, bool secured) {
  constexpr std::size_t kMaxAddress = 15;  // [bytes] of an IPv4 address
  const std::string cause = secured ? "its form Network has no `security`, or an identity of another network"
                                    : "its form Network has `security`, and that of this host has none";
  std::string note = " exchanges nothing: compare `security`, open UDP ports";
  const std::string at = " (" + address.substr(0, kMaxAddress) + ')';
  note = name.substr(0, sizeof(databuffer::Note::text) - 1 - note.size() - at.size()) + at + note;
  return {gateway_text(name, address) + " is heard, but exchanges nothing: " + cause +
              ", or it does not hear this host; give both hosts identities of one network, or neither, and open their "
              "UDP ports",
          std::move(note), true};
}

// Permission to join again, a few times and then every two minutes: others can cause it, and it disturbs the session.
struct RejoinLimit : Allowance {
  static constexpr int kAtOnce = 3;
  RejoinLimit() : Allowance(120'000'000'000, kAtOnce) {}
};

class Participants {
 public:
  // `participant`: entity of Cyclone DDS. `session`: name of the session. `secured`: this side has an identity.
  void open(std::int32_t participant, std::string session, bool secured) {
    session_ = std::move(session);
    secured_ = secured;
    dds_guid_t guid{};
    if (dds_get_guid(participant, &guid) == DDS_RETCODE_OK) self_ = std::to_array(guid.v);
    participants_ = dds_create_reader(participant, DDS_BUILTIN_TOPIC_DCPSPARTICIPANT, nullptr, nullptr);
    writers_ = dds_create_reader(participant, DDS_BUILTIN_TOPIC_DCPSPUBLICATION, nullptr, nullptr);
  }

  // Lines about participants that were found since the last call. Each is named once.
  std::vector<Remark> take_remarks(std::int64_t now_ns) {
    take_participants(now_ns);
    take_writers();
    std::vector<Remark> remarks;
    for (auto& [key, other] : others_) {
      const bool is_silent = other.session.empty();
      if (other.is_named || !is_apart(other) || (is_silent && now_ns - other.first_ns < kSilence_ns)) continue;
      other.is_named = true;
      remarks.push_back(is_silent ? silence_of(other.name, other.address, secured_)
                                  : Remark{gateway_text(other.name, other.address) + " is of session " + other.session +
                                           ", this one of session " + session_ +
                                           ": nothing is exchanged; start both with "
                                           "the same --session, if they belong together"});
    }
    return remarks;
  }

  // With security: the name of a gateway with which this one should try the handshake again, by a new participant of
  // its own; empty: none. Cyclone DDS 0.10 can lose one for good on a bad line (issue 1895), also the second handshake
  // with a gateway that both have lost in between. Of two gateways the one with the greater GUID tries. Each
  // participant is named once. `hears(host)`: whether a host of this session is heard now.
  template <class Hears>
  std::string take_lost_handshake(std::int64_t now_ns, const Hears& hears) {
    for (auto& [key, other] : others_) {
      if (!secured_ || key > self_ || other.name.empty() || !other.session.empty() || other.is_lost) continue;
      if (other.is_here && hears(other.host)) other.heard_ns = now_ns;
      const std::int64_t since_ns = other.is_here ? other.heard_ns : other.first_ns;
      if (since_ns == 0 || now_ns - since_ns < kHandshake_ns) continue;
      other.is_lost = true;
      return other.name;
    }
    return "";
  }

 private:
  static constexpr int kMaxTaken = 256;          // samples at once
  static constexpr std::size_t kMaxOthers = 64;  // participants that are remembered; forged ones beyond are not named
  // [ns] With a shorter time a loaded machine would name hosts that join: their writers are known after themselves.
  static constexpr std::int64_t kSilence_ns = 5'000'000'000;
  // [ns] A handshake on a bad line is done, or lost for good, within this time.
  static constexpr std::int64_t kHandshake_ns = 8'000'000'000;
  static constexpr std::size_t kMaxText = 64;  // [bytes] of a text about itself that a participant sends

  using Key = std::array<std::uint8_t, 16>;  // GUID of a participant
  struct Other {
    std::string name, address;  // of a gateway; empty: it is none
    std::int64_t first_ns = 0;  // when it was first heard
    std::int64_t heard_ns = 0;  // when its host was heard last; 0: never
    bool is_here = false;       // writes in this session
    std::string host;           // of this session, whose writers it has
    std::string session;        // of its writers, another one; empty: none known
    bool is_named = false;
    bool is_lost = false;  // take_lost_handshake() has named it
  };

  // A gateway that exchanges nothing with this one.
  static bool is_apart(const Other& other) { return !other.is_here && !other.name.empty(); }

  static std::string property(const dds_qos_t* qos, const char* name) {
    char* value = nullptr;
    if (qos == nullptr || !dds_qget_prop(qos, name, &value) || value == nullptr) return "";
    std::string text = text::printable(std::string_view(value).substr(0, kMaxText));
    dds_free(value);
    return text;
  }

  // First address of a participant, such as 192.168.10.2.
  static std::string address_of(const dds_qos_t* qos) {
    std::string address = property(qos, "__NetworkAddresses");
    if (const auto slash = address.find('/'); slash != std::string::npos) address.erase(0, slash + 1);
    return address.substr(0, address.find_first_of(":,"));
  }

  // What is known of another participant; nullptr: it is this one, or forged.
  Other* other_of(const Key& key) {
    if (key == self_ || (others_.size() >= kMaxOthers && !others_.contains(key))) return nullptr;
    return &others_[key];
  }

  void take_participants(std::int64_t now_ns) {
    take_samples(participants_, kMaxTaken, [&](const void* taken, const dds_sample_info_t& info) {
      const auto& sample = *static_cast<const dds_builtintopic_participant_t*>(taken);
      const Key key = std::to_array(sample.key.v);
      if (info.instance_state != DDS_IST_ALIVE) others_.erase(key);
      Other* other = info.instance_state == DDS_IST_ALIVE && info.valid_data ? other_of(key) : nullptr;
      if (other == nullptr) return;
      if (property(sample.qos, "__ProcessName") == "gateway") {
        other->name = property(sample.qos, "__Hostname");
        other->address = address_of(sample.qos);
      }
      if (other->first_ns == 0) other->first_ns = now_ns;
    });
  }

  // A writer may be heard of before its participant.
  void take_writers() {
    take_samples(writers_, kMaxTaken, [&](const void* taken, const dds_sample_info_t& info) {
      const auto& sample = *static_cast<const dds_builtintopic_endpoint_t*>(taken);
      Other* other = info.valid_data ? other_of(std::to_array(sample.participant_key.v)) : nullptr;
      std::uint32_t count = 0;
      char** partitions = nullptr;
      if (other == nullptr || sample.qos == nullptr || !dds_qget_partition(sample.qos, &count, &partitions)) return;
      for (std::uint32_t i = 0; i < count; ++i) {
        const std::string session = text::printable(std::string_view(partitions[i]).substr(0, kMaxText));
        if (session == session_)
          other->is_here = true;
        else
          other->session = session;
        dds_free(partitions[i]);
      }
      void* data = nullptr;
      std::size_t bytes = 0;
      if (other->is_here && dds_qget_groupdata(sample.qos, &data, &bytes))
        other->host.assign(static_cast<const char*>(data), std::min(bytes, kMaxText));
      dds_free(data);
      dds_free(partitions);
    });
  }

  std::int32_t participants_ = 0, writers_ = 0;  // readers
  Key self_{};
  std::string session_;
  bool secured_ = false;
  std::map<Key, Other> others_;
};

}  // namespace yars::gateway::dds
