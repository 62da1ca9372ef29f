// Trust boundary of latest values: readers that copy a record of the segment, validate it, and keep the last valid one.
// Inputs: slots of the session's layout, or a function that copies a patch map.
// Outputs: the last valid record, and whether it is new.
// Errors: an invalid record is refused with a reason; the record before it stays in use.
// Threads: one reader per instance. The writer of a slot is never blocked.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "databuffer/messages/validation.hpp"
#include "databuffer/session/session.hpp"
#include "lib/log/log.hpp"
#include "shm/latest_value.hpp"

namespace yars::databuffer {

// The last valid record of one slot, as one reader sees it.
template <class T>
class Validated {
 public:
  // True when the slot holds a valid record that this reader has not examined. Each record is examined once.
  bool refresh(const shm::LatestValue<T>& slot) {
    refusal_.reset();
    if (slot.version() == version_) return false;
    T next{};
    const auto version = slot.read(next);
    if (!version) return false;
    version_ = *version;
    refusal_ = validate(next);
    if (refusal_) return false;
    value_ = next;
    has_value_ = true;
    return true;
  }
  // The same; a refusal becomes a note of the session: "<name>: <reason>".
  bool refresh(const shm::LatestValue<T>& slot, Session& session, const std::string& name) {
    const bool is_new = refresh(slot);
    if (refusal_) session.note(NoteKind::refusal, name + ": " + *refusal_);
    return is_new;
  }

  bool has_value() const { return has_value_; }
  const T& value() const { return value_; }  // zeros until has_value()
  // Why the last refresh() refused a record.
  const Refusal& refusal() const { return refusal_; }
  std::uint64_t version() const { return version_; }  // of the record last examined, valid or not

 private:
  T value_{};
  bool has_value_ = false;
  std::uint64_t version_ = 0;
  Refusal refusal_;
};

// The record that a slot holds now; none where it is empty or not valid.
template <class T>
std::optional<T> read_valid(const shm::LatestValue<T>& slot) {
  T value{};
  if (!slot.read(value) || validate(value)) return std::nullopt;
  return value;
}

// The record from which a restarted role resumes. One that is not valid is noted, logged and ignored.
template <class T>
std::optional<T> read_to_resume(const shm::LatestValue<T>& slot, Session& session, const std::string& name) {
  Validated<T> record;
  if (record.refresh(slot)) return record.value();
  if (!record.refusal()) return std::nullopt;
  session.note(NoteKind::refusal, name + " left behind: " + *record.refusal());
  log::warning(name + " left behind is refused, starting anew: " + *record.refusal());
  return std::nullopt;
}

// Records of the patch maps that one reader wants. Each is read once and kept while it is wanted.
class WantedMaps {
 public:
  // `name` begins the note about a map that is not valid.
  WantedMaps(Session& session, std::string name) : session_(&session), name_(std::move(name)) {}

  // Clears the records in `maps` that are not wanted, and reads the missing ones. `wanted` has ids; 0: none.
  // read(id, map) copies a map; false: the pool no longer has it. take(map) receives each new valid one.
  template <class Read, class Take>
  void refresh(std::span<PatchMap> maps, std::span<const std::uint64_t> wanted, const Read& read, const Take& take) {
    for (PatchMap& map : maps)
      if (std::ranges::find(wanted, map.id) == wanted.end()) map = {};
    for (const std::uint64_t id : wanted) {
      if (id == 0 || id == refused_id_ || std::ranges::find(maps, id, &PatchMap::id) != maps.end()) continue;
      PatchMap next{};
      if (!read(id, next)) continue;
      if (const auto reason = validate(next)) {
        refused_id_ = id;
        session_->note(NoteKind::refusal, name_ + ": " + *reason);
        continue;
      }
      *std::ranges::find(maps, std::uint64_t{0}, &PatchMap::id) = next;
      take(next);
    }
  }

 private:
  Session* session_;
  std::string name_;
  std::uint64_t refused_id_ = 0;  // the map refused last; it is noted once
};

}  // namespace yars::databuffer
