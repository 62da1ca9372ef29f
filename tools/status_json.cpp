#include "tools/status_json.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "databuffer/frame_pool.hpp"
#include "databuffer/ownship_receiver.hpp"
#include "databuffer/records/model_validation.hpp"
#include "databuffer/records/plain_text.hpp"
#include "databuffer/records/validation.hpp"
#include "tools/status_health.hpp"
#include "tools/watch_json.hpp"

namespace yars::tools {

namespace {

using nlohmann::ordered_json;

constexpr std::array<const char*, databuffer::kNoteKinds> kNoteNames{"restart", "refusal", "loss", "late tick",
                                                                     "supervision"};

std::vector<databuffer::Note> notes_of(const databuffer::SessionLayout& layout) {
  std::vector<databuffer::Note> notes;
  const std::uint64_t total = layout.notes.total();
  databuffer::Note note{};
  for (std::uint64_t i = total > databuffer::kNotes ? total - databuffer::kNotes : 0; i < total; ++i)
    if (layout.notes.read(i, note)) {
      // Ages are told: a stamp that lies ahead, or before the machine was started, is none.
      note.monotonic_ns = std::clamp<std::int64_t>(note.monotonic_ns, 0, databuffer::monotonic_ns());
      notes.push_back(note);
    }
  return notes;
}

const char* note_name(std::uint32_t kind) {
  return kind < kNoteNames.size() ? kNoteNames[kind] : "?";
}

// What a source that has died left in its lane is nobody's.
ordered_json lanes_json(const databuffer::Session& session) {
  const databuffer::SessionLayout& layout = session.layout();
  ordered_json lanes = ordered_json::array();
  for (std::size_t i = 0; i < databuffer::kOwnshipLanes; ++i) {
    databuffer::Ownship own{};
    if (!session.ownship_lane_is_held(i) || !layout.ownship[i].read(own) || databuffer::why_refused(own)) continue;
    lanes.push_back({{"lane", i},
                     {"source", databuffer::name_of_source(own, static_cast<std::uint32_t>(i))},
                     {"priority", layout.ownship_priority[i].load()},
                     {"records", layout.ownship[i].version()}});
  }
  return lanes;
}

// Null without a recorder: what one that has gone left behind does not count.
ordered_json recorder_json(const databuffer::Session& session) {
  databuffer::RecorderStatus status{};
  if (!session.role_is_held(databuffer::Role::recorder) || !session.layout().recorder_status.read(status))
    return nullptr;
  const std::string problem(databuffer::text_of(status.problem));
  return {{"writing", status.writing != 0},
          {"bytes", status.bytes},
          {"problem", problem.empty() ? ordered_json(nullptr) : ordered_json(problem)}};
}

// Null when nobody publishes them and nobody has.
ordered_json frames_json(const databuffer::Session& session) {
  const std::int32_t publisher = session.role_holder(databuffer::Role::glass_frames);
  databuffer::GlassFrame newest{};
  std::vector<std::uint8_t> pixels;
  if (!databuffer::read_newest_frame(session.layout(), 0, newest, pixels) || databuffer::why_refused(newest))
    newest = {};
  if (publisher == 0 && newest.id == 0) return nullptr;
  return {{"publisher", publisher == 0 ? ordered_json(nullptr) : ordered_json(publisher)},
          {"newest", newest.id},
          {"width", newest.width},
          {"height", newest.height}};
}

// Null when nobody tells of ships and vehicles.
ordered_json traffic_json(const databuffer::Session& session) {
  const std::int32_t holder = session.role_holder(databuffer::Role::traffic);
  if (holder == 0) return nullptr;
  databuffer::Traffic newest{};
  if (!session.layout().traffic.read(newest) || databuffer::why_refused(newest)) newest = {};
  return {{"holder", holder}, {"entities", newest.count}};
}

// Who sends events just now, and how many of those who did are gone without a word.
ordered_json input_json(const databuffer::Session& session) {
  std::uint64_t held = 0;
  for (std::size_t lane = 0; lane < databuffer::kInputLanes; ++lane) held += session.input_lane_is_held(lane) ? 1 : 0;
  const std::uint64_t known = session.layout().counters.input_sources.load();
  return {{"sources", held}, {"missing", known > held ? known - held : 0}};
}

ordered_json refusals_json(const databuffer::Session& session, const std::vector<databuffer::Note>& notes) {
  constexpr std::int64_t kRecently_ns = 10'000'000'000;
  const auto newest = std::ranges::find(
      notes.rbegin(), notes.rend(), static_cast<std::uint32_t>(databuffer::NoteKind::refusal), &databuffer::Note::kind);
  const auto& refusals = session.layout().counters.refusals;
  return {{"last_10_s", refusals.within(kRecently_ns, databuffer::monotonic_ns())},
          {"newest", newest == notes.rend() ? ordered_json(nullptr) : ordered_json(databuffer::text_of(newest->text))}};
}

}  // namespace

ordered_json status_json(const databuffer::Session& session, const std::string& name) {
  databuffer::ModelStatus model{};
  if (!session.layout().model_status.read(model) || databuffer::why_refused(model)) model = {};
  ordered_json object;
  object["session"] = name;
  object["watch"] = watch_object(session);
  object["model"] = {{"fidelity", databuffer::text_of(model.fidelity)},
                     {"load", model.load},
                     {"scan", model.scan},
                     {"terrain_bytes", model.terrain_bytes},
                     {"posts_pending", model.posts_pending}};
  object["recorder"] = recorder_json(session);
  object["glass_frames"] = frames_json(session);
  object["traffic"] = traffic_json(session);
  object["ownship_lanes"] = lanes_json(session);
  ordered_json counts = ordered_json::object();
  for (std::size_t kind = 0; kind < databuffer::kNoteKinds; ++kind)
    counts[kNoteNames[kind]] = session.layout().note_counts[kind].load();
  object["note_counts"] = counts;
  object["notes_folded"] = session.layout().counters.notes_folded.load();
  const std::int64_t now_ns = databuffer::monotonic_ns();
  const std::vector<databuffer::Note> lines = notes_of(session.layout());
  ordered_json notes = ordered_json::array();
  for (const auto& note : lines)
    notes.push_back({{"sim_time", static_cast<double>(note.sim_time_ns) * 1e-9},
                     {"age_s", static_cast<double>(now_ns - note.monotonic_ns) * 1e-9},
                     {"process", databuffer::text_of(note.process)},
                     {"pid", note.pid},
                     {"kind", note_name(note.kind)},
                     {"text", databuffer::text_of(note.text)}});
  object["notes"] = notes;
  object["named"] = session.has_name();
  object["roles"] = roles_json(session);
  object["input"] = input_json(session);
  object["refusals"] = refusals_json(session, lines);
  object["frames_failing"] = session.layout().counters.frames_failing.load() != 0;
  const auto problem = session.clock_problem();
  object["clock_problem"] = problem ? ordered_json(*problem) : ordered_json(nullptr);
  object["health"] = health_json(object);
  return object;
}

}  // namespace yars::tools
