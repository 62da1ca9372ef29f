// `yars record`: records a session until Ctrl-C or the end of a lockstep run.

#include <ctime>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>

#include "databuffer/session/session.hpp"
#include "lib/file/text_file.hpp"
#include "lib/log/log.hpp"
#include "lib/text/plain_text.hpp"
#include "radar/recording/branch.hpp"
#include "radar/recording/recording_io.hpp"
#include "runtime/process.hpp"
#include "runtime/program.hpp"
#include "runtime/tick_loop.hpp"
#include "tools/command/command.hpp"
#include "tools/session/recorder.hpp"

namespace yars::tools {

namespace {

using databuffer::Session;
using runtime::Option;

constexpr std::int64_t kRecordInterval_ns = 50'000'000;  // [ns] 50 ms; the ring of ticks holds 5 s of sim time
// After this number of polls (2 s) without a written block, the incomplete block is written. With a frozen clock a
// block does not become full.
constexpr int kQuietPolls = 40;

struct RecordOptions {
  std::string file;
  std::string terrain;
  std::string lockstep;
  std::string log_dir;
  bool overwrite = false;
  bool json = false;
  std::optional<double> keep_mb;  // nullopt: no limit
  std::string source;             // --source of flight-model
  std::string from;               // recording of which this one is a branch; empty: none
  std::optional<double> until_s;  // the branch begins with its items up to this time
  RecordedExtras extras;
};

std::int64_t tick_of(const Session& session) {
  return session.sim_time_ns() / radar::kTickNanoseconds;
}

// Appends the remaining records. Passes a tick kPaceTicks ahead, so that the rate limit (Pace) takes the last values.
void drain_remaining(Session& session, Recorder& recorder) {
  recorder.drain(tick_of(session) + recording::kPaceTicks);
}

// True if another program than the recorder takes part.
bool has_programs(const Session& session) {
  return session.processes().size() > 1;
}

// Polls a live session. After a write error the process continues, so that the display can report the problem
// (docs/pilots_manual.md#rule-22).
void record_live(Session& session, const std::string& name, Recorder& recorder,
                 const recording::RecordingWriter& writer) {
  int quiet_polls = 0;
  bool warned = false;
  while (!runtime::stop_requested()) {
    const std::uint64_t bytes_before = writer.bytes();
    recorder.drain(tick_of(session));
    quiet_polls = writer.bytes() == bytes_before ? quiet_polls + 1 : 0;
    if (quiet_polls >= kQuietPolls) {
      recorder.flush();
      quiet_polls = 0;
      if (!has_programs(session) && !std::exchange(warned, true))
        log::warning("no program runs in session " + name + " yet; --session chooses another");
    }
    session.heartbeat();
    const timespec pause{0, kRecordInterval_ns};
    nanosleep(&pause, nullptr);
  }
  drain_remaining(session, recorder);
}

// In lockstep the other roles wait for the recorder at the end of each tick. So the recorder loses no record.
void record_in_lockstep(Session& session, Recorder& recorder, const std::string& lockstep) {
  auto loop = runtime::TickLoop::create(session, databuffer::LockstepRole::recorder, lockstep);
  if (!loop) throw_failure(loop.error());
  while (const auto due = loop->wait()) {
    recorder.drain(due->tick);
    loop->done(*due);
  }
  if (auto ended = loop->outcome(); !ended) throw_failure(ended.error());
  drain_remaining(session, recorder);
}

// Absolute path, because a replay may run in another folder.
std::string absolute(const std::string& path) {
  return path.empty() ? path : std::filesystem::absolute(path).string();
}

void print_summary(const Recorder& recorder, std::uint64_t bytes, const RecordOptions& options) {
  if (options.json)
    return print_json({{"file", options.file},
                       {"ticks", recorder.ticks()},
                       {"sweeps", recorder.sweeps()},
                       {"bytes", bytes},
                       {"refused", recorder.refused()}});
  // For people, and no result: the recording is whole, also if nobody can read this.
  log::info(text::counted(recorder.ticks(), "tick") + ", " + text::counted(recorder.sweeps(), "sweep") + ", " +
            text::counted(bytes, "byte") + " in " + options.file);
}

// Text of a source with the path of its file made absolute.
std::string absolute_source(const std::string& source) {
  for (const std::string prefix : {"route:", "csv:"})
    if (source.starts_with(prefix)) return prefix + absolute(file::installed_file(source.substr(prefix.size())));
  return source;
}

// The recording of which a new one is a branch.
struct Trunk {
  recording::RecordingReader reader;
  recording::BranchPoint point;
};

Trunk open_trunk(const RecordOptions& options, const Session& session) {
  if (!options.until_s)
    throw_failure(error::usage_error("--from", "--until S with it", "none", "give the time of the branch"));
  std::error_code code;
  if (std::filesystem::equivalent(options.from, options.file, code))
    throw_failure(error::usage_error("--from", "another recording than FILE", options.from, "name a new FILE"));
  auto reader = recording::RecordingReader::open(options.from);
  if (!reader) throw_failure(reader.error());
  const auto tick = recording::tick_at(*reader, *options.until_s, options.from, "--until");
  if (!tick) throw_failure(tick.error());
  auto point = recording::find_branch_point(*reader, *tick, options.from);
  if (!point) throw_failure(point.error());
  if (Recorder::holds_branch(session) && !Recorder::is_branch(session, *point))
    throw_failure({"--from", "a session that goes on from that recording, at that time", "another session",
                   "start both by --fly-out of the start script"});
  return {std::move(*reader), std::move(*point)};
}

// Begins the recording with the items of its trunk. Returns false, with a line in the log, if the session has run on
// too far: a recorder that was started again begins in the middle of the session.
bool begin_branch(const Session& session, Trunk& trunk, recording::RecordingWriter& writer) {
  if (!Recorder::holds_branch(session)) {
    log::warning("the session has run on since the branch began; the recording begins here, without what was before");
    return false;
  }
  if (auto copied = recording::copy_until(trunk.reader, trunk.point, writer); !copied) throw_failure(copied.error());
  return true;
}

void record(const CommonOptions& common, const RecordOptions& options) {
  runtime::set_private_umask();
  if (!options.log_dir.empty()) log::start_file("recorder", options.log_dir);
  auto session = Session::open(common.session, "recorder");
  if (!session) throw_failure(session.error());
  auto role = session->claim(databuffer::Role::recorder);
  if (!role) throw_failure(error::usage_error(role.error()));
  std::optional<Trunk> trunk;
  if (!options.from.empty()) trunk = open_trunk(options, *session);
  auto writer = recording::RecordingWriter::create(
      options.file, {absolute(common.config), absolute(options.terrain)},
      options.overwrite ? recording::Existing::overwritten : recording::Existing::refused);
  if (!writer) throw_failure(writer.error());
  const auto recorder_index = static_cast<std::size_t>(databuffer::LockstepRole::recorder);
  // A recorder that joins a lockstep run before its own first tick also records what the rings already contain.
  const bool from_oldest = !options.lockstep.empty() && session->layout().lockstep.done_tick[recorder_index].load() < 0;
  RecordedExtras extras = options.extras;
  extras.keep_bytes = static_cast<std::uint64_t>(options.keep_mb.value_or(0.0) * 1e6);
  extras.flight_source = absolute_source(options.source);
  const bool is_branch = trunk && begin_branch(*session, *trunk, *writer);
  Recorder recorder(*session, *writer, extras, from_oldest || is_branch);
  if (is_branch) recorder.continue_branch(trunk->point);
  log::info("records session " + common.session + " to " + options.file);
  if (options.lockstep.empty())
    record_live(*session, common.session, recorder, *writer);
  else
    record_in_lockstep(*session, recorder, options.lockstep);
  error::Expected<void> outcome = recorder.outcome();
  const bool is_there = writer->is_at_path();
  if (outcome) outcome = writer->close();
  if (is_there) print_summary(recorder, writer->bytes(), options);
  if (recorder.refused() > 0)
    log::warning("not recorded: " + text::counted(recorder.refused(), "record") + " that failed validation");
  if (!outcome) throw_failure(outcome.error());
}

}  // namespace

void add_record_command(runtime::Command app, const CommonOptions& common) {
  runtime::Command command = app.subcommand("record", "record the session's ticks and events until Ctrl-C");
  auto options = std::make_shared<RecordOptions>();
  command.option("FILE", options->file, "recording to write").value_name("FILE").required();
  command.flag("--overwrite", options->overwrite, "replace an existing FILE (else an existing FILE is refused)");
  command
      .option("--keep", options->keep_mb,
              "[MB] disk space for the newest records, in FILE and its predecessor FILE.before")
      .range(20.0, 1e9)
      .otherwise("no limit");
  command.flag("--sweeps", options->extras.sweeps, "also record the video of the sweeps (up to 0.8 MB per second)");
  command.flag("--patches", options->extras.patches, "also record the patch maps (up to 1 MB each)");
  add_terrain_option(command, options->terrain).otherwise("the configuration's; as for radar-model");
  command
      .option("--source", options->source,
              "the value of flight-model's --source; a set that flies out of the recording continues this flight")
      .value_name("SOURCE")
      .otherwise("not recorded");
  Option from =
      command.option("--from", options->from, "begin with the items of this recording up to --until S: a branch of it");
  from.value_name("FILE").otherwise("a recording of its own");
  Option until = command.option("--until", options->until_s, "[s] sim time at which the branch leaves --from FILE");
  until.range(0.0, databuffer::kLatestSimTime_s).needs(from).otherwise("none");
  command
      .option("--lockstep", options->lockstep,
              "roles that step together on sim time, ROLE,ROLE,...[@END_TICK]; the same for all of them")
      .value_name("ROLES")
      .otherwise("live");
  command.option("--log-dir", options->log_dir, "folder for a rotated log file")
      .value_name("DIR")
      .otherwise("no file")
      .in_user_file();
  add_json_flag(command, options->json);
  command.callback([&common, options] { record(common, *options); });
}

}  // namespace yars::tools
