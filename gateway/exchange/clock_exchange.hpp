// The session clock on several hosts: one host owns it, the others follow.
// Inputs: the local segment's clock; clocks and requests of other hosts; measured offsets.
// Outputs: on the owner, the clock as a sample, and requested changes applied; on the others, the owner's clock in the
//   local segment, translated by the offset and slewed, and local changes as requests.
// Errors: sim time on two hosts differs by at most the error of the offset, half of the least round trip, plus 50 us,
//   as soon as a greater error is slewed. A change of the clock (freeze, rate, step, reset) reaches the others one
//   transmission later.
// Source: docs/network.md#time.
#pragma once

#include <cstdint>
#include <optional>

#include "databuffer/messages/world_state.hpp"
#include "gateway/authority.hpp"
#include "gateway/clock_offset.hpp"
#include "gateway/exchange/context.hpp"
#include "gateway/pace.hpp"

namespace yars::gateway {

// The owner's clock as it was last received, and as it was last written here.
struct FollowedClock {
  databuffer::ClockState theirs{};
  databuffer::ClockState written{};
  SlewedOffset offset;
  std::int64_t changed_ns = 0;  // last pass
};

// ClockRequestSample::new_epoch.
enum class EpochRequest : std::uint32_t { change, change_with_new_epoch, end_of_epoch };

class ClockExchange {
 public:
  void exchange(Context& context);

  void receive(Context& context, const yars_net_ClockSample& sample);
  void receive(Context& context, const yars_net_ClockRequestSample& sample);

  bool owns() const { return owns_; }
  bool joined() const { return owns_ || followed_.has_value(); }

 private:
  // [ns] A host keeps its own change of the clock until the owner has answered, at most for this time.
  static constexpr std::int64_t kRequestTime_ns = 500'000'000;
  void choose_owner(Context& context);
  void resolve_conflicts(Context& context);
  void end_epoch_of_meeting(Context& context);
  void raise_epoch(Context& context, std::uint32_t above);
  void publish(Context& context);
  void follow(Context& context);
  static std::int64_t continuous_offset(const databuffer::ClockState& mine, const databuffer::ClockState& theirs,
                                        std::int64_t measured_ns, std::int64_t now_ns);
  void adopt(Context& context, bool first);
  bool forward_local_change(Context& context);
  void request(Context& context, const databuffer::ClockState& before, const databuffer::ClockState& wanted,
               EpochRequest epoch);
  void slew(Context& context);

  bool owns_ = false;
  bool in_conflict_ = false;
  bool gave_way_ = false;
  std::optional<std::uint32_t> meeting_epoch_;  // in it this host gave way to another; it must end
  Pace meeting_pace_{kRequestTime_ns};
  std::int64_t epoch_begun_ns_ = 0;  // when the owner began the present epoch; 0: before this host followed it
  std::int64_t first_pass_ns_ = 0;
  Vacancy vacancy_;
  std::uint64_t owner_ = 0;  // 0: none
  databuffer::ClockState published_{};
  Pace pace_{250'000'000};
  HostMemory<yars_net_ClockSample> clocks_;
  std::optional<FollowedClock> followed_;
  std::int64_t request_pending_until_ns_ = 0;
};

}  // namespace yars::gateway
