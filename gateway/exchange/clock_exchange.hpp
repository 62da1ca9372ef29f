// The session clock on several hosts: one host owns it, the others follow.
// Inputs: the local segment's clock; clocks and requests of other hosts; measured offsets.
// Outputs: on the owner, the clock as a sample, and requested changes applied; on the others, the owner's clock in the
//   local segment, translated by the offset and slewed, and local changes as requests.
// Errors: sim time on two hosts differs by at most the error of the offset plus 50 us, once a greater error is slewed.
// Source: docs/network.md#time.
#pragma once

#include <cstdlib>
#include <limits>

#include "databuffer/messages/world_state.hpp"
#include "databuffer/session/session_changes.hpp"
#include "gateway/exchange/context.hpp"

namespace yars::gateway {

// ClockRequestSample::new_epoch.
enum class EpochRequest : std::uint32_t { change, change_with_new_epoch, end_of_epoch };

class ClockExchange {
 public:
  void exchange(Context& context) {
    context.take<yars_net_ClockSample, yars_net_ClockRequestSample>(*this);
    choose_owner(context);
    if (owns_)
      publish(context);
    else
      follow(context);
    end_epoch_of_meeting(context);
    context.session.restore_clock();
  }

  void receive(Context& context, const yars_net_ClockSample& sample) {
    if (context.new_and_valid<ClockState>(sample, sample.clock)) clocks_.keep(context.hosts, sample);
  }

  // Applies a change that another host asks for. Each request is applied once.
  void receive(Context& context, const yars_net_ClockRequestSample& sample) {
    const HostView* host = context.hosts.find(sample.host);
    if (!context.hosts.is_new(sample) || sample.owner != context.hosts.self().id || !owns_ || host == nullptr) return;
    const auto before = context.valid<ClockState>(sample, sample.before);
    const auto after = before ? context.valid<ClockState>(sample, sample.clock) : std::nullopt;
    if (!after) return;
    const RequestedChange change{*before, *after, sample.new_epoch != static_cast<std::uint32_t>(EpochRequest::change)};
    const ClockState& wanted = change.after;
    // DDS delivers what a host wrote before it was cut off. By then others may have changed the clock.
    const std::int64_t age_ns = context.now_ns - wanted.base_monotonic_ns;
    if (age_ns > kMaxRequestAge_ns) {
      const std::string line = "a change of the session clock is left out, because it is " +
                               std::to_string(age_ns / 1'000'000'000) + " s old";
      log::warning("host " + host->name + ": " + line);
      return context.hosts.refuse(sample, line);
    }
    if (sample.new_epoch == static_cast<std::uint32_t>(EpochRequest::end_of_epoch)) {
      if (!is_later(context.session.clock().epoch, wanted.epoch)) raise_epoch(context, wanted.epoch);
      return;
    }
    const auto changed = context.session.change_clock([&](const ClockState& clock) {
      const std::int64_t now_ns = databuffer::monotonic_ns();
      ClockState next = changed_clock(clock, change, now_ns);
      // The request has the sim time that its host had. The time of transmission has passed since.
      next.base_monotonic_ns = std::min(next.base_monotonic_ns, now_ns);
      next.epoch = clock.epoch + (change.begins_epoch ? 1 : 0);
      return next;
    });
    if (!changed) return context.hosts.refuse(sample, changed.error().message());
    log::info("host " + host->name + " has changed the session clock");
  }

  bool owns() const { return owns_; }
  bool joined() const { return owns_ || followed_.has_value(); }

 private:
  using ClockState = databuffer::ClockState;
  // [ns] A host keeps its own change of the clock until the owner has answered, at most for this time.
  static constexpr std::int64_t kRequestTime_ns = 500'000'000;
  // [ns] On a bad line a request takes up to some tenths of a second.
  static constexpr std::int64_t kMaxRequestAge_ns = 1'000'000'000;
  static constexpr std::int64_t kOneMeeting_ns = 1'000'000'000;  // what hosts see of it one after another
  static constexpr std::int64_t kMaxBehind_ns = 100'000'000;     // kMaxTicksBehind ticks
  static constexpr std::int64_t kRounding_ns = 1'000;            // of sim times that are equal but for their base

  // The owner's clock as it was last received, and as it was last written here.
  struct FollowedClock {
    ClockState theirs{}, written{};
    SlewedOffset offset;
    std::int64_t changed_ns = 0;  // last pass
  };
  // A change that another host has made to its clock at `after.base_monotonic_ns`.
  struct RequestedChange {
    ClockState before, after;
    bool begins_epoch = false;
  };

  // The owner's clock after a change that another host has made to its own. If somebody else has changed the clock
  // meanwhile, what the change left as it was stays as it is. So changes that two hosts make at the same time both take
  // effect, and sim time does not go back within an epoch.
  static ClockState changed_clock(const ClockState& clock, const RequestedChange& change, std::int64_t now_ns) {
    const auto& [before, after, begins_epoch] = change;
    const std::int64_t then_ns = after.base_monotonic_ns, before_ns = databuffer::sim_time_at(before, then_ns);
    // Running clocks of two hosts differ by the error of the offset.
    const std::int64_t max_apart_ns = clock.running != 0 ? kMaxBehind_ns : 0;
    if (before.epoch == clock.epoch && before.rate == clock.rate && before.running == clock.running &&
        std::abs(before_ns - databuffer::sim_time_at(clock, then_ns)) <= max_apart_ns)
      return after;
    const std::int64_t advance_ns = after.base_sim_ns - before_ns;
    const bool sets_time = std::abs(advance_ns) > kRounding_ns;  // false: the time only went on
    ClockState next = databuffer::rebased(clock, now_ns);
    if (begins_epoch && !equal(before, after)) {  // equal: the host asks for a new epoch alone
      next = after;                               // with its position of the aircraft
      next.base_monotonic_ns = now_ns;
      if (!sets_time) next.base_sim_ns = databuffer::sim_time_at(clock, now_ns);
    } else if (sets_time && before.epoch == clock.epoch) {
      next.base_sim_ns += advance_ns;
    }
    next.rate = after.rate != before.rate ? after.rate : clock.rate;
    next.running = after.running != before.running ? after.running : clock.running;
    return next;
  }

  void choose_owner(Context& context) {
    const auto owns = [&](const HostView& host) {
      return host.id == context.hosts.self().id ? owns_ : host.owns_clock;
    };
    const HostView* owner = preceding(context.hosts.views(), owns);
    resolve_conflicts(context);
    const bool listened = context.hosts.age_ns(context.now_ns) >= kListening_ns;
    const std::size_t rank = rank_of(context.hosts.views(), context.hosts.self());
    const bool may_own = listened && owner == nullptr && context.writes(dds::Topic::clock);
    if (vacancy_.may_take(may_own, rank, context.now_ns)) {
      owns_ = true;
      log::info("sets the session clock");
      followed_.reset();
      owner_ = context.hosts.self().id;
      return;
    }
    if (owner == nullptr) return;
    if (owns_ && owner->id != context.hosts.self().id) {
      owns_ = false;
      const std::uint32_t epoch = context.session.clock().epoch;
      if (is_later(epoch, context.hosts.said_by(owner->id).epoch)) meeting_epoch_ = epoch;
      log::info("follows the clock of host " + owner->name);
    }
    if (!owns_ && owner->id != owner_) followed_.reset();
    owner_ = owner->id;
  }

  // After a partition two hosts hold a role, or the part whose clock gives way has a later epoch. The host whose clock
  // stays begins a new epoch, so that no picture mixes records of the two parts, and epochs never go back. It may hear
  // of the other holder too late. Thus the host that gives way asks for the new epoch, until it has come.
  void resolve_conflicts(Context& context) {
    const bool gives_way = context.roles.gives_way();
    const bool has_begun = epoch_begun_ns_ != 0 && context.now_ns - epoch_begun_ns_ < kOneMeeting_ns;
    if (gives_way && !gave_way_ && !has_begun) meeting_epoch_ = context.session.clock().epoch;
    gave_way_ = gives_way;
    const std::uint32_t own_epoch = context.session.clock().epoch;
    std::uint32_t epoch = own_epoch;
    bool conflict = context.roles.in_conflict();
    bool precedes_all = owns_;
    for (const HostView& host : context.hosts.views().subspan(1)) {
      const std::uint32_t theirs = context.hosts.said_by(host.id).epoch;
      if (host.owns_clock || host.held_roles != 0) epoch = later_of(epoch, theirs);
      if (!owns_ || !host.owns_clock) continue;
      conflict = conflict || is_later(theirs, own_epoch);
      precedes_all = precedes_all && precedes(context.hosts.self(), host);
    }
    if (conflict && !in_conflict_ && precedes_all) raise_epoch(context, epoch);
    in_conflict_ = conflict;
  }

  void end_epoch_of_meeting(Context& context) {
    if (!meeting_epoch_) return;
    const ClockState clock = context.session.clock();
    if (is_later(clock.epoch, *meeting_epoch_)) return meeting_epoch_.reset();
    if (owns_) return raise_epoch(context, *meeting_epoch_);
    if (!followed_ || !meeting_pace_.is_due(false, context.now_ns)) return;
    ClockState ended = clock;
    ended.epoch = *meeting_epoch_;
    request(context, clock, ended, EpochRequest::end_of_epoch);
  }

  // The aircraft stays where it is: flight models go on from the ownship in use.
  void raise_epoch(Context& context, std::uint32_t above) {
    const auto model = databuffer::read_valid(context.layout().model_status);
    const bool has_ownship = model && (model->flags & databuffer::kModelStale) == 0;
    const auto raised = context.session.change_clock([&](const ClockState& clock) {
      ClockState next = databuffer::rebased(clock, databuffer::monotonic_ns());
      next.epoch = later_of(clock.epoch, above) + 1;
      next.reposition_latitude_deg = std::numeric_limits<double>::quiet_NaN();
      if (!has_ownship || model->epoch != clock.epoch) return next;
      databuffer::begin_at_aircraft(next, model->ownship, geo::Bearing::degrees(model->ownship.heading_deg));
      return next;
    });
    if (!raised) log::warning(raised.error().message());
    context.hosts.say(log::info, databuffer::NoteKind::restart, "two parts of the session meet; a new epoch begins");
  }

  void publish(Context& context) {
    const ClockState clock = context.session.clock();
    if (!pace_.is_due(!equal(clock, published_), context.now_ns)) return;
    published_ = clock;
    auto sample = context.made<yars_net_ClockSample>();
    copy_record(sample.clock, clock);
    context.write(sample);
  }

  void follow(Context& context) {
    const auto offset_ns = context.hosts.offset_ns(owner_);
    const auto* newest = clocks_.newest(context.hosts, owner_);
    if (owner_ == 0 || !offset_ns || newest == nullptr) return;
    const auto theirs = std::bit_cast<ClockState>(newest->clock);
    if (followed_ && forward_local_change(context)) return;
    if (context.now_ns < request_pending_until_ns_ && followed_ && equal(theirs, followed_->theirs)) return;
    const bool unanswered = std::exchange(request_pending_until_ns_, 0) != 0;
    if (followed_ && !unanswered && equal(theirs, followed_->theirs)) return slew(context);
    const bool first = !followed_.has_value();
    if (first)
      followed_ = FollowedClock{};
    else if (is_later(theirs.epoch, followed_->theirs.epoch))
      epoch_begun_ns_ = context.now_ns;
    followed_->theirs = theirs;
    const ClockState before = context.session.clock();
    if (first) followed_->offset.set(continuous_offset(before, theirs, *offset_ns, context.now_ns));
    adopt(context, first);
    // Local roles that are ahead in the same epoch would wait until the owner's sim time reaches theirs.
    if (!followed_) return;
    const std::int64_t ahead_ns = databuffer::sim_time_at(before, context.now_ns) - context.session.sim_time_ns();
    if (first && before.epoch == theirs.epoch && ahead_ns > kMaxBehind_ns && !context.lockstep)
      request(context, followed_->written, followed_->written, EpochRequest::change_with_new_epoch);
  }

  // Offset with which the owner's clock continues the local one. After a change of the owner both show nearly the same
  // time, and the rest is slewed. Otherwise the measured offset.
  static std::int64_t continuous_offset(const ClockState& mine, const ClockState& theirs, std::int64_t measured_ns,
                                        std::int64_t now_ns) {
    if (mine.epoch != theirs.epoch || mine.running != theirs.running || mine.rate != theirs.rate || !(mine.rate > 0.0))
      return measured_ns;
    const std::int64_t ahead_ns =
        databuffer::sim_time_at(mine, now_ns) - databuffer::sim_time_at(theirs, now_ns + measured_ns);
    if (std::abs(ahead_ns) > kMaxBehind_ns) return measured_ns;
    return measured_ns + static_cast<std::int64_t>(static_cast<double>(ahead_ns) / mine.rate);
  }

  // Writes the owner's clock to the local segment, with its base at the present time. A local change since the
  // beginning of this pass stays; the next pass forwards it. `first`: what stands there is not followed.
  void adopt(Context& context, bool first) {
    const std::int64_t now_ns = databuffer::monotonic_ns();
    ClockState mine = followed_->theirs;
    // The owner's clock has begun. An offset by which it has not would leave an error that nothing slews.
    const std::int64_t least_ns = mine.base_monotonic_ns - now_ns;
    if (mine.running != 0 && followed_->offset.offset_ns() < least_ns) followed_->offset.set(least_ns);
    mine.base_sim_ns = databuffer::sim_time_at(followed_->theirs, now_ns + followed_->offset.offset_ns());
    mine.base_monotonic_ns = now_ns;
    followed_->changed_ns = context.now_ns;
    if (!write(context, mine, first, databuffer::WaitPolicy::some)) followed_.reset();  // the next pass begins again
  }

  // Writes the clock here, unless a program of this host has changed it since. False: it could not be written.
  bool write(Context& context, const ClockState& mine, bool always, databuffer::WaitPolicy policy) {
    bool writes = false;
    const auto changed = context.session.change_clock(
        [&](const ClockState& present) {
          writes = always || equal(present, followed_->written);
          return writes ? mine : present;
        },
        policy);
    if (changed && writes) followed_->written = mine;
    return changed.has_value();
  }

  // A program of this host has changed the clock (`yars sim`, a jump of the aircraft): the owner is asked to change it.
  bool forward_local_change(Context& context) {
    const ClockState clock = context.session.clock();
    if (equal(clock, followed_->written)) return false;
    if (!context.writes(dds::Topic::clock_requests))
      log::warning(
          "the session clock was changed here, and is set back: this host may not write the topic clock_requests");
    request(context, followed_->written, clock,
            clock.epoch != followed_->written.epoch ? EpochRequest::change_with_new_epoch : EpochRequest::change);
    followed_->written = clock;
    request_pending_until_ns_ = context.now_ns + kRequestTime_ns;
    return true;
  }

  void request(Context& context, const ClockState& before, const ClockState& wanted, EpochRequest epoch) {
    auto sample = context.made<yars_net_ClockRequestSample>();
    sample.owner = owner_;
    sample.new_epoch = static_cast<std::uint32_t>(epoch);
    // The change may have been made after this pass began.
    const std::int64_t at_ns = std::max(context.now_ns, wanted.base_monotonic_ns);
    copy_record(sample.before, databuffer::rebased(before, at_ns));
    copy_record(sample.clock, databuffer::rebased(wanted, at_ns));
    sample.before.base_monotonic_ns = sample.clock.base_monotonic_ns =
        std::max<std::int64_t>(at_ns + followed_->offset.offset_ns(), 0);
    context.write(sample);
  }

  // Moves the clock towards the measured offset (SlewedOffset). The base moves; a step of sim time is at most 0.1 ms.
  void slew(Context& context) {
    const auto measured_ns = context.hosts.offset_ns(owner_);
    const std::int64_t elapsed_ns = context.now_ns - std::exchange(followed_->changed_ns, context.now_ns);
    const std::int64_t before_ns = followed_->offset.offset_ns();
    constexpr std::int64_t kMaxPause_ns = 10'000'000;  // after a pause of this process sim time must not jump
    if (!measured_ns || !followed_->offset.approach(*measured_ns, std::min(elapsed_ns, kMaxPause_ns))) return;
    ClockState mine = followed_->written;
    // sim time = base + rate x (now - base time): a greater offset is a later time, thus an earlier base.
    mine.base_monotonic_ns -= followed_->offset.offset_ns() - before_ns;
    if (mine.base_monotonic_ns < 0) return;
    write(context, mine, false, databuffer::WaitPolicy::none);
    if (!equal(followed_->written, mine)) followed_->offset.set(before_ns);
  }

  bool owns_ = false;
  bool in_conflict_ = false;
  bool gave_way_ = false;
  std::optional<std::uint32_t> meeting_epoch_;  // in it this host gave way to another; it must end
  Pace meeting_pace_{kRequestTime_ns};
  std::int64_t epoch_begun_ns_ = 0;  // when the owner began the present epoch; 0: before this host followed it
  Vacancy vacancy_;
  std::uint64_t owner_ = 0;  // 0: none
  ClockState published_{};
  Pace pace_{250'000'000};
  HostMemory<yars_net_ClockSample> clocks_;
  std::optional<FollowedClock> followed_;
  std::int64_t request_pending_until_ns_ = 0;
};

}  // namespace yars::gateway
