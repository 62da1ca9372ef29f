#include "station/app/instructor_shell.hpp"

#include <sys/types.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <utility>
#include <vector>

#include "databuffer/json/status_json.hpp"
#include "databuffer/messages/validation.hpp"
#include "databuffer/session/picture_pool.hpp"
#include "databuffer/session/receivers.hpp"
#include "lib/imageio/png.hpp"
#include "lib/log/log.hpp"
#include "lib/text/plain_text.hpp"
#include "station/instructor_map.hpp"
#include "world/world_json.hpp"

namespace yars::station {

namespace {

using databuffer::ClockState;
using databuffer::WorldState;
using error::Expected;
using nlohmann::ordered_json;

constexpr std::int64_t kSceneInterval_ns = 100'000'000;  // 10 states a second
constexpr std::int64_t kStatusInterval_ns = 1'000'000'000;
constexpr std::int64_t kPortionTime_ns = 1'000'000 * databuffer::kPortionTime_ms;
constexpr std::size_t kNotesShown = 12;
constexpr std::size_t kMostEdits = 64;  // changes of the world that wait for the one in progress

// Roles that the page may end with a signal. The supervisor of the set starts them again.
constexpr std::array<std::string_view, 6> kRoles{"flight-model", "input-monitor", "state-machine",
                                                 "radar-model",  "radar-display", "recorder"};

Expected<void> outcome_of(const Expected<WorldState>& world) {
  if (!world) return tl::unexpected(world.error());
  return {};
}

ordered_json clock_json(const databuffer::Session& session) {
  const ClockState clock = session.clock();
  return {{"sim_time", static_cast<double>(session.reached_sim_time_ns()) * 1e-9},
          {"running", clock.running != 0},
          {"rate", clock.rate},
          {"epoch", clock.epoch}};
}

// Patch maps of the pool, the newest first.
ordered_json patches_json(const databuffer::SessionLayout& layout) {
  std::vector<databuffer::PatchMap> maps;
  for (const databuffer::PatchSlot& slot : layout.patches) {
    databuffer::PatchMap map{};
    if (databuffer::read_patch(layout, slot.id.load(std::memory_order_acquire), map) && !databuffer::validate(map))
      maps.push_back(map);
  }
  std::ranges::sort(maps, std::ranges::greater{}, &databuffer::PatchMap::id);
  ordered_json list = ordered_json::array();
  for (const databuffer::PatchMap& map : maps) list.push_back(patch_json(map));
  return list;
}

}  // namespace

InstructorShell::InstructorShell(databuffer::Session& session, std::string name)
    : session_(&session), name_(std::move(name)) {}

void InstructorShell::refresh(bool shown) {
  const std::int64_t now_ns = databuffer::monotonic_ns();
  go_on_with_clock(now_ns);
  go_on_with_edits();
  if (!shown || now_ns < next_state_ns_) return;
  next_state_ns_ = now_ns + kSceneInterval_ns;
  if (now_ns >= next_status_ns_) {
    next_status_ns_ = now_ns + kStatusInterval_ns;
    refresh_status();
  }
  text_ = std::make_shared<const std::string>(state_message());
  ++number_;
}

void InstructorShell::refresh_status() {
  const databuffer::Status status = databuffer::status_of(*session_, name_);
  ordered_json all = databuffer::status_json(status);
  std::vector<int> pids;
  for (const databuffer::RoleStatus& role : status.roles) pids.push_back(role.pid);
  const auto loads = meter_.loads(pids);
  for (std::size_t i = 0; i < status.roles.size(); ++i) {
    const databuffer::RoleStatus& role = status.roles[i];
    const auto load = loads.find(role.pid);
    all["roles"][i]["load"] = load == loads.end() ? ordered_json(nullptr) : ordered_json(load->second);
    all["roles"][i]["can_kill"] = role.pid != 0 && std::ranges::find(kRoles, role.name) != kRoles.end();
  }
  // Late ticks would leave no room for others; the health names them.
  ordered_json newest = ordered_json::array();
  for (std::size_t i = status.notes.size(); i > 0 && newest.size() < kNotesShown; --i) {
    const databuffer::Note& note = status.notes[i - 1];
    if (note.kind == static_cast<std::uint32_t>(databuffer::NoteKind::late_tick)) continue;
    newest.push_back({{"sim_time", static_cast<double>(note.sim_time_ns) * 1e-9},
                      {"process", text::text_of(note.process)},
                      {"kind", databuffer::note_name(note.kind)},
                      {"text", text::text_of(note.text)}});
  }
  status_ = {{"roles", all["roles"]}, {"health", all["health"]}, {"recorder", all["recorder"]},
             {"model", all["model"]}, {"lag", all["lag"]},       {"notes", std::move(newest)}};
}

std::string InstructorShell::state_message() const {
  const auto& layout = std::as_const(*session_).layout();
  const auto radar = databuffer::read_valid(layout.radar_state);
  const auto model = databuffer::read_valid(layout.model_status).value_or(databuffer::ModelStatus{});
  const auto world = databuffer::newest_world(layout);
  ordered_json state{
      {"session", name_},
      {"clock", clock_json(*session_)},
      {"aircraft", aircraft_json(model)},
      {"scan", scan_json(model)},
      {"patches", patches_json(layout)},
      {"forming", forming_json(model)},
      {"navigators", radar ? navigators_json(*radar) : ordered_json(nullptr)},
      {"sequence_point", radar ? std::string(text::text_of(radar->sequence_point)) : std::string()},
      {"world", world ? world::world_json(*world, session_->reached_sim_time_ns()) : ordered_json(nullptr)},
      {"fidelity",
       {{"wanted", world ? std::string(text::text_of(world->fidelity)) : std::string()},
        {"used", std::string(text::text_of(model.fidelity))}}},
      {"status", status_}};
  return ordered_json{{"instructor", std::move(state)}}.dump(-1, ' ', true, ordered_json::error_handler_t::replace);
}

template <class Change>
Expected<void> InstructorShell::change_clock(const Change& change) {
  if (std::as_const(*session_).layout().lockstep.enabled.load() != 0)
    return error::fail("clock", "a live session", "a session in lockstep, whose sim time only its programs advance");
  steps_left_ = 0;
  return session_->change_clock(change);
}

template <class Change>
Expected<void> InstructorShell::begin_epoch(const Change& change) {
  auto changed = change_clock(change);
  if (changed && session_->clock().running == 0) {
    enters_epoch_ = true;
    clock_due_ns_ = databuffer::monotonic_ns() + kPortionTime_ns;
  }
  return changed;
}

// A step goes on in portions, and a new epoch begins with a second tick, so that no program skips one.
void InstructorShell::go_on_with_clock(std::int64_t now_ns) {
  if (now_ns < clock_due_ns_) return;
  if (std::exchange(enters_epoch_, false)) {
    if (session_->clock().running == 0) static_cast<void>(session_->change_clock(databuffer::after_first_tick));
    clock_due_ns_ = now_ns + kPortionTime_ns;
  } else if (steps_left_ > 0) {
    const ClockState clock = session_->clock();
    if (clock.epoch != steps_epoch_ || clock.running != 0) {
      steps_left_ = 0;
      return;
    }
    static_cast<void>(
        session_->change_clock([&](const ClockState& before) { return databuffer::stepped(before, steps_left_); }));
    steps_left_ -= std::min(steps_left_, databuffer::kStepPortion_ticks);
    clock_due_ns_ = now_ns + kPortionTime_ns;
  }
}

Expected<void> InstructorShell::kill_role(const std::string& role) {
  if (std::ranges::find(kRoles, role) == kRoles.end())
    return error::fail("kill", "a role of the set", role.substr(0, 40));
  for (const databuffer::ProcessInfo& process : session_->processes()) {
    if (process.name != role) continue;
    if (::kill(process.pid, SIGKILL) != 0) return error::fail("kill " + role, "leave to end it", std::strerror(errno));
    session_->note(databuffer::NoteKind::supervision, "the instructor killed " + role);
    log::info("the instructor killed " + role);
    return {};
  }
  return error::fail("kill " + role, "a process of this computer", "none");
}

// Of several changes the first one is in progress, so that each sees those before it.
void InstructorShell::begin_edit(databuffer::WorldChange change, WorldOutcome done) {
  if (edits_.size() >= kMostEdits)
    return done(error::fail("world", "fewer changes at once", std::to_string(edits_.size()) + " that wait",
                            "wait for the answer of radar-model's host"));
  edits_.push_back({databuffer::WorldChangeInProgress(*session_, std::move(change)), std::move(done)});
  go_on_with_edits();
}

void InstructorShell::go_on_with_edits() {
  while (!edits_.empty()) {
    const auto after = edits_.front().change.poll();
    if (!after) return;
    const WorldOutcome done = std::move(edits_.front().done);
    edits_.pop_front();
    done(*after);
  }
}

void InstructorShell::edit_world(const WorldEdit& edit, Answer answer) {
  const auto before = std::make_shared<WorldState>();
  begin_edit(
      [this, edit, before](const WorldState& world) {
        *before = world;
        return edit(world, session_->reached_sim_time_ns());
      },
      [this, before, answer = std::move(answer)](const Expected<WorldState>& after) {
        if (after) removed_.note(*before, *after);
        answer(outcome_of(after));
      });
}

void InstructorShell::reset_world(Answer answer) {
  const auto before = std::make_shared<WorldState>();
  begin_edit(
      [before, reset = databuffer::reset_of(*session_)](const WorldState& world) {
        *before = world;
        return reset(world);
      },
      [this, before, answer = std::move(answer)](const Expected<WorldState>& after) {
        if (after) reset_ = WorldReset{*before, after->edit};
        answer(outcome_of(after));
      });
}

void InstructorShell::undo_reset(Answer answer) {
  begin_edit(
      [this](const WorldState& world) -> Expected<WorldState> {
        if (!reset_) return error::fail("undo reset", "a reset of the world by a page", "none");
        if (world.edit == reset_->edit) return reset_->before;
        return error::fail("undo reset", "no change of the world since the reset", "one");
      },
      [this, answer = std::move(answer)](const Expected<WorldState>& after) {
        if (after) reset_.reset();  // without radar-model, say, it may be asked for again
        answer(outcome_of(after));
      });
}

void InstructorShell::execute(const InstructorCommand& command, Answer answer) {
  if (const auto* edit = std::get_if<EditWorld>(&command)) return edit_world(edit->edit, std::move(answer));
  if (const auto* restore = std::get_if<RestoreEntry>(&command))
    return edit_world(
        [this, restore = *restore](WorldState world, std::int64_t) -> Expected<WorldState> {
          if (auto done = removed_.restore(world, restore.list, restore.item); !done)
            return tl::unexpected(done.error());
          return world;
        },
        std::move(answer));
  if (std::holds_alternative<ResetWorld>(command)) return reset_world(std::move(answer));
  if (std::holds_alternative<UndoReset>(command)) return undo_reset(std::move(answer));
  answer(execute_at_once(command));
}

Expected<void> InstructorShell::execute_at_once(const InstructorCommand& command) {
  if (const auto* run = std::get_if<SetRunning>(&command))
    return change_clock([&](const ClockState& clock) { return databuffer::with_running(clock, run->running); });
  if (const auto* rate = std::get_if<SetRate>(&command))
    return change_clock([&](const ClockState& clock) { return databuffer::with_rate(clock, rate->rate); });
  if (const auto* step = std::get_if<Step>(&command)) {
    auto frozen = change_clock([](const ClockState& clock) { return databuffer::with_running(clock, false); });
    if (!frozen) return frozen;
    steps_left_ = step->ticks;
    steps_epoch_ = session_->clock().epoch;
    return {};
  }
  if (const auto* reset = std::get_if<Reset>(&command))
    return begin_epoch([&](const ClockState& clock) { return databuffer::reset_to(clock, reset->time_s); });
  if (const auto* move = std::get_if<Reposition>(&command)) {
    databuffer::Repositioning to{move->position, geo::AltitudeMsl::feet(move->altitude_ft),
                                 geo::Bearing::degrees(move->heading_deg)};
    if (move->speed_kt) to.ground_speed = geo::Speed::knots(*move->speed_kt);
    return begin_epoch([&](const ClockState& clock) { return databuffer::repositioned(clock, to); });
  }
  if (const auto* kill = std::get_if<KillRole>(&command)) return kill_role(kill->role);
  if (const auto* note = std::get_if<WriteNote>(&command)) {
    session_->note(databuffer::NoteKind::supervision, "instructor: " + note->text);
    return {};
  }
  return error::fail("command", "one of the session", "one of the station");
}

std::string InstructorShell::patch_png(std::uint64_t id) const {
  databuffer::PatchMap map{};
  std::vector<std::uint8_t> pixels;
  if (!databuffer::read_patch(std::as_const(*session_).layout(), id, map, pixels) || databuffer::validate(map))
    return {};
  std::vector<std::uint8_t> rgbx(4 * pixels.size()), png;
  for (std::size_t i = 0; i < pixels.size(); ++i)
    std::fill_n(rgbx.begin() + static_cast<std::ptrdiff_t>(4 * i), 3, pixels[i]);
  const auto edge = static_cast<int>(map.size);
  imageio::encode_png({rgbx.data(), edge, edge, 4U * map.size}, png);
  return {png.begin(), png.end()};
}

}  // namespace yars::station
