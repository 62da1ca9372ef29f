// Readers that copy a record from the segment, validate it, and keep the last valid one (trust boundary).
// Inputs: LatestValue containers of the session's layout ("slots" below), or a function that copies a patch map.
// Outputs: the last valid record; true if the record is new.
// Errors: an invalid record is refused with a reason. The last valid record stays in use.
// Threads: one reader per instance. The writer of a slot is never blocked.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "databuffer/messages/validation.hpp"
#include "databuffer/session/session.hpp"
#include "lib/log/log.hpp"
#include "shm/latest_value.hpp"

namespace yars::databuffer {

// The last valid record of one slot, as one reader sees it.
template <class T>
class Validated {
 public:
  // Copies and validates the slot's record if this reader has not examined it before. True if the record is new and
  // valid.
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
  // As above, and writes a refusal to the flight recorder as "NAME: REASON".
  bool refresh(const shm::LatestValue<T>& slot, Session& session, const std::string& name) {
    const bool is_new = refresh(slot);
    if (refusal_) session.note(NoteKind::refusal, name + ": " + *refusal_);
    return is_new;
  }

  bool has_value() const { return has_value_; }
  const T& value() const { return value_; }  // all zero while has_value() is false
  // Reason why the last refresh() refused a record; nullopt: no refusal.
  const Refusal& refusal() const { return refusal_; }
  std::uint64_t version() const { return version_; }  // version of the last examined record, valid or not

 private:
  T value_{};
  bool has_value_ = false;
  std::uint64_t version_ = 0;
  Refusal refusal_;
};

// Current record of a slot; nullopt if the slot is empty, if the record is invalid, or if the writer changed the slot
// during every attempt to read it.
template <class T>
std::optional<T> read_valid(const shm::LatestValue<T>& slot) {
  T value{};
  if (!slot.read(value) || validate(value)) return std::nullopt;
  return value;
}

// Record from which a restarted role resumes. An invalid record is reported (flight recorder, log) and ignored.
template <class T>
std::optional<T> read_to_resume(const shm::LatestValue<T>& slot, Session& session, const std::string& name) {
  Validated<T> record;
  if (record.refresh(slot)) return record.value();
  if (!record.refusal()) return std::nullopt;
  session.note(NoteKind::refusal, name + " of the earlier process: " + *record.refusal());
  log::warning(name + " of the earlier process is refused, the program starts without it: " + *record.refusal());
  return std::nullopt;
}

// Reader of the patch maps that one program needs. The caller stores the records. A map that was read is not read again
// while its id stays in `wanted`.
class WantedMaps {
 public:
  // `name`: beginning of the flight recorder's line about an invalid map.
  WantedMaps(Session& session, std::string name) : session_(&session), name_(std::move(name)) {}

  // Clears the records in `maps` with ids that are not in `wanted`, and reads the missing maps. Id 0 in `wanted` is
  // skipped. `maps` has at least as many entries as `wanted`; an entry with id 0 is free. read(id, map) copies a map;
  // false: the pool no longer has it. take(map) receives each new valid map.
  template <class Read, class Take>
  void refresh(std::span<PatchMap> maps, std::span<const std::uint64_t> wanted, const Read& read, const Take& take) {
    for (PatchMap& map : maps)
      if (std::ranges::find(wanted, map.id) == wanted.end()) map = {};
    std::erase_if(refused_ids_, [&](std::uint64_t id) { return std::ranges::find(wanted, id) == wanted.end(); });
    for (const std::uint64_t id : wanted) {
      if (id == 0 || std::ranges::find(refused_ids_, id) != refused_ids_.end() ||
          std::ranges::find(maps, id, &PatchMap::id) != maps.end())
        continue;
      PatchMap next{};
      if (!read(id, next)) continue;
      if (const auto reason = validate(next)) {
        refused_ids_.push_back(id);
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
  std::vector<std::uint64_t> refused_ids_;  // ids in `wanted` of invalid maps, which are not read again
};

}  // namespace yars::databuffer
