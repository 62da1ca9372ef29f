#include "databuffer/session/layout_json.hpp"

#include <array>
#include <cinttypes>
#include <cstddef>
#include <cstdio>
#include <initializer_list>
#include <string_view>
#include <utility>

#include "databuffer/messages/record_fields.hpp"
#include "databuffer/session/session.hpp"
#include "databuffer/session/session_layout.hpp"

namespace yars::databuffer {

namespace {

using Numbers = std::initializer_list<std::pair<std::string_view, std::size_t>>;

// Builds the text of one JSON object, entry by entry.
class ObjectText {
 public:
  void add(std::string_view name, const std::string& value) {
    text_ += (text_.size() > 1 ? ", \"" : "\"") + std::string(name) + "\": " + value;
  }
  void add(std::string_view name, std::size_t value) { add(name, std::to_string(value)); }
  std::string text() const { return text_ + "}"; }

 private:
  std::string text_ = "{";
};

std::string quoted(std::string_view text) {
  return std::string("\"").append(text) + "\"";
}

std::string object_of(Numbers numbers) {
  ObjectText object;
  for (const auto& [name, value] : numbers) object.add(name, value);
  return object.text();
}

std::string container_of(std::string_view kind, std::string_view record, Numbers numbers) {
  ObjectText object;
  object.add("kind", quoted(kind));
  object.add("record", quoted(record));
  for (const auto& [name, value] : numbers) object.add(name, value);
  return object.text();
}

template <class Value>
std::string latest_value(std::string_view record, std::size_t count = 1) {
  return container_of("LatestValue", record,
                      {{"count", count},
                       {"stride", sizeof(Value)},
                       {"state", Value::state_offset()},
                       {"slots", Value::slots_offset()},
                       {"slot_count", Value::kSlots},
                       {"slot_stride", Value::slot_stride()},
                       {"slot_sequence", 0},
                       {"slot_version", 8},
                       {"slot_words", 16}});
}

template <class Ring>
std::string ring(std::string_view record) {
  return container_of("BroadcastRing", record,
                      {{"next", Ring::next_offset()},
                       {"slots", Ring::slots_offset()},
                       {"slot_count", Ring::kDepth},
                       {"slot_stride", Ring::slot_stride()},
                       {"slot_sequence", 0},
                       {"slot_used_words", 8},
                       {"slot_words", 16}});
}

// Container of slots that are found by the id in their first word (picture_pool.hpp).
template <class Slot>
std::string pool(std::string_view record, std::size_t count, std::size_t words) {
  return container_of("pool", record,
                      {{"slot_count", count},
                       {"slot_stride", sizeof(Slot)},
                       {"slot_id", offsetof(Slot, id)},
                       {"slot_words", words},
                       {"slot_pixels", offsetof(Slot, pixels)}});
}

std::string containers() {
  using Input = decltype(SessionLayout::input);
  using Notes = decltype(SessionLayout::notes);
  ObjectText parts;
  parts.add("clock", latest_value<shm::LatestValue<ClockState>>("ClockState"));
  parts.add("ownship", latest_value<shm::LatestValue<Ownship>>("Ownship", kOwnshipLanes));
  parts.add("nav", latest_value<shm::LatestValue<Nav>>("Nav", kOwnshipLanes));
  parts.add("radar_state", latest_value<shm::LatestValue<RadarState>>("RadarState"));
  parts.add("model_status", latest_value<shm::LatestValue<ModelStatus>>("ModelStatus"));
  parts.add("outputs", latest_value<shm::LatestValue<Outputs>>("Outputs"));
  parts.add("recorder_status", latest_value<shm::LatestValue<RecorderStatus>>("RecorderStatus"));
  parts.add("caption", latest_value<shm::LatestValue<Caption>>("Caption"));
  parts.add("advice", latest_value<shm::LatestValue<PilotAdvice>>("PilotAdvice"));
  parts.add("network_status", latest_value<shm::LatestValue<NetworkStatus>>("NetworkStatus"));
  parts.add("model_ticks", ring<decltype(SessionLayout::model_ticks)>("ModelTick"));
  parts.add("applied_events", ring<decltype(SessionLayout::applied_events)>("AppliedEvent"));
  parts.add("sweeps", ring<decltype(SessionLayout::sweeps)>("Sweep"));
  parts.add("input", container_of("InputLanes", "InputEvent",
                                  {{"count", Input::kLanes},
                                   {"stride", Input::lane_stride()},
                                   {"depth", Input::kDepth},
                                   {"pushed", Input::pushed_offset()},
                                   {"dropped", Input::dropped_offset()},
                                   {"source", Input::source_offset()},
                                   {"popped", Input::popped_offset()},
                                   {"records", Input::records_offset()}}));
  parts.add("processes", container_of("array", "ProcessEntry",
                                      {{"count", kProcesses},
                                       {"stride", sizeof(ProcessEntry)},
                                       {"heartbeat_ns", offsetof(ProcessEntry, heartbeat_ns)},
                                       {"pid", offsetof(ProcessEntry, pid)},
                                       {"name", offsetof(ProcessEntry, name)}}));
  parts.add("notes", container_of("NoteRing", "Note",
                                  {{"total", Notes::total_offset()},
                                   {"slots", Notes::slots_offset()},
                                   {"slot_count", Notes::kDepth},
                                   {"slot_stride", Notes::slot_stride()},
                                   {"slot_sequence", 0},
                                   {"slot_checksum", 8},
                                   {"slot_words", 16}}));
  parts.add("traffic", latest_value<shm::LatestValue<Traffic>>("Traffic"));
  parts.add("traffic_latched", ring<decltype(SessionLayout::traffic_latched)>("Traffic"));
  parts.add("world", latest_value<shm::LatestValue<WorldState>>("WorldState"));
  parts.add("world_configured", latest_value<shm::LatestValue<WorldState>>("WorldState"));
  parts.add("world_latched", ring<decltype(SessionLayout::world_latched)>("WorldState"));
  parts.add("world_request", latest_value<shm::LatestValue<WorldState>>("WorldState"));
  parts.add("patches", pool<PatchSlot>("PatchMap", kPatchSlots, offsetof(PatchSlot, map)));
  parts.add("frames", pool<FrameSlot>("GlassFrame", kFrameSlots, offsetof(FrameSlot, frame)));
  return parts.text();
}

std::string offsets() {
  return object_of({{"lockstep", offsetof(SessionLayout, lockstep)},
                    {"clock", offsetof(SessionLayout, clock)},
                    {"ownship_priority", offsetof(SessionLayout, ownship_priority)},
                    {"ownship", offsetof(SessionLayout, ownship)},
                    {"nav", offsetof(SessionLayout, nav)},
                    {"radar_state", offsetof(SessionLayout, radar_state)},
                    {"model_status", offsetof(SessionLayout, model_status)},
                    {"outputs", offsetof(SessionLayout, outputs)},
                    {"recorder_status", offsetof(SessionLayout, recorder_status)},
                    {"model_ticks", offsetof(SessionLayout, model_ticks)},
                    {"applied_events", offsetof(SessionLayout, applied_events)},
                    {"sweeps", offsetof(SessionLayout, sweeps)},
                    {"input", offsetof(SessionLayout, input)},
                    {"processes", offsetof(SessionLayout, processes)},
                    {"note_counts", offsetof(SessionLayout, note_counts)},
                    {"notes", offsetof(SessionLayout, notes)},
                    {"patches", offsetof(SessionLayout, patches)},
                    {"traffic", offsetof(SessionLayout, traffic)},
                    {"traffic_latched", offsetof(SessionLayout, traffic_latched)},
                    {"frames", offsetof(SessionLayout, frames)},
                    {"counters", offsetof(SessionLayout, counters)},
                    {"caption", offsetof(SessionLayout, caption)},
                    {"advice", offsetof(SessionLayout, advice)},
                    {"skipped_ticks", offsetof(SessionLayout, skipped_ticks)},
                    {"network_status", offsetof(SessionLayout, network_status)},
                    {"network", offsetof(SessionLayout, network)},
                    {"world", offsetof(SessionLayout, world)},
                    {"world_configured", offsetof(SessionLayout, world_configured)},
                    {"world_latched", offsetof(SessionLayout, world_latched)},
                    {"world_request", offsetof(SessionLayout, world_request)},
                    {"world_requests", offsetof(SessionLayout, world_requests)}});
}

std::string lock_bytes() {
  ObjectText object;
  object.add("participation", std::size_t{0});
  for (const Role role : {Role::radar_model, Role::state_machine, Role::recorder, Role::clock, Role::traffic,
                          Role::glass_frames, Role::tour, Role::gateway, Role::instructor})
    object.add(name_of(role), static_cast<std::size_t>(role));
  object.add("first_ownship_lane", kFirstOwnshipByte);
  object.add("first_input_lane", kFirstInputByte);
  object.add("first_process", kFirstProcessByte);
  return object.text();
}

std::string records() {
  ObjectText all;
  for (const RecordFields& record : record_fields()) {
    ObjectText fields;
    for (const RecordField& field : record.fields)
      fields.add(field.name,
                 std::string("[").append(std::to_string(field.offset)) + ", " + std::to_string(field.size) + "]");
    ObjectText object;
    object.add("size", record.size);
    object.add("fields", fields.text());
    all.add(record.record, object.text());
  }
  return all.text();
}

}  // namespace

std::string layout_json() {
  std::array<char, 20> hash;
  std::snprintf(hash.data(), hash.size(), "%016" PRIx64, kLayoutIdentity.hash);
  ObjectText object;
  object.add("version", std::size_t{kLayoutIdentity.version});
  object.add("size", kLayoutIdentity.size);
  object.add("hash", quoted(hash.data()));
  object.add("lock_bytes", lock_bytes());
  object.add("offsets", offsets());
  object.add("containers", containers());
  object.add("records", records());
  return object.text();
}

}  // namespace yars::databuffer
