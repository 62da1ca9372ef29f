// The world on several hosts: sea, wind, rain, jammers, movers and sequence points that any host's instructor changes.
// Inputs: on radar-model's host its containers world, world_configured and world_latched, and requests of other hosts;
//   on the others samples of that host, and the local container world_request.
// Outputs: on radar-model's host samples, requested changes in `world`, and an answer for each request; on the others
//   the same three containers, and requests.
// Errors: an invalid record is refused, counted and noted; so is a change that is not based on the newest edit.
// Source: docs/network.md#the-world.
#pragma once

#include "databuffer/session/session_changes.hpp"
#include "gateway/exchange/context.hpp"
#include "gateway/exchange/history_progress.hpp"

namespace yars::gateway {

class WorldExchange {
 public:
  explicit WorldExchange(WorldNumbers& numbers) : numbers_(&numbers) {}
  void send(Context& context) {
    if (const auto sample = news(context)) context.write(*sample);
    if (const auto sample = request(context)) context.write(*sample);
    send_latched(context);
  }

  // Latched worlds wait in DDS as the other histories do: all that a tick may name reach the ring.
  void receive(Context& context) {
    context.take<yars_net_WorldSample, yars_net_WorldRequestSample>(*this);
    if (knows_model(context) || is_last_tick(context)) context.take<yars_net_LatchedWorldSample>(*this);
    publish(context);
  }

  // Writes here what the host with the role has last said, and answers requests.
  void publish(Context& context) {
    const auto source = context.roles.source(Role::radar_model);
    if (const auto* state = states_.newest(context.hosts, source)) write_state(context, *state);
    if (const auto* latched = latched_.newest(context.hosts, source)) write_latched(context, *latched);
    const bool has_model = context.roles.exports(Role::radar_model);
    for (auto& [host, editor] : editors_)
      if (editor.waiting && (!has_model || context.hosts.find(host) == nullptr || answer(context, editor)))
        editor.waiting.reset();
  }

  void receive(Context& context, const yars_net_WorldSample& sample) {
    if (context.new_and_valid<WorldState>(sample, sample.newest) &&
        (sample.has_configured == 0 || context.valid<WorldState>(sample, sample.configured)))
      states_.keep(context.hosts, sample);
  }

  void receive(Context& context, const yars_net_LatchedWorldSample& sample) {
    if (!context.new_and_valid<WorldState>(sample, sample.world)) return;
    latched_.keep(context.hosts, sample);
    const auto* newest = latched_.newest(context.hosts, context.roles.source(Role::radar_model));
    if (newest != nullptr && newest->host == sample.host) write_latched(context, *newest);
  }

  void receive(Context& context, const yars_net_WorldRequestSample& sample) {
    if (!context.hosts.is_new(sample) || sample.owner != context.hosts.self().id ||
        context.hosts.find(sample.host) == nullptr)
      return;
    Editor* editor = editors_.of(context.hosts, sample.host);
    if (editor == nullptr) return;
    editor->waiting = sample;
    editor->arrived_ns = context.now_ns;
  }

  // What send() sends. nullopt: nothing new.
  std::optional<yars_net_WorldSample> news(Context& context) {
    if (!context.roles.exports(Role::radar_model)) {
      said_ = {};
      return std::nullopt;
    }
    const auto& layout = context.layout();
    const std::array versions{layout.world.version(), layout.world_latched.next(), layout.world_configured.version(),
                              answer_count_};
    if (versions == said_) return std::nullopt;
    const auto newest = databuffer::newest_world(layout);
    if (!newest) return std::nullopt;
    said_ = versions;
    auto sample = context.made<yars_net_WorldSample>();
    copy_record(sample.newest, *newest);
    if (const auto configured = databuffer::read_valid(layout.world_configured)) {
      sample.has_configured = 1;
      copy_record(sample.configured, *configured);
    }
    std::size_t count = 0;
    for (const auto& [host, editor] : editors_)
      if (editor.answer != WorldAnswer::none)
        sample.answers[count++] = {host, editor.segment, editor.request, static_cast<std::uint32_t>(editor.answer), 0};
    return sample;
  }

  std::optional<yars_net_WorldRequestSample> request(Context& context) {
    const auto owner = context.roles.source(Role::radar_model);
    auto& requests = context.session.layout().world_requests;
    const std::uint64_t asked = requests.asked.load(std::memory_order_acquire);
    const bool is_answered = asked == requests.answered.load(std::memory_order_acquire) >> 8;
    if (!owner || is_answered || (asked == requested_ && *owner == requested_of_)) return std::nullopt;
    requested_ = asked;
    requested_of_ = *owner;
    const auto world = databuffer::read_valid(context.layout().world_request);
    if (!world || context.now_ns - world->source_time_ns > databuffer::kMaxWorldRequestAge_ns) return std::nullopt;
    if (!context.writes(dds::Topic::world_requests)) {
      requests.answered.store(asked << 8 | static_cast<std::uint64_t>(WorldAnswer::forbidden));
      return std::nullopt;
    }
    auto sample = context.made<yars_net_WorldRequestSample>();
    sample.owner = *owner;
    sample.segment = context.segment();
    sample.request = asked;
    copy_record(sample.world, *world);
    return sample;
  }

 private:
  using WorldAnswer = databuffer::WorldAnswer;
  using WorldState = databuffer::WorldState;
  // [ns] A page that drags a shower makes some tens of changes a second. A flood would occupy radar-model.
  static constexpr std::int64_t kLeastInterval_ns = 50'000'000;
  static_assert(std::size(yars_net_WorldSample{}.answers) >= databuffer::kMaxHosts);

  // A host that requests changes.
  struct Editor {
    std::optional<yars_net_WorldRequestSample> waiting = std::nullopt;
    std::int64_t arrived_ns = 0;
    std::uint64_t segment = 0, request = 0;  // that was answered last
    databuffer::WorldAnswer answer = databuffer::WorldAnswer::none;
    std::int64_t applied_ns = 0;  // its last change that took effect
  };

  // The last record is in effect, so that a gateway begins with it.
  void send_latched(Context& context) {
    const auto& ring = context.layout().world_latched;
    if (!context.roles.exports(Role::radar_model)) return latched_cursor_.reset();
    if (!latched_cursor_) latched_cursor_ = std::max<std::uint64_t>(ring.next(), 1) - 1;
    WorldState world{};
    while (ring.read(*latched_cursor_, world).delivered) {
      auto sample = context.made<yars_net_LatchedWorldSample>();
      sample.segment = context.segment();
      sample.ring_number = *latched_cursor_ - 1;
      copy_record(sample.world, world);
      context.write(sample);
    }
  }

  // The answer comes last: who has waited for it finds the newest world.
  void write_state(Context& context, const yars_net_WorldSample& sample) {
    auto& layout = context.session.layout();
    const bool is_written = sample.start == written_start_ && sample.number == written_number_;
    // What stands in the slot counts: a local process may have written there since.
    if (!is_written || layout.world.version() != written_version_) {
      publish_changed(layout.world, std::bit_cast<WorldState>(sample.newest));
      if (sample.has_configured != 0)
        publish_changed(layout.world_configured, std::bit_cast<WorldState>(sample.configured));
      else if (layout.world_configured.has_value())
        layout.world_configured.clear();
    }
    written_start_ = sample.start;
    written_number_ = sample.number;
    written_version_ = layout.world.version();
    auto& requests = layout.world_requests;
    for (const auto& answer : sample.answers)
      if (!is_written && answer.host == context.hosts.self().id && answer.segment == context.segment() &&
          answer.request == requests.asked.load(std::memory_order_acquire))
        requests.answered.store(answer.request << 8 | (answer.answer & 0xFFU), std::memory_order_release);
  }

  void write_latched(Context& context, const yars_net_LatchedWorldSample& sample) {
    auto& ring = context.session.layout().world_latched;
    auto& progress = context.session.layout().world_requests.latched;
    const std::uint64_t next = ring.next();
    if (!numbers_->continues(sample.host, sample.segment, next)) resume_latched(context, sample);
    if (numbers_->has(sample.host, sample.segment, sample.ring_number, next)) return;
    store_progress(progress, source_id({sample.host, sample.segment}), progress_of(sample.ring_number + 1, next));
    numbers_->add(sample.host, sample.segment, sample.ring_number,
                  ring.publish(std::bit_cast<WorldState>(sample.world)));
  }

  // Where this gateway goes on: after what an earlier one has written here, or after an equal record, which the new
  // host of the radar model has had from the one before.
  void resume_latched(Context& context, const yars_net_LatchedWorldSample& sample) {
    const auto& layout = context.layout();
    const auto& progress = layout.world_requests.latched;
    const std::uint64_t next = layout.world_latched.next();
    if (next == 0) return;
    if (progress.source.load() == source_id({sample.host, sample.segment}) &&
        ends_with(progress.progress.load(), next)) {
      const std::uint64_t theirs = next_of(progress.progress.load(), next, sample.ring_number);
      if (theirs > 0) return numbers_->add(sample.host, sample.segment, theirs - 1, next - 1);
    }
    WorldState last{};
    std::uint64_t cursor = next - 1;
    if (layout.world_latched.read(cursor, last).delivered && equal(last, std::bit_cast<WorldState>(sample.world)))
      numbers_->add(sample.host, sample.segment, sample.ring_number, next - 1);
  }

  // False: the request waits, for the offset of that host's clock, for its turn, or for a local editor.
  bool answer(Context& context, Editor& editor) {
    const yars_net_WorldRequestSample& request = *editor.waiting;
    if (editor.segment == request.segment && editor.request == request.request) return true;
    const bool is_old = context.now_ns - editor.arrived_ns > databuffer::kMaxWorldRequestAge_ns;
    const bool is_early = editor.applied_ns != 0 && context.now_ns - editor.applied_ns < kLeastInterval_ns;
    if (is_early || !context.hosts.offset_ns(request.host)) return is_old;
    const auto instructor = context.session.claim(Role::instructor);
    if (!instructor) return is_old;
    editor.segment = request.segment;
    editor.request = request.request;
    editor.answer = apply(context, request, *instructor);
    if (editor.answer == WorldAnswer::applied) editor.applied_ns = context.now_ns;
    ++answer_count_;
    return true;
  }

  WorldAnswer apply(Context& context, const yars_net_WorldRequestSample& request,
                    const databuffer::Claim& instructor) const {
    const auto asked = context.valid<WorldState>(request, request.world);
    if (!asked) return WorldAnswer::refused;
    const std::int64_t age_ns =
        difference_ns(context.now_ns, difference_ns(asked->source_time_ns, *context.hosts.offset_ns(request.host)));
    if (age_ns > databuffer::kMaxWorldRequestAge_ns || age_ns < -databuffer::kMaxWorldRequestAge_ns)
      return WorldAnswer::late;
    const auto newest = databuffer::newest_world(context.layout());
    if (newest) {
      WorldState latched = *asked;
      latched.tick = newest->tick;
      // By an earlier gateway, without an answer. An equal edit of another host has another source_time_ns.
      if (equal(latched, *newest)) return WorldAnswer::applied;
      if (newest->edit + 1 != asked->edit) return WorldAnswer::outdated;
    }
    const auto changed = databuffer::replace_world(
        context.session, instructor, [&](const WorldState&) -> error::Expected<WorldState> { return *asked; });
    if (!changed) {
      context.hosts.refuse(request, changed.error().message());
      return WorldAnswer::refused;
    }
    log::info("host " + context.hosts.find(request.host)->name + " has changed the world");
    return WorldAnswer::applied;
  }

  WorldNumbers* numbers_;
  // On radar-model's host.
  std::optional<std::uint64_t> latched_cursor_;  // next record of the ring to send; nullopt: none was sent
  // Numbers by which a change is found without reading the records: of world, world_latched, world_configured, answers.
  std::array<std::uint64_t, 4> said_{};
  std::uint64_t answer_count_ = 0;
  HostMemory<Editor> editors_;
  // On the others.
  HostMemory<yars_net_WorldSample> states_;
  HostMemory<yars_net_LatchedWorldSample> latched_;
  // The last sample that write_state() had, and the version of `world` then.
  std::uint64_t written_start_ = 0, written_number_ = 0, written_version_ = 0;
  std::uint64_t requested_ = 0, requested_of_ = 0;  // number of the request that was sent last, and to which host
};

}  // namespace yars::gateway
