// `yars status`: a session's health for people, as JSON, or the segment's layout.
#include <array>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include "databuffer/layout_json.hpp"
#include "databuffer/records/plain_text.hpp"
#include "databuffer/session.hpp"
#include "tools/command.hpp"
#include "tools/watch_json.hpp"

namespace yars::tools {

namespace {

using nlohmann::ordered_json;

constexpr std::array<const char*, databuffer::kNoteKinds> kNoteNames{"restart", "refusal", "loss", "late tick",
                                                                     "supervision"};
constexpr std::size_t kNotesShown = 20;  // newest lines of the flight recorder; all of them with --json

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

ordered_json lanes_json(const databuffer::SessionLayout& layout) {
  ordered_json lanes = ordered_json::array();
  for (std::size_t i = 0; i < databuffer::kOwnshipLanes; ++i) {
    databuffer::Ownship own{};
    if (!layout.ownship[i].read(own)) continue;
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

void print_recorder(const ordered_json& recorder) {
  if (recorder.is_null()) return;
  std::printf("recorder: %s, %.1f MB", recorder["writing"].get<bool>() ? "writing" : "stopped",
              static_cast<double>(recorder["bytes"].get<std::uint64_t>()) / 1e6);
  if (!recorder["problem"].is_null()) std::printf(", %s", recorder["problem"].get<std::string>().c_str());
  std::printf("\n");
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
  object["ownship_lanes"] = lanes_json(session.layout());
  ordered_json counts = ordered_json::object();
  for (std::size_t kind = 0; kind < databuffer::kNoteKinds; ++kind)
    counts[kNoteNames[kind]] = session.layout().note_counts[kind].load();
  object["note_counts"] = counts;
  ordered_json notes = ordered_json::array();
  for (const auto& note : notes_of(session.layout()))
    notes.push_back({{"sim_time", static_cast<double>(note.sim_time_ns) * 1e-9},
                     {"process", databuffer::text_of(note.process)},
                     {"pid", note.pid},
                     {"kind", note_name(note.kind)},
                     {"text", databuffer::text_of(note.text)}});
  object["notes"] = notes;
  return object;
}

void print_for_people(const ordered_json& object) {
  const auto& watch = object["watch"];
  const auto& model = object["model"];
  std::printf("session %s: sim time %.1f s, %s, rate %g, epoch %u\n", object["session"].get<std::string>().c_str(),
              watch["sim_time"].get<double>(), watch["running"].get<bool>() ? "running" : "frozen",
              watch["rate"].get<double>(), watch["epoch"].get<unsigned>());
  for (const auto& [name, process] : watch["processes"].items())
    std::printf("  %-18s pid %-8d heartbeat %.0f ms ago\n", name.c_str(), process["pid"].get<int>(),
                process["heartbeat_ms"].get<double>());
  for (const auto& lane : object["ownship_lanes"])
    std::printf("  ownship lane %d: %s, priority %u, %llu records\n", lane["lane"].get<int>(),
                lane["source"].get<std::string>().c_str(), lane["priority"].get<unsigned>(),
                static_cast<unsigned long long>(lane["records"].get<std::uint64_t>()));
  std::printf("radar: %s %s, %.1f NM, fidelity %s, %.1f %% of a core, %llu sweeps, terrain %.1f MB\n",
              watch["power"].get<std::string>().c_str(), watch["mode"].get<std::string>().c_str(),
              watch["range_nm"].get<double>(), model["fidelity"].get<std::string>().c_str(),
              100.0 * model["load"].get<double>(),
              static_cast<unsigned long long>(watch["sweeps"].get<std::uint64_t>()),
              static_cast<double>(model["terrain_bytes"].get<std::uint64_t>()) / 1e6);
  print_recorder(object["recorder"]);
  std::printf("flight recorder:");
  for (const auto& [kind, count] : object["note_counts"].items())
    std::printf(" %s %llu;", kind.c_str(), static_cast<unsigned long long>(count.get<std::uint64_t>()));
  std::printf("\n");
  const auto& notes = object["notes"];
  for (std::size_t i = notes.size() > kNotesShown ? notes.size() - kNotesShown : 0; i < notes.size(); ++i)
    std::printf("  %9.2f s %-14s %-11s %s\n", notes[i]["sim_time"].get<double>(),
                notes[i]["process"].get<std::string>().c_str(), notes[i]["kind"].get<std::string>().c_str(),
                notes[i]["text"].get<std::string>().c_str());
}

void status(const CommonOptions& common, const StatusOptions& options) {
  if (options.layout) {
    std::printf("%s\n", databuffer::layout_json().c_str());
    return;
  }
  const auto session = databuffer::Session::open_read_only(common.session);
  if (!session) give_up(session.error());
  const auto object = status_object(*session, common.session);
  if (options.json)
    std::printf("%s\n", object.dump(2, ' ', false, ordered_json::error_handler_t::replace).c_str());
  else
    print_for_people(object);
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
