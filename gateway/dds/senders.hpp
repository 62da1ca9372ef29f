// Which host writes a sample, in a network with certificates.
// Inputs: the writers that DDS has matched with this host's readers. Each tells its host's name (policy GROUP_DATA).
// Outputs: the host of a writer; whether a host has a writer of a topic.
// Errors: 0 for a writer whose name is not that of its certificate, and for one that DDS does not know.
// Source: DDS Security 1.1, 9.3.3: the first 48 bits of a participant's GUID are a hash of its certificate's subject
//   name. Cyclone DDS checks them when it authenticates the participant, and lets nobody write a topic that his
//   permissions do not name.
#pragma once

#include <dds/dds.h>

#include <array>
#include <cstdint>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "gateway/dds/topics.hpp"

namespace yars::gateway::dds {

using GuidPrefix = std::array<std::uint8_t, 6>;

// First 48 bits of the GUID of a participant whose certificate has the subject name CN=`name`. A certificate may encode
// the name as UTF8String, which OpenSSL does, or as PrintableString.
enum class NameEncoding { utf8, printable };
GuidPrefix guid_prefix_of(std::string_view name, NameEncoding encoding);

class Senders {
 public:
  // Host of a writer whose sample `reader` has taken; 0: unknown.
  std::uint64_t host_of(dds_entity_t reader, dds_instance_handle_t writer);
  // Reads which writers a topic's reader has, if that has changed.
  void update(dds_entity_t reader, Topic topic);
  bool writes(std::uint64_t host, Topic topic) const;

 private:
  std::unordered_map<dds_instance_handle_t, std::uint64_t> hosts_;  // by writer
  std::array<std::vector<std::uint64_t>, kTopicCount> writers_;     // hosts of each topic's writers
};

}  // namespace yars::gateway::dds
