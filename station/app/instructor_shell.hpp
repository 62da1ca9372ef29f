// The instructor of one session: what the page shows of it, and what the page changes.
// Inputs: records of the segment; commands of the page.
// Outputs: a text of JSON for the page; changes of the clock, signals to roles, notes.
// Errors: a command that cannot be done is an Error for the page; the session stays as it was.
// Threads: one.
// Source: docs/station.md#messages, #commands.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "databuffer/session/session.hpp"
#include "databuffer/session/session_changes.hpp"
#include "runtime/processor_load.hpp"
#include "station/instructor_message.hpp"

namespace yars::station {

using Text = std::shared_ptr<const std::string>;

class InstructorShell {
 public:
  InstructorShell(databuffer::Session& session, std::string name);

  // Goes on with steps, new epochs and changes of the world that need time. If a page shows the state, makes a new text
  // when one is due.
  void refresh(bool shown);
  // The newest state as a message; its number counts up with each new text.
  const Text& state() const { return text_; }
  std::uint64_t state_number() const { return number_; }

  // Called once with the outcome of a command.
  using Answer = std::function<void(const error::Expected<void>& outcome)>;
  // The commands that change the session. Others are an Error. A change of the world is answered later if it needs
  // time, as with radar-model on another host.
  void execute(const InstructorCommand& command, Answer answer);
  // A patch map of the session as a PNG; empty: the session does not have it any more.
  std::string patch_png(std::uint64_t id) const;

 private:
  template <class Change>
  error::Expected<void> change_clock(const Change& change);
  template <class Change>
  error::Expected<void> begin_epoch(const Change& change);
  error::Expected<void> execute_at_once(const InstructorCommand& command);
  void edit_world(const WorldEdit& edit, Answer answer);
  void reset_world(Answer answer);
  void undo_reset(Answer answer);
  using WorldOutcome = std::function<void(const error::Expected<databuffer::WorldState>& after)>;
  void begin_edit(databuffer::WorldChange change, WorldOutcome done);
  void go_on_with_edits();
  error::Expected<void> kill_role(const std::string& role);
  void go_on_with_clock(std::int64_t now_ns);
  void refresh_status();
  std::string state_message() const;

  databuffer::Session* session_;
  std::string name_;
  runtime::LoadMeter meter_;
  nlohmann::ordered_json status_;  // roles with their loads, health, recorder, newest notes
  Text text_;
  std::uint64_t number_ = 0;
  std::int64_t next_state_ns_ = 0, next_status_ns_ = 0;  // CLOCK_MONOTONIC
  std::int64_t steps_left_ = 0;                          // ticks of the step in progress
  std::uint32_t steps_epoch_ = 0;
  bool enters_epoch_ = false;  // the frozen clock is to advance by one tick
  std::int64_t clock_due_ns_ = 0;
  RemovedEntries removed_;
  struct WorldReset {
    databuffer::WorldState before;
    std::uint64_t edit;  // of the world after it
  };
  std::optional<WorldReset> reset_;  // the last one, until it is undone
  struct PendingEdit {
    databuffer::WorldChangeInProgress change;
    WorldOutcome done;
  };
  std::deque<PendingEdit> edits_;  // changes of the world, made one after the other
};

}  // namespace yars::station
