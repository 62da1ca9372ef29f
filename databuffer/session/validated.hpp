// Trust boundary of latest values: a record of the segment is copied, validated, and used only when it is valid.
// Inputs: slots of the session's layout. Outputs: the last valid record. Errors: an invalid record is refused with a
// reason; the record before it stays in use.
#pragma once

#include <cstdint>
#include <optional>
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

}  // namespace yars::databuffer
