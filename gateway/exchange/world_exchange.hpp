// The world on several hosts: sea, wind, rain, jammers, movers and sequence points that any host's instructor changes.
// Inputs: on radar-model's host its containers world, world_configured and world_latched, and requests of other hosts;
//   on the others samples of that host, and the local container world_request.
// Outputs: on radar-model's host samples, and requested changes in `world`; on the others the same three
//   containers, and requests. An answer for each request.
// Errors: an invalid record is refused, counted and noted. A request is answered as outdated if it is not based on the
//   newest edit, so that no change of another instructor is lost. One that is older than 1 s has no effect.
// Limits: one waiting request of each host; one takes effect each 50 ms.
// Source: docs/network.md#the-world.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "databuffer/session/session_layout.hpp"
#include "gateway/exchange/context.hpp"
#include "gateway/exchange/history_progress.hpp"

namespace yars::gateway {

class WorldExchange {
 public:
  explicit WorldExchange(WorldNumbers& numbers) : numbers_(&numbers) {}
  void send(Context& context);
  void receive(Context& context);
  // Writes here what the host with the role has last said, and answers requests.
  void publish(Context& context);

  void receive(Context& context, const yars_net_WorldSample& sample);
  void receive(Context& context, const yars_net_LatchedWorldSample& sample);
  void receive(Context& context, const yars_net_WorldRequestSample& sample);

  // What send() sends. nullopt: nothing new.
  std::optional<yars_net_WorldSample> news(Context& context);
  std::optional<yars_net_WorldRequestSample> request(Context& context);

 private:
  // A host that requests changes.
  struct Editor {
    std::optional<yars_net_WorldRequestSample> waiting = std::nullopt;
    std::int64_t arrived_ns = 0;
    std::uint64_t segment = 0, request = 0;  // that was answered last
    databuffer::WorldAnswer answer = databuffer::WorldAnswer::none;
    std::int64_t applied_ns = 0;  // its last change that took effect
  };
  // Numbers by which a change is found without reading the records: of world, world_latched, world_configured, answers.
  using Versions = std::array<std::uint64_t, 4>;

  void send_latched(Context& context);
  void write_state(Context& context, const yars_net_WorldSample& sample);
  void write_answer(Context& context, const yars_net_WorldSample& sample) const;
  void write_latched(Context& context, const yars_net_LatchedWorldSample& sample);
  void resume_latched(Context& context, const yars_net_LatchedWorldSample& sample);
  bool answer(Context& context, Editor& editor);
  databuffer::WorldAnswer apply(Context& context, const yars_net_WorldRequestSample& request,
                                const databuffer::Claim& instructor) const;

  WorldNumbers* numbers_;
  // On radar-model's host.
  std::optional<std::uint64_t> latched_cursor_;  // next record of the ring to send; nullopt: none was sent
  Versions said_{};
  std::uint64_t answer_count_ = 0;
  HostMemory<Editor> editors_;
  // On the others.
  HostMemory<yars_net_WorldSample> states_;
  HostMemory<yars_net_LatchedWorldSample> latched_;
  // The last sample that write_state() had, and the version of `world` then.
  std::uint64_t written_host_ = 0, written_start_ = 0, written_number_ = 0, written_version_ = 0;
  std::uint64_t requested_ = 0, requested_of_ = 0;  // number of the request that was sent last, and to which host
};

}  // namespace yars::gateway
