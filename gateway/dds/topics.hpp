// Topics of a session over DDS: their names, structures and quality of service; which host writes a sample, in a
// network with certificates.
// Inputs: the structures that idlc makes of gateway/yars_network.idl; the writers that DDS has matched with this host's
// readers. Each reports its host's name (policy GROUP_DATA).
// Outputs: the host of a writer; whether a host has a writer of a topic.
// Errors: 0 for a writer whose name is not that of its certificate, and for one that DDS does not know.
// Source: docs/network.md#topics, with the reason of each setting. DDS Security 1.1, 9.3.3: the first 48 bits of a
// participant's GUID are a hash of its certificate's subject name. Cyclone DDS checks them when it authenticates the
// participant, and lets nobody write a topic that his permissions do not name.
#pragma once

#include <dds/dds.h>
#include <openssl/sha.h>
#include <openssl/x509.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "gateway/dds/yars_network.h"
#include "gateway/host_agreement.hpp"
#include "lib/radar/network.hpp"

namespace yars::gateway::dds {

// Instances of one writer by the keys of a topic, with room for some that have ended elsewhere.
inline constexpr std::uint32_t kOne = 2;         // its host
inline constexpr std::uint32_t kPairs = 64;      // its host and another one, a lane or a role
inline constexpr std::uint32_t kReceipts = 512;  // another host and a lane
inline constexpr std::uint32_t kMaps = 64;       // eight
inline constexpr std::uint32_t kRows = 16384;    // 1024 rows of each of eight maps, and of eight before them

// TOPIC(name, structure, samples kept of each instance, instances of one writer), in the order of
// gateway/yars_network.idl. LockstepSample::written has the same order. Histories have the depth of their rings.
#define YARS_TOPICS(TOPIC)                                         \
  TOPIC(hosts, yars_net_HostSample, 1, kOne)                       \
  TOPIC(probes, yars_net_ProbeSample, 1, kPairs)                   \
  TOPIC(clock, yars_net_ClockSample, 1, kOne)                      \
  TOPIC(clock_requests, yars_net_ClockRequestSample, 16, kOne)     \
  TOPIC(ownship, yars_net_OwnshipSample, 1, kOne)                  \
  TOPIC(input_events, yars_net_InputEventSample, 128, kPairs)      \
  TOPIC(event_receipts, yars_net_EventReceiptSample, 1, kReceipts) \
  TOPIC(applied_events, yars_net_AppliedEventSample, 1024, kOne)   \
  TOPIC(radar_state, yars_net_RadarStateSample, 1, kOne)           \
  TOPIC(outputs, yars_net_OutputsSample, 1, kOne)                  \
  TOPIC(advice, yars_net_AdviceSample, 1, kOne)                    \
  TOPIC(model_status, yars_net_ModelStatusSample, 1, kOne)         \
  TOPIC(model_ticks, yars_net_ModelTickSample, 1024, kOne)         \
  TOPIC(sweeps, yars_net_SweepSample, 1024, kOne)                  \
  TOPIC(traffic, yars_net_TrafficSample, 1, kOne)                  \
  TOPIC(traffic_latched, yars_net_LatchedTrafficSample, 64, kOne)  \
  TOPIC(patch_maps, yars_net_PatchMapSample, 1, kMaps)             \
  TOPIC(patch_rows, yars_net_PatchRowSample, 1, kRows)             \
  TOPIC(captions, yars_net_CaptionSample, 1, kOne)                 \
  TOPIC(recorder_status, yars_net_RecorderStatusSample, 1, kOne)   \
  TOPIC(lockstep, yars_net_LockstepSample, 1, kPairs)              \
  TOPIC(world, yars_net_WorldSample, 1, kOne)                      \
  TOPIC(world_latched, yars_net_LatchedWorldSample, 16, kOne)      \
  TOPIC(world_requests, yars_net_WorldRequestSample, 1, kOne)

#define YARS_TOPIC(name, ...) name,
enum class Topic : std::uint8_t { YARS_TOPICS(YARS_TOPIC) };
#undef YARS_TOPIC

#define YARS_TOPIC(name, Sample, ...)       \
  constexpr Topic topic_of(const Sample*) { \
    return Topic::name;                     \
  }
YARS_TOPICS(YARS_TOPIC)
#undef YARS_TOPIC
template <class Sample>
inline constexpr Topic kTopicOf = topic_of(static_cast<const Sample*>(nullptr));

constexpr std::size_t index_of(Topic topic) {
  return static_cast<std::size_t>(topic);
}

struct TopicSettings {
  std::string_view name;
  const dds_topic_descriptor_t* structure;
  int depth;                // samples kept of each instance
  std::uint32_t instances;  // maximum number of instances (keys) of one writer
};

inline constexpr std::size_t kTopicCount = yars_net_kTopics;
#define YARS_TOPIC(name, Sample, depth, instances) TopicSettings{#name, &Sample##_desc, depth, instances},
inline constexpr std::array<TopicSettings, kTopicCount> kSettings{{YARS_TOPICS(YARS_TOPIC)}};
#undef YARS_TOPIC
static_assert(std::ranges::equal(kSettings, radar::kTopicNames, {}, &TopicSettings::name));

constexpr const TopicSettings& settings_of(Topic topic) {
  return kSettings[index_of(topic)];
}

using GuidPrefix = std::array<std::uint8_t, 6>;

// First 48 bits of the GUID of a participant whose certificate has the subject name CN=`name`. A certificate may encode
// the name as UTF8String, which OpenSSL does, or as PrintableString.
enum class NameEncoding { utf8, printable };
inline GuidPrefix guid_prefix_of(std::string_view name, NameEncoding encoding) {
  const std::unique_ptr<X509_NAME, decltype(&X509_NAME_free)> subject(X509_NAME_new(), X509_NAME_free);
  X509_NAME_add_entry_by_txt(subject.get(), "CN",
                             encoding == NameEncoding::utf8 ? V_ASN1_UTF8STRING : V_ASN1_PRINTABLESTRING,
                             reinterpret_cast<const unsigned char*>(name.data()), static_cast<int>(name.size()), -1, 0);
  unsigned char* encoded = nullptr;
  const int length = i2d_X509_NAME(subject.get(), &encoded);
  std::array<unsigned char, SHA256_DIGEST_LENGTH> hash{};
  if (length > 0) SHA256(encoded, static_cast<std::size_t>(length), hash.data());
  OPENSSL_free(encoded);
  // The hash moved by one bit, after a first bit that is set.
  GuidPrefix prefix{};
  unsigned carried = 1;
  for (std::size_t i = 0; i < prefix.size(); ++i) {
    prefix[i] = static_cast<std::uint8_t>(carried << 7 | hash[i] >> 1);
    carried = hash[i] & 1U;
  }
  return prefix;
}

class Senders {
 public:
  // Host of a writer whose sample `reader` has taken; 0: unknown.
  std::uint64_t host_of(dds_entity_t reader, dds_instance_handle_t writer) {
    if (const auto found = hosts_.find(writer); found != hosts_.end()) return found->second;
    const auto host = read_host(reader, writer);
    if (!host) return 0;
    if (hosts_.size() >= kMaxRemembered) hosts_.clear();
    return hosts_[writer] = *host;
  }
  // Reads which writers a topic's reader has, if that has changed.
  void update(dds_entity_t reader, Topic topic) {
    dds_subscription_matched_status_t status{};
    if (reader <= 0 || dds_get_subscription_matched_status(reader, &status) != DDS_RETCODE_OK) return;
    if (status.total_count_change == 0 && status.current_count_change == 0) return;
    std::array<dds_instance_handle_t, kMaxWriters> matched{};
    const auto count = static_cast<std::size_t>(
        std::max<dds_return_t>(dds_get_matched_publications(reader, matched.data(), matched.size()), 0));
    auto& hosts = writers_[index_of(topic)];
    hosts.clear();
    for (const dds_instance_handle_t writer : std::span(matched).first(std::min(count, kMaxWriters)))
      if (const std::uint64_t host = host_of(reader, writer); host != 0) hosts.push_back(host);
  }
  bool writes(std::uint64_t host, Topic topic) const { return std::ranges::count(writers_[index_of(topic)], host) > 0; }

 private:
  static constexpr std::size_t kMaxWriters = 256;      // of a topic
  static constexpr std::size_t kMaxRemembered = 4096;  // writers, with those that have ended

  // 0: the name is not that of the certificate; nullopt: DDS does not know the writer, which may have ended.
  static std::optional<std::uint64_t> read_host(dds_entity_t reader, dds_instance_handle_t writer) {
    const std::unique_ptr<dds_builtintopic_endpoint_t, decltype(&dds_builtintopic_free_endpoint)> endpoint(
        dds_get_matched_publication_data(reader, writer), dds_builtintopic_free_endpoint);
    if (!endpoint) return std::nullopt;
    void* value = nullptr;
    std::size_t size = 0;
    if (endpoint->qos == nullptr || !dds_qget_groupdata(endpoint->qos, &value, &size) || value == nullptr) return 0;
    const std::string name(static_cast<const char*>(value), size);
    dds_free(value);
    for (const NameEncoding encoding : {NameEncoding::utf8, NameEncoding::printable})
      if (std::ranges::equal(guid_prefix_of(name, encoding), std::span(endpoint->participant_key.v).first<6>()))
        return host_id(name);
    return 0;
  }

  std::unordered_map<dds_instance_handle_t, std::uint64_t> hosts_;  // by writer
  std::array<std::vector<std::uint64_t>, kTopicCount> writers_;     // hosts of each topic's writers
};

}  // namespace yars::gateway::dds
