// Connection of one process to the DDS domain of a session: writers and readers of all topics.
// Inputs: the form Network; samples, as structures of yars_network.h.
// Outputs: samples of other processes; counts of samples and bytes.
// Errors: open(): an interface that does not exist, a configuration that Cyclone DDS refuses, unreadable identities.
//   Samples of a writer beyond its number of instances (TopicSettings) are left out, with a message.
// Threads: one. Cyclone DDS has threads of its own.
// Source: Eclipse Cyclone DDS 0.10, C API.
#pragma once

#include <dds/dds.h>

#include <deque>
#include <memory>
#include <type_traits>

#include "databuffer/messages/network_status.hpp"
#include "gateway/dds/instance_quota.hpp"
#include "gateway/dds/participants.hpp"
#include "gateway/dds/topics.hpp"
#include "lib/error/error.hpp"
#include "lib/radar/network.hpp"

namespace yars::gateway::dds {

// First UDP port of a DDS domain; those of its participants begin 10 ports later (DDSI-RTPS 2.2, section 9.6.1).
constexpr int first_port(int domain) {
  return 7400 + 250 * domain;
}

class Link {
 public:
  // `session`: its name, which is the DDS partition. `settings.name`: of this host, not empty.
  static error::Expected<Link> open(const radar::NetworkSettings& settings, const std::string& session);

  // True if the form Network and the permissions of DDS Security let the topic out, or in.
  bool writes(Topic topic) const;
  bool reads(Topic topic) const { return state_->at(topic).reader > 0; }
  // True if another host has a writer of the topic, as its permissions must allow. Without security always true.
  bool host_writes(std::uint64_t host, Topic topic) const {
    return !state_->is_secured() || !reads(topic) || state_->senders.writes(host, topic);
  }

  // False: the topic is not let out, or DDS refused the sample.
  template <class Sample>
  bool write(const Sample& sample) {
    return state_->write(state_->at(kTopicOf<Sample>).writer, sample);
  }
  // Ends the sample's instance, for example a row of a map that no longer exists.
  template <class Sample>
  void dispose(const Sample& sample) {
    const dds_entity_t writer = state_->at(kTopicOf<Sample>).writer;
    if (writer <= 0) return;
    dds_dispose(writer, &sample);
    dds_unregister_instance(writer, &sample);
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
    state_->update_senders();
    take_all<yars_net_HostSample>(take);
  }

  // Returns when a sample of a topic that is answered at once has arrived (probes, input events), or after `time_ns`.
  void wait(std::int64_t time_ns) {
    if (time_ns > 0) dds_waitset_wait(state_->waitset, nullptr, 0, time_ns);
  }
  // True if the readers of all other hosts have what was written here.
  bool is_acknowledged() const;

  const databuffer::TopicStatus& counts(Topic topic) const { return state_->at(topic).counts; }
  // Messages of Cyclone DDS since the last call (MessageLimit). Call it about twice a second.
  std::vector<std::string> take_messages(std::int64_t now_ns);
  Participants& participants() { return state_->others; }  // that exchange nothing with this one

 private:
  static constexpr std::uint32_t kMaxLanes = 16;  // ownship lanes with writers of their own
  // Samples, or ends of instances, that one call of take() passes on: 30 ms. Without a limit the end of a writer of
  // 70,000 instances kept a gateway from its announcements for longer than the lease of 0.5 s.
  static constexpr int kMaxTaken = 4096;

  // A topic, with the entities that Cyclone DDS has for it.
  struct TopicState {
    explicit TopicState(Topic topic);
    dds_entity_t topic = 0, reader = 0, writer = 0;
    databuffer::TopicStatus counts{};
    std::uint64_t posed = 0;        // samples that named another host than their writer's
    InstanceQuota quota;            // of the reader
    std::uint64_t next_report = 1;  // number of refused samples that is worth a message
  };
  struct State {
    explicit State(const radar::NetworkSettings& network_settings) : settings(network_settings) {
      for (std::size_t i = 0; i < kTopicCount; ++i) topics.emplace_back(static_cast<Topic>(i));
    }
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    ~State() {  // other hosts learn at once that this one has left
      if (domain > 0) dds_delete(domain);
      dds_set_log_sink(nullptr, nullptr);
    }
    error::Expected<void> open_topics(const std::string& session);
    dds_entity_t open_reader(Topic topic);  // negative: an error of Cyclone DDS
    // The only way to free instances whose writer lives. What the writers keep arrives again.
    void renew_flooded_reader(Topic topic) {
      constexpr std::uint64_t kMaxStrays = 8192;  // ends of instances that never had a sample: 16 MB
      if (at(topic).quota.strays() <= kMaxStrays || at(topic).reader <= 0) return;
      dds_delete(at(topic).reader);
      at(topic).quota.clear();
      at(topic).reader = open_reader(topic);
    }
    void update_senders() {
      constexpr std::uint32_t kInterval = 10;  // passes
      if (!is_secured() || passes++ % kInterval != 0) return;
      for (std::size_t i = 0; i < kTopicCount; ++i) senders.update(topics[i].reader, static_cast<Topic>(i));
    }
    // True if the sample's writer is the host that the sample names, or may be.
    bool is_from(Topic topic, dds_instance_handle_t writer, std::uint64_t host);
    bool is_secured() const { return !settings.security.empty(); }
    template <class Sample>
    bool write(dds_entity_t writer, const Sample& sample) {
      if (writer <= 0 || dds_write(writer, &sample) < 0) return false;
      ++at(kTopicOf<Sample>).counts.sent;
      at(kTopicOf<Sample>).counts.sent_bytes += bytes_of(sample);
      return true;
    }
    TopicState& at(Topic topic) { return topics[index_of(topic)]; }

    radar::NetworkSettings settings;
    dds_entity_t domain = 0, participant = 0, publisher = 0, subscriber = 0, waitset = 0;
    std::array<dds_entity_t, kMaxLanes> ownship_writers{};
    std::array<std::uint32_t, kMaxLanes> ownship_strengths{};
    std::deque<TopicState> topics;  // Cyclone DDS keeps pointers to them
    Participants others;
    Senders senders;  // in use with security
    std::uint32_t passes = 0;
  };

  explicit Link(std::unique_ptr<State> state) : state_(std::move(state)) {}
  // Filter of a topic. It is asked for each sample that arrives, on threads of Cyclone DDS.
  static bool admits(const dds_sample_info_t* info, void* topic) {
    return static_cast<TopicState*>(topic)->quota.admits(info->instance_handle, info->publication_handle);
  }
  template <class Sample>
  static std::size_t bytes_of(const Sample& sample) {
    if constexpr (std::is_same_v<Sample, yars_net_SweepSample>)
      return sizeof sample - sizeof sample.video + sample.video._length;
    return sizeof sample;
  }
  // Host that a sample names as its writer.
  template <class Sample>
  static std::uint64_t sender_of(const Sample& sample) {
    if constexpr (std::is_same_v<Sample, yars_net_ProbeSample>)
      return sample.stage == 0 ? sample.from : sample.to;
    else
      return sample.host;
  }
  template <class Sample, class Take>
  void take_all(const Take& take) {
    constexpr Topic kTopic = kTopicOf<Sample>;
    TopicState& state = state_->at(kTopic);
    state_->renew_flooded_reader(kTopic);
    take_samples(state.reader, kMaxTaken, [&](const void* bytes, const dds_sample_info_t& info) {
      const Sample& sample = *static_cast<const Sample*>(bytes);
      const bool has_ended = info.instance_state != DDS_IST_ALIVE;
      if (has_ended) state.quota.end(info.instance_handle);
      if (info.valid_data) {
        ++state.counts.received;
        state.counts.received_bytes += bytes_of(sample);
      } else if (!has_ended || kTopic != Topic::hosts) {
        return;
      }
      // A sample that the reader held before its writer's lease ended comes with the end.
      if (state_->is_from(kTopic, info.publication_handle, sender_of(sample))) take(sample, info.valid_data);
    });
  }

  std::unique_ptr<State> state_;
};

}  // namespace yars::gateway::dds
