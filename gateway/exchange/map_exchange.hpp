// Patch maps on every host: sent row by row at a limited rate, published when whole.
// Inputs: the pool of patch maps while the radar model runs here; maps and rows of the host where it runs.
// Outputs: a sample for each map and each row; whole maps in the local pool.
// Errors: an invalid map is refused, counted and noted. A map without a free slot is noted.
#pragma once

#include "databuffer/session/picture_pool.hpp"
#include "gateway/exchange/context.hpp"
#include "gateway/exchange/history_progress.hpp"
#include "gateway/patch_assembly.hpp"

namespace yars::gateway {

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
