#include "gateway/exchange/world_exchange.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <string>
#include <utility>

#include "databuffer/messages/validation.hpp"
#include "databuffer/session/session_world.hpp"
#include "databuffer/session/validated.hpp"
#include "gateway/exchange/history_progress.hpp"
#include "gateway/exchange/progress.hpp"
#include "lib/log/log.hpp"

namespace yars::gateway {

using databuffer::Role;
using databuffer::WorldAnswer;
using databuffer::WorldState;

namespace {

// [ns] A page that drags a shower makes some tens of changes a second. A flood would occupy radar-model.
constexpr std::int64_t kLeastInterval_ns = 50'000'000;
constexpr std::size_t kMaxAnswers = std::size(yars_net_WorldSample{}.answers);
static_assert(kMaxAnswers >= databuffer::kMaxHosts);

bool is_same(const WorldState& first, const WorldState& second) {
  return std::memcmp(&first, &second, sizeof first) == 0;
}

// True if both are one edit: what is asked for, and what has become of it. An equal edit of another host has another
// source_time_ns.
bool is_same_edit(WorldState asked, const WorldState& found) {
  asked.tick = found.tick;
  return is_same(asked, found);
}

// Keeps the newest sample of each host, of kMaxHosts at most.
template <class Sample>
void keep(const Context& context, std::map<std::uint64_t, Sample>& samples, const Sample& sample) {
  if (samples.size() >= databuffer::kMaxHosts)
    std::erase_if(samples, [&](const auto& known) { return context.hosts.find(known.first) == nullptr; });
  if (samples.size() < databuffer::kMaxHosts || samples.contains(sample.host)) samples[sample.host] = sample;
}

// The newest sample of radar-model's host, if that is another one; nullptr: none of the gateway that runs there now.
template <class Sample>
const Sample* of_model(const Context& context, const std::map<std::uint64_t, Sample>& samples) {
  const auto host = context.roles.source(Role::radar_model);
  if (!host) return nullptr;
  const auto found = samples.find(*host);
  return found == samples.end() || found->second.start != context.hosts.start_of(*host) ? nullptr : &found->second;
}

// Publishes a record that is not there yet.
void replace(shm::LatestValue<WorldState>& slot, const WorldState& record) {
  WorldState present{};
  if (!slot.read(present) || !is_same(present, record)) slot.publish(record);
}

}  // namespace

// ---- From radar-model's host to the others
void WorldExchange::send(Context& context) {
  if (const auto sample = news(context)) context.write(*sample);
  if (const auto sample = request(context)) context.write(*sample);
  send_latched(context);
}

std::optional<yars_net_WorldSample> WorldExchange::news(Context& context) {
  if (!context.roles.exports(Role::radar_model)) {
    said_ = {};
    return std::nullopt;
  }
  const auto& layout = std::as_const(context.session).layout();
  const Versions versions{layout.world.version(), layout.world_latched.next(), layout.world_configured.version(),
                          answer_count_};
  if (versions == said_) return std::nullopt;
  const auto newest = databuffer::newest_world(layout);
  if (!newest) return std::nullopt;
  said_ = versions;
  yars_net_WorldSample sample{};
  context.hosts.stamp(sample);
  copy_record(sample.newest, *newest);
  if (const auto configured = databuffer::read_valid(layout.world_configured)) {
    sample.has_configured = 1;
    copy_record(sample.configured, *configured);
  }
  std::size_t count = 0;
  for (const auto& [host, answer] : answers_)
    if (count < kMaxAnswers)
      sample.answers[count++] = {host, answer.segment, answer.request, static_cast<std::uint32_t>(answer.answer), 0};
  return sample;
}

// The last record is in effect, so that a gateway begins with it.
void WorldExchange::send_latched(Context& context) {
  const auto& ring = std::as_const(context.session).layout().world_latched;
  if (!context.roles.exports(Role::radar_model)) return latched_cursor_.reset();
  if (!latched_cursor_) latched_cursor_ = std::max<std::uint64_t>(ring.next(), 1) - 1;
  WorldState world{};
  while (ring.read(*latched_cursor_, world).delivered) {
    yars_net_LatchedWorldSample sample{};
    context.hosts.stamp(sample);
    sample.segment = context.hosts.identity().segment;
    sample.ring_number = *latched_cursor_ - 1;
    copy_record(sample.world, world);
    context.write(sample);
  }
}

// Latched worlds wait in DDS as the other histories do: all that a tick may name reach the ring.
void WorldExchange::receive(Context& context) {
  const auto take = [&](const auto& sample) { receive(context, sample); };
  context.link->take<yars_net_WorldSample>(take);
  context.link->take<yars_net_WorldRequestSample>(take);
  if (knows_model(context) || is_last_tick(context)) context.link->take<yars_net_LatchedWorldSample>(take);
}

void WorldExchange::receive(Context& context, const yars_net_WorldSample& sample) {
  if (!context.hosts.is_new(sample)) return;
  WorldState newest{}, configured{};
  copy_record(newest, sample.newest);
  copy_record(configured, sample.configured);
  auto reason = validate(newest);
  if (!reason && sample.has_configured != 0) reason = validate(configured);
  if (reason) return context.hosts.refuse(sample.host, dds::Topic::world, *reason);
  keep(context, states_, sample);
}

void WorldExchange::receive(Context& context, const yars_net_LatchedWorldSample& sample) {
  if (!context.hosts.is_new(sample)) return;
  WorldState world{};
  copy_record(world, sample.world);
  if (const auto reason = validate(world)) return context.hosts.refuse(sample.host, dds::Topic::world_latched, *reason);
  keep(context, latched_, sample);
  if (const auto* newest = of_model(context, latched_); newest != nullptr && newest->host == sample.host)
    write_latched(context, *newest);
}

void WorldExchange::publish(Context& context) {
  if (const auto* state = of_model(context, states_)) write_state(context, *state);
  if (const auto* latched = of_model(context, latched_)) write_latched(context, *latched);
  const bool has_model = context.roles.exports(Role::radar_model);
  std::erase_if(requests_, [&](const auto& waiting) {
    return !has_model || context.hosts.find(waiting.first) == nullptr || answer(context, waiting.second);
  });
}

// The answer comes last: who has waited for it finds the newest world.
void WorldExchange::write_state(Context& context, const yars_net_WorldSample& sample) {
  auto& layout = context.session.layout();
  const bool is_written =
      sample.host == written_host_ && sample.start == written_start_ && sample.number == written_number_;
  // What stands in the slot counts: a local process may have written there since.
  if (!is_written || layout.world.version() != written_version_) {
    WorldState record{};
    copy_record(record, sample.newest);
    replace(layout.world, record);
    copy_record(record, sample.configured);
    if (sample.has_configured != 0)
      replace(layout.world_configured, record);
    else if (layout.world_configured.has_value())
      layout.world_configured.clear();
  }
  written_host_ = sample.host;
  written_start_ = sample.start;
  written_number_ = sample.number;
  written_version_ = layout.world.version();
  if (!is_written) write_answer(context, sample);
}

void WorldExchange::write_answer(Context& context, const yars_net_WorldSample& sample) const {
  auto& requests = context.session.layout().world_requests;
  for (const auto& answer : sample.answers)
    if (answer.host == context.hosts.self().id && answer.segment == context.hosts.identity().segment &&
        answer.request == requests.asked.load(std::memory_order_acquire))
      requests.answered.store(answer.request << 8 | (answer.answer & 0xFFU), std::memory_order_release);
}

void WorldExchange::write_latched(Context& context, const yars_net_LatchedWorldSample& sample) {
  auto& ring = context.session.layout().world_latched;
  auto& progress = context.session.layout().world_requests.latched;
  const std::uint64_t next = ring.next();
  if (!numbers_->continues(sample.host, sample.segment, next)) resume_latched(context, sample);
  if (numbers_->has(sample.host, sample.segment, sample.ring_number, next)) return;
  WorldState world{};
  copy_record(world, sample.world);
  progress.source.store(0);
  progress.progress.store(progress_of(sample.ring_number + 1, next));
  progress.source.store(source_id({sample.host, sample.segment}));
  numbers_->add(sample.host, sample.segment, sample.ring_number, ring.publish(world));
}

// Where this gateway goes on: after what an earlier one has written here, or after an equal record, which the new host
// of the radar model has had from the one before.
void WorldExchange::resume_latched(Context& context, const yars_net_LatchedWorldSample& sample) {
  const auto& layout = std::as_const(context.session).layout();
  const auto& progress = layout.world_requests.latched;
  const std::uint64_t next = layout.world_latched.next();
  if (next == 0) return;
  if (progress.source.load() == source_id({sample.host, sample.segment}) && ends_with(progress.progress.load(), next)) {
    const std::uint64_t theirs = next_of(progress.progress.load(), next, sample.ring_number);
    if (theirs > 0) return numbers_->add(sample.host, sample.segment, theirs - 1, next - 1);
  }
  WorldState world{}, last{};
  copy_record(world, sample.world);
  std::uint64_t cursor = next - 1;
  if (layout.world_latched.read(cursor, last).delivered && is_same(last, world))
    numbers_->add(sample.host, sample.segment, sample.ring_number, next - 1);
}

// ---- Requests of the others
std::optional<yars_net_WorldRequestSample> WorldExchange::request(Context& context) {
  const auto owner = context.roles.source(Role::radar_model);
  auto& requests = context.session.layout().world_requests;
  const std::uint64_t asked = requests.asked.load(std::memory_order_acquire);
  const bool is_answered = asked == requests.answered.load(std::memory_order_acquire) >> 8;
  if (!owner || is_answered || (asked == requested_ && *owner == requested_of_)) return std::nullopt;
  requested_ = asked;
  requested_of_ = *owner;
  const auto world = databuffer::read_valid(std::as_const(context.session).layout().world_request);
  if (!world || context.now_ns - world->source_time_ns > databuffer::kMaxWorldRequestAge_ns) return std::nullopt;
  if (!context.writes(dds::Topic::world_requests)) {
    requests.answered.store(asked << 8 | static_cast<std::uint64_t>(WorldAnswer::forbidden));
    return std::nullopt;
  }
  yars_net_WorldRequestSample sample{};
  context.hosts.stamp(sample);
  sample.owner = *owner;
  sample.segment = context.hosts.identity().segment;
  sample.request = asked;
  copy_record(sample.world, *world);
  return sample;
}

void WorldExchange::receive(Context& context, const yars_net_WorldRequestSample& sample) {
  if (!context.hosts.is_new(sample) || sample.owner != context.hosts.self().id ||
      context.hosts.find(sample.host) == nullptr)
    return;
  requests_[sample.host] = {sample, context.now_ns};
}

// False: the request waits, for the offset of that host's clock, for its turn, or for a local editor.
bool WorldExchange::answer(Context& context, const Request& request) {
  const yars_net_WorldRequestSample& sample = request.sample;
  if (answers_.size() >= kMaxAnswers)
    std::erase_if(answers_, [&](const auto& known) { return context.hosts.find(known.first) == nullptr; });
  Answer& answer = answers_[sample.host];
  if (answer.segment == sample.segment && answer.request == sample.request) return true;
  const bool is_old = context.now_ns - request.arrived_ns > databuffer::kMaxWorldRequestAge_ns;
  const auto offset_ns = context.hosts.offset_ns(sample.host);
  if (!offset_ns || (answer.applied_ns != 0 && context.now_ns - answer.applied_ns < kLeastInterval_ns)) return is_old;
  const auto instructor = context.session.claim(Role::instructor);
  if (!instructor) return is_old;
  answer.segment = sample.segment;
  answer.request = sample.request;
  answer.answer = apply(context, request, *instructor);
  if (answer.answer == WorldAnswer::applied) answer.applied_ns = context.now_ns;
  ++answer_count_;
  return true;
}

WorldAnswer WorldExchange::apply(Context& context, const Request& request, const databuffer::Claim& instructor) const {
  const std::uint64_t host = request.sample.host;
  WorldState asked{};
  copy_record(asked, request.sample.world);
  const auto refuse = [&](const std::string& reason) {
    context.hosts.refuse(host, dds::Topic::world_requests, reason);
    return WorldAnswer::refused;
  };
  if (const auto reason = validate(asked)) return refuse(*reason);
  // In numbers without a sign, because times from another host may have any value.
  const auto age_ns = static_cast<std::int64_t>(static_cast<std::uint64_t>(context.now_ns) -
                                                static_cast<std::uint64_t>(asked.source_time_ns) +
                                                static_cast<std::uint64_t>(*context.hosts.offset_ns(host)));
  if (age_ns > databuffer::kMaxWorldRequestAge_ns || age_ns < -databuffer::kMaxWorldRequestAge_ns)
    return WorldAnswer::late;
  const auto newest = databuffer::newest_world(std::as_const(context.session).layout());
  if (newest && is_same_edit(asked, *newest)) return WorldAnswer::applied;  // by an earlier gateway, without an answer
  if (newest && newest->edit + 1 != asked.edit) return WorldAnswer::outdated;
  const auto changed = databuffer::replace_world(
      context.session, instructor, [&](const WorldState&) -> error::Expected<WorldState> { return asked; });
  if (!changed) return refuse(changed.error().message());
  log::info("host " + context.hosts.find(host)->name + " has changed the world");
  return WorldAnswer::applied;
}

}  // namespace yars::gateway
