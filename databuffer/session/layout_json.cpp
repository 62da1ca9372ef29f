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

std::string container_of(std::string_view kind, std::string_view record, Numbers numbers) {
  ObjectText object;
  object.add("kind", quoted(kind));
  object.add("record", quoted(record));
  for (const auto& [name, value] : numbers) object.add(name, value);
  return object.text();
}

// Text of a container of this type. Containers of no records have none.
template <class Part>
struct Described {
  static std::string text(std::string_view) { return {}; }
};

template <class T>
std::string latest_value(std::string_view record, std::size_t count) {
  using Value = shm::LatestValue<T>;
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

template <class T>
struct Described<shm::LatestValue<T>> {
  static std::string text(std::string_view record) { return latest_value<T>(record, 1); }
};

template <class T, std::size_t count>
struct Described<std::array<shm::LatestValue<T>, count>> {
  static std::string text(std::string_view record) { return latest_value<T>(record, count); }
};

template <class T, std::size_t depth>
struct Described<shm::BroadcastRing<T, depth>> {
  using Ring = shm::BroadcastRing<T, depth>;
  static std::string text(std::string_view record) {
    return container_of("BroadcastRing", record,
                        {{"next", Ring::next_offset()},
                         {"slots", Ring::slots_offset()},
                         {"slot_count", Ring::kDepth},
                         {"slot_stride", Ring::slot_stride()},
                         {"slot_sequence", 0},
                         {"slot_used_words", 8},
                         {"slot_words", 16}});
  }
};

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

template <>
struct Described<decltype(SessionLayout::patches)> {
  static std::string text(std::string_view) {
    return pool<PatchSlot>("PatchMap", kPatchSlots, offsetof(PatchSlot, map));
  }
};

template <>
struct Described<decltype(SessionLayout::frames)> {
  static std::string text(std::string_view) {
    return pool<FrameSlot>("GlassFrame", kFrameSlots, offsetof(FrameSlot, frame));
  }
};

template <>
struct Described<EventLanes> {
  static std::string text(std::string_view) {
    return container_of("InputLanes", "InputEvent",
                        {{"count", EventLanes::kLanes},
                         {"stride", EventLanes::lane_stride()},
                         {"depth", EventLanes::kDepth},
                         {"pushed", EventLanes::pushed_offset()},
                         {"dropped", EventLanes::dropped_offset()},
                         {"source", EventLanes::source_offset()},
                         {"popped", EventLanes::popped_offset()},
                         {"records", EventLanes::records_offset()}});
  }
};

template <>
struct Described<decltype(SessionLayout::processes)> {
  static std::string text(std::string_view) {
    return container_of("array", "ProcessEntry",
                        {{"count", kProcesses},
                         {"stride", sizeof(ProcessEntry)},
                         {"heartbeat_ns", offsetof(ProcessEntry, heartbeat_ns)},
                         {"pid", offsetof(ProcessEntry, pid)},
                         {"name", offsetof(ProcessEntry, name)}});
  }
};

template <>
struct Described<FlightRecorder> {
  static std::string text(std::string_view) {
    return container_of("NoteRing", "Note",
                        {{"total", FlightRecorder::total_offset()},
                         {"slots", FlightRecorder::slots_offset()},
                         {"slot_count", FlightRecorder::kDepth},
                         {"slot_stride", FlightRecorder::slot_stride()},
                         {"slot_sequence", 0},
                         {"slot_checksum", 8},
                         {"slot_words", 16}});
  }
};

std::string containers() {
  ObjectText parts;
  for_each_container([&]<class Part>(const Container& one, Part SessionLayout::*) {
    if (const std::string text = Described<Part>::text(one.record); !text.empty()) parts.add(one.name, text);
  });
  return parts.text();
}

std::string offsets() {
  ObjectText object;
  for_each_container([&](const Container& one, auto) { object.add(one.name, one.offset); });
  return object.text();
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
