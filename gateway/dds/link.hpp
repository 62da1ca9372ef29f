// Connection of one process to the DDS domain of a session: writers and readers of all topics.
// Inputs: the form Network; samples, as structures of yars_network.h.
// Outputs: samples of other processes; counts of samples and bytes.
// Errors: open(): an interface that does not exist, a configuration that Cyclone DDS refuses, unreadable identities.
//   Messages of Cyclone DDS are kept for take_messages(). Samples of a writer beyond its number of instances
//   (TopicSettings) are left out, with a message.
// Threads: one. Cyclone DDS has threads of its own.
// Source: Eclipse Cyclone DDS 0.10, C API.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "databuffer/messages/network_status.hpp"
#include "gateway/dds/topics.hpp"
#include "lib/error/error.hpp"
#include "lib/radar/network.hpp"

namespace yars::gateway::dds {

class Participants;

class Link {
 public:
  // `session`: name of the session, which is the DDS partition.
  // `settings.name`: of this host, not empty.
  static error::Expected<Link> open(const radar::NetworkSettings& settings, const std::string& session);
  Link(Link&&) noexcept;
  Link& operator=(Link&&) noexcept;
  ~Link();  // other hosts learn at once that this one has left

  // True if the form Network and the permissions of DDS Security let the topic out, or in.
  bool writes(Topic topic) const;
  bool reads(Topic topic) const;
  // True if another host has a writer of the topic, as its permissions must allow. Without security always true.
  bool host_writes(std::uint64_t host, Topic topic) const;

  // False: the topic is not let out, or DDS refused the sample.
  template <class Sample>
  bool write(const Sample& sample) {
    return write_bytes(kTopicOf<Sample>, &sample, bytes_of(sample));
  }
  // Ends the sample's instance, for example a row of a map that no longer exists.
  template <class Sample>
  void dispose(const Sample& sample) {
    dispose_bytes(kTopicOf<Sample>, &sample);
  }
  // Ownship of one lane, with the lane's priority as strength. The other hosts get the strongest live writer's samples.
  bool write_ownship(std::uint32_t lane, const yars_net_OwnshipSample& sample);
  void end_ownship(std::uint32_t lane);

  // Calls take(const Sample&) for each sample that has arrived, in the order of each writer; the rest of a flood is
  // left for the next call. With security, samples that name another host than that of their writer are left out.
  template <class Sample, class Take>
  void take(const Take& take) {
    static_assert(!std::is_same_v<Sample, yars_net_HostSample>, "hosts also end; see take_hosts()");
    take_all<Sample>([&](const Sample& sample, bool) { take(sample); });
  }
  // As take(), with take(sample, alive). `alive` false: the host has left, or DDS has not heard it for 1 s; of the
  // sample only `host` is valid.
  template <class Take>
  void take_hosts(const Take& take) {
    take_all<yars_net_HostSample>(take);
  }

  // Returns when a sample of a topic that is answered at once has arrived (probes, input events), or after `time_ns`.
  void wait(std::int64_t time_ns);
  // True if the readers of all other hosts have what was written here.
  bool is_acknowledged() const;

  const databuffer::TopicStatus& counts(Topic topic) const;
  // Messages of Cyclone DDS since the last call: at most some lines a second, and a count of those left out. Call it
  // about twice a second. `now_ns`: CLOCK_MONOTONIC.
  std::vector<std::string> take_messages(std::int64_t now_ns);
  Participants& participants();  // that exchange nothing with this one

 private:
  struct State;
  // Of a sample: its size, and the host that it names as its writer.
  struct Facts {
    std::size_t bytes;
    std::uint64_t sender;
  };
  explicit Link(std::unique_ptr<State> state);
  template <class Sample>
  static std::size_t bytes_of(const Sample& sample) {
    if constexpr (std::is_same_v<Sample, yars_net_SweepSample>)
      return sizeof sample - sizeof sample.video + sample.video._length;
    else
      return sizeof sample;
  }
  template <class Sample>
  static Facts facts_of(const void* bytes) {
    const Sample& sample = *static_cast<const Sample*>(bytes);
    if constexpr (std::is_same_v<Sample, yars_net_ProbeSample>)
      return {sizeof sample, sample.stage == 0 ? sample.from : sample.to};
    else
      return {bytes_of(sample), sample.host};
  }
  template <class Sample, class Take>
  void take_all(const Take& take) {
    take_each(kTopicOf<Sample>, &facts_of<Sample>,
              [&](const void* sample, bool alive) { take(*static_cast<const Sample*>(sample), alive); });
  }
  void take_each(Topic topic, Facts (*facts_of)(const void*), const std::function<void(const void*, bool)>& take);
  bool write_bytes(Topic topic, const void* sample, std::size_t bytes);
  void dispose_bytes(Topic topic, const void* sample);

  std::unique_ptr<State> state_;
};

}  // namespace yars::gateway::dds
