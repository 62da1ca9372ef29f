// What the radar model makes, on every host: histories (latched traffic, ticks and sweeps, in the order in which a
// replay needs them) and patch maps, published when whole. WorldExchange has the latched worlds.
// Inputs: rings and pool of patch maps of the local segment while the radar model runs here; samples of the host where
// it runs.
// Outputs: a sample for each record, each map and each row of a map; rows are sent at a limited rate. The records in
// the local rings: traffic and world before the tick that names them, a tick before its sweep. Whole maps in the local
// pool.
// Errors: an invalid record or map, a wrong hash or sim time, and a tick that goes back are refused, counted and noted.
// Records of an earlier epoch are left out. A map without a free slot is noted.
#pragma once

#include "databuffer/messages/derived_values.hpp"
#include "databuffer/session/picture_pool.hpp"
#include "gateway/exchange/context.hpp"
#include "gateway/exchange/history_progress.hpp"
#include "gateway/sample_reception.hpp"
#include "runtime/tick_loop.hpp"

namespace yars::gateway {

class HistoryExchange {
 public:
  HistoryExchange(LaneNames& lanes, const WorldNumbers& worlds) : lanes_(&lanes), worlds_(&worlds) {}
  void send(Context& context) {
    traffic_history_.send(context, [](auto& sample, const auto& traffic) {
      sample.ring_number = sample.number;
      copy_record(sample.traffic, traffic);
    });
    tick_history_.send(context, [this](auto& sample, const auto& tick) {
      copy_record(sample.tick, tick);
      lanes_->ownship_name(tick.ownship_lane, sample.host).write_to(sample.ownship_host, sample.tick.ownship_lane);
    });
    sweep_history_.send(context, [](auto& sample, auto& sweep) {
      static_assert(sizeof sample.sweep == kSweepHeader_bytes);
      std::memcpy(&sample.sweep, &sweep, kSweepHeader_bytes);
      sample.video._length = sample.video._maximum = std::min<std::uint32_t>(sweep.samples, radar::kMaxSamples);
      sample.video._buffer = sweep.video;
    });
  }

  // Samples wait in DDS until knows_model() and may_begin(). At the end of a lockstep run they are taken also without a
  // holder: a last done tick waits for them.
  void receive(Context& context) {
    const auto newest = [&context] {
      const auto status = databuffer::read_valid(context.layout().model_status);
      return status ? std::optional(status->tick) : std::nullopt;
    };
    const auto holder = context.roles.holder(Role::radar_model);
    if (knows_model(context) ? may_begin(context, dds::Topic::model_ticks, *holder, newest) : is_last_tick(context))
      context.take<yars_net_LatchedTrafficSample, yars_net_ModelTickSample, yars_net_SweepSample>(*this);
    publish(context);
  }

  // Publishes what has arrived and is in order.
  void publish(Context& context) {
    auto& layout = context.session.layout();
    if (!context.roles.source(Role::radar_model)) {
      ticks_ = {};
      sweeps_ = {};
      last_tick_ = {};
      missing_world_ = 0;
      return;
    }
    const auto is_late = [&context](std::int64_t arrived_ns) { return context.now_ns - arrived_ns > kPatience_ns; };
    while (!ticks_.waiting.empty()) {
      auto& waiting = ticks_.waiting.front();
      databuffer::ModelTick& tick = waiting.record;
      const auto traffic = traffic_numbers_.local(waiting.host, tick.traffic);
      const auto world = worlds_->local(waiting.host, tick.world);
      const bool waits = !traffic || (!world && tick.world != missing_world_);
      if (waits && !is_late(waiting.arrived_ns)) break;
      if (!world) missing_world_ = tick.world;
      tick.traffic = traffic.value_or(layout.traffic_latched.next());
      tick.world = world.value_or(layout.world_latched.next());
      tick_history_.publish(context, waiting, tick);
      last_tick_ = {tick.epoch, tick.tick};
      last_host_ = waiting.host;
      ticks_.waiting.pop_front();
    }
    while (!sweeps_.waiting.empty()) {
      const auto& waiting = sweeps_.waiting.front();
      if (last_tick_.precedes(waiting.record) && !is_late(waiting.arrived_ns)) break;
      sweep_history_.publish(context, waiting, waiting.record);
      sweeps_.waiting.pop_front();
    }
  }

  // True: nothing waits for its predecessor.
  bool is_empty() const { return ticks_.waiting.empty() && sweeps_.waiting.empty(); }

  void receive(Context& context, const yars_net_LatchedTrafficSample& sample) {
    // Traffic is valid until the next record, so that also an old one is taken.
    const std::int64_t tick = context.session.sim_time_ns() / radar::kTickNanoseconds;
    if (!traffic_history_.is_wanted(context, sample, tick)) return;
    if (const auto traffic = context.valid<databuffer::Traffic>(sample, sample.traffic))
      traffic_numbers_.add(sample.host, sample.start, sample.ring_number,
                           traffic_history_.publish(context, sample, *traffic));
  }

  void receive(Context& context, const yars_net_ModelTickSample& sample) {
    if (!tick_history_.is_wanted(context, sample, sample.tick.tick) || is_past(context, sample.host, sample.tick))
      return;
    auto tick = context.valid<databuffer::ModelTick>(sample, sample.tick);
    if (!tick) return;
    tick->ownship_lane =
        lanes_->local_ownship_lane({sample.ownship_host, tick->ownship_lane}, context.hosts.self().id, kNoLane);
    keep(context, sample, *tick, ticks_);
  }

  void receive(Context& context, const yars_net_SweepSample& sample) {
    if (!sweep_history_.is_wanted(context, sample, sample.sweep.tick) || is_past(context, sample.host, sample.sweep))
      return;
    databuffer::Sweep sweep{};
    std::memcpy(&sweep, &sample.sweep, kSweepHeader_bytes);
    if (sweep.samples != sample.video._length)
      return context.hosts.refuse(sample, "samples: expected " + std::to_string(sample.video._length) +
                                              ", the length of the video, found " + std::to_string(sweep.samples));
    if (sweep.samples > 0 && sweep.samples <= radar::kMaxSamples)
      std::memcpy(sweep.video, sample.video._buffer, sweep.samples);
    if (const auto reason = validate(sweep)) return context.hosts.refuse(sample, *reason);
    if (databuffer::sweep_hash(sweep) != sweep.hash)
      return context.hosts.refuse(sample, "hash: expected that of the video, found another");
    keep(context, sample, sweep, sweeps_);
  }

 private:
  // [ns] A record waits so long for its predecessor, which is several repairs of a lost packet.
  static constexpr std::int64_t kPatience_ns = 200'000'000;
  static constexpr std::size_t kMaxWaiting = 1024;  // the depth of the rings
  static constexpr std::size_t kSweepHeader_bytes = offsetof(databuffer::Sweep, video);

  template <class Record>
  struct Waiting {
    Record record;
    std::int64_t arrived_ns;
    std::uint64_t host, start, number;  // of its sample
  };
  template <class Record>
  struct Queue {
    std::deque<Waiting<Record>> waiting;  // for their predecessors
    TickOrder order;
  };
  // The last tick that was published. Ticks count from 0 again in a new epoch.
  struct LastTick {
    std::uint32_t epoch = 0;
    std::int64_t tick = -1;
    bool precedes(const databuffer::Sweep& sweep) const {
      return tick < 0 || is_later(sweep.epoch, epoch) || (sweep.epoch == epoch && sweep.tick > tick);
    }
  };

  // True for a record that comes too late: of an epoch before a meeting, from the part that yielded; or older than the
  // few ticks by which a host that takes the role over may be behind its predecessor.
  template <class Record>
  bool is_past(Context& context, std::uint64_t host, const Record& record) const {
    if (is_later(context.session.clock().epoch, record.epoch)) return true;
    const bool goes_back = last_tick_.epoch == record.epoch && record.tick < last_tick_.tick - runtime::kMaxTicksBehind;
    return host != last_host_ && goes_back;
  }

  // Keeps a record until its predecessors have come. It is refused if its sim time is not that of its tick, or if its
  // tick goes back.
  template <class Sample, class Record>
  void keep(Context& context, const Sample& sample, const Record& record, Queue<Record>& queue) {
    const auto refuse = [&](const char* field, const std::string& expected, std::int64_t found) {
      context.hosts.refuse(sample, field + std::string(": expected ") + expected + ", found " + std::to_string(found));
    };
    const std::int64_t due_ns = record.tick * radar::kTickNanoseconds;
    if (record.sim_time_ns != due_ns)
      return refuse("sim_time_ns", std::to_string(due_ns) + ", that of the tick", record.sim_time_ns);
    if (!queue.order.follows(sample.host, record.epoch, record.tick))
      return refuse("tick", "one after that of the record before", record.tick);
    if (queue.waiting.size() < kMaxWaiting)
      queue.waiting.push_back({record, context.now_ns, sample.host, sample.start, sample.number});
  }

  LaneNames* lanes_;
  const WorldNumbers* worlds_;
  // ModelTick::world of the host with the role whose record did not come in time. Later ticks do not wait for it.
  std::uint64_t missing_world_ = 0;
  static constexpr std::uint64_t kRecent = 200;  // 1 s of ticks
  template <class Sample, class Record, auto kRing>
  using ModelHistory = History<Sample, Record, kRing, Role::radar_model>;
  using Layout = databuffer::SessionLayout;
  ModelHistory<yars_net_LatchedTrafficSample, databuffer::Traffic, &Layout::traffic_latched> traffic_history_{kRecent};
  ModelHistory<yars_net_ModelTickSample, databuffer::ModelTick, &Layout::model_ticks> tick_history_{kRecent};
  ModelHistory<yars_net_SweepSample, databuffer::Sweep, &Layout::sweeps> sweep_history_{kRecent};
  Queue<databuffer::ModelTick> ticks_;
  Queue<databuffer::Sweep> sweeps_;
  RecordNumbers<64> traffic_numbers_;  // the depth of the ring
  LastTick last_tick_;
  std::uint64_t last_host_ = 0;  // from which it came
};

class MapExchange {
 public:
  explicit MapExchange(int rows_per_s) : rows_(1'000'000'000 / rows_per_s, std::max(1, rows_per_s / 20)) {}
  void send(Context& context) {
    end_maps(context);
    if (!context.roles.exports(Role::radar_model)) return;
    begin_maps(context);
    for (Sent& sent : sent_) send_rows(context, sent);
  }

  void receive(Context& context) {
    if (context.roles.holder(Role::radar_model) || is_last_tick(context))
      context.take<yars_net_PatchMapSample, yars_net_PatchRowSample>(*this);
    publish(context);
  }

  void receive(Context& context, const yars_net_PatchMapSample& sample) {
    const auto map = context.new_and_valid<databuffer::PatchMap>(sample, sample.map);
    if (!map) return;
    if (map->id != sample.id || map->id == 0)
      return context.hosts.refuse(sample, "id: expected that of the sample, not 0");
    assembly_.begin(sample.host, *map);
  }

  void receive(Context& context, const yars_net_PatchRowSample& sample) {
    if (!context.hosts.is_new(sample)) return;
    if (sample.length > sizeof sample.pixels)
      return context.hosts.refuse(sample, "length: expected at most 1024, found more");
    assembly_.add_row(sample.host, sample.id, sample.row, {sample.pixels, sample.length});
  }

  void publish(Context& context) {
    const auto source = context.roles.source(Role::radar_model);
    if (!source) return;
    auto& layout = context.session.layout();
    while (const auto whole = assembly_.take_whole(*source)) {
      databuffer::PatchMap known{};
      if (databuffer::read_patch(layout, whole->map.id, known)) {
        if (known.hash == whole->map.hash) continue;
        // The part of the session that yielded made another map with this number.
        if (auto* slot = databuffer::slot_of<shm::PlainAccess>(layout.patches, whole->map.id)) slot->id.store(0);
      }
      std::array<std::uint64_t, 5> keep{};
      if (const auto state = databuffer::read_valid(layout.radar_state))
        keep = {state->map_newest, state->map_old, state->map_stored, state->map_shown, 0};
      if (const auto status = databuffer::read_valid(layout.model_status)) keep.back() = status->map_newest;
      if (!databuffer::publish_patch(layout, whole->map, whole->pixels, keep))
        context.session.note(databuffer::NoteKind::loss, "no free slot for patch map " + std::to_string(whole->map.id));
    }
  }

 private:
  struct Sent {
    std::uint64_t id = 0;
    std::uint32_t size = 0;
    std::uint32_t next_row = 0;
    std::vector<std::uint8_t> pixels = {};  // empty when all rows are sent
  };

  // Maps of the pool that are not sent yet, oldest first.
  void begin_maps(Context& context) {
    const auto& layout = context.layout();
    std::array<std::uint64_t, databuffer::kPatchSlots> ids{};
    for (std::size_t i = 0; i < ids.size(); ++i) ids[i] = layout.patches[i].id.load(std::memory_order_acquire);
    std::ranges::sort(ids);
    for (const std::uint64_t id : ids) {
      if (id == 0 || std::ranges::find(sent_, id, &Sent::id) != sent_.end()) continue;
      databuffer::PatchMap map{};
      std::vector<std::uint8_t> pixels;
      if (!databuffer::read_patch(layout, id, map, pixels) || validate(map)) continue;
      auto sample = context.made<yars_net_PatchMapSample>();
      sample.id = id;
      copy_record(sample.map, map);
      context.write(sample);
      sent_.push_back({id, map.size, 0, std::move(pixels)});
    }
  }

  // Removes the rows of maps that are no longer in the pool from the history that hosts get when they join.
  void end_maps(Context& context) {
    const auto& layout = context.layout();
    const bool sends = context.roles.exports(Role::radar_model);
    std::erase_if(sent_, [&](const Sent& sent) {
      if (sends && databuffer::slot_of<shm::PlainAccess>(layout.patches, sent.id) != nullptr) return false;
      yars_net_PatchRowSample row{};
      row.host = context.hosts.self().id;
      row.id = sent.id;
      for (row.row = 0; row.row < sent.next_row; ++row.row) context.link->dispose(row);
      yars_net_PatchMapSample map{};
      map.host = row.host;
      map.id = sent.id;
      context.link->dispose(map);
      return true;
    });
  }

  void send_rows(Context& context, Sent& sent) {
    while (!sent.pixels.empty() && (context.lockstep || rows_.take(context.now_ns))) {
      auto sample = context.made<yars_net_PatchRowSample>();
      sample.id = sent.id;
      sample.row = sent.next_row;
      sample.length = sent.size;
      std::memcpy(sample.pixels, sent.pixels.data() + std::size_t{sent.next_row} * sent.size, sent.size);
      context.write(sample);
      if (++sent.next_row == sent.size) sent.pixels = {};
    }
  }

  Allowance rows_;  // after a pause of this process those of 0.05 s are sent at once
  std::vector<Sent> sent_;
  PatchAssembly assembly_;
};

}  // namespace yars::gateway
