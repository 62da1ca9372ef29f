// `yars status`: a session's health for people, as JSON, or the segment's layout.
#include <array>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include "databuffer/frame_pool.hpp"
#include "databuffer/layout_json.hpp"
#include "databuffer/records/plain_text.hpp"
#include "databuffer/session.hpp"
#include "tools/command.hpp"
#include "tools/process_load.hpp"
#include "tools/status_health.hpp"
#include "tools/status_text.hpp"
#include "tools/watch_json.hpp"

namespace yars::tools {

namespace {

using nlohmann::ordered_json;

constexpr std::array<const char*, databuffer::kNoteKinds> kNoteNames{"restart", "refusal", "loss", "late tick",
                                                                     "supervision"};

struct StatusOptions {
  bool json = false;
  bool layout = false;
};

std::vector<databuffer::Note> notes_of(const databuffer::SessionLayout& layout) {
  std::vector<databuffer::Note> notes;
  const std::uint64_t total = layout.notes.total();
  databuffer::Note note{};
  for (std::uint64_t i = total > databuffer::kNotes ? total - databuffer::kNotes : 0; i < total; ++i)
    if (layout.notes.read(i, note)) notes.push_back(note);
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
    if (!session.ownship_lane_is_held(i) || !layout.ownship[i].read(own)) continue;
    lanes.push_back({{"lane", i},
                     {"source", databuffer::text_of(own.source)},
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
  databuffer::read_newest_frame(session.layout(), 0, newest, pixels);
  if (publisher == 0 && newest.id == 0) return nullptr;
  return {{"publisher", publisher == 0 ? ordered_json(nullptr) : ordered_json(publisher)},
          {"newest", newest.id},
          {"width", newest.width},
          {"height", newest.height}};
}

ordered_json status_object(const databuffer::Session& session, const std::string& name) {
  databuffer::ModelStatus model{};
  session.layout().model_status.read(model);
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
  object["ownship_lanes"] = lanes_json(session);
  ordered_json counts = ordered_json::object();
  for (std::size_t kind = 0; kind < databuffer::kNoteKinds; ++kind)
    counts[kNoteNames[kind]] = session.layout().note_counts[kind].load();
  object["note_counts"] = counts;
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
  object["roles"] = roles_json(session, lines);
  object["health"] = health_json(object);
  return object;
}

// Nobody to ask: the verdict is the same word as of a session that is there.
[[noreturn]] void print_nothing_runs(const failure::Error& error) {
  std::printf("NOTHING RUNS: %s\n", error.found.c_str());
  give_up(error);
}

void status(const CommonOptions& common, const StatusOptions& options) {
  if (options.layout) {
    std::printf("%s\n", databuffer::layout_json().c_str());
    return;
  }
  const auto session = databuffer::Session::open_read_only(common.session);
  if (!session && !options.json) print_nothing_runs(session.error());
  if (!session) give_up(session.error());
  const auto object = status_object(*session, common.session);
  if (options.json) {
    std::printf("%s\n", object.dump(2, ' ', false, ordered_json::error_handler_t::replace).c_str());
    return;
  }
  std::vector<int> pids;
  for (const auto& process : session->processes()) pids.push_back(process.pid);
  print_status(object, measure_loads(pids));
}

}  // namespace

void add_status_command(CLI::App& app, const CommonOptions& common) {
  auto* command = app.add_subcommand("status", "health of a session");
  auto options = std::make_shared<StatusOptions>();
  command->add_flag("--json", options->json, "as JSON");
  command->add_flag("--layout", options->layout, "offsets of every record in the segment, as JSON; needs no session");
  command->callback([&common, options] { status(common, *options); });
}

}  // namespace yars::tools
