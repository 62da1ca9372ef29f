// `yars record`: the recorder. Reads rings and the latest radar state, writes the tick log.
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <optional>

#include "databuffer/log.hpp"
#include "databuffer/program.hpp"
#include "databuffer/session.hpp"
#include "databuffer/tick_loop.hpp"
#include "tools/command.hpp"
#include "tools/recording/tick_log.hpp"

namespace yars::tools {

namespace {

using databuffer::Session;

constexpr std::int64_t kPause_ns = 50'000'000;  // [ns] between looks; the rings hold 5 s of sim time

struct RecordOptions {
  std::string file;
  std::string terrain;
  std::string lockstep;
};

class Recorder {
 public:
  Recorder(Session& session, recording::TickLogWriter& writer, bool from_the_begin)
      : session_(&session), writer_(&writer), state_(session.layout().radar_state) {
    // From the first tick of a lockstep run: what was done before the recorder came is still in the rings.
    if (from_the_begin) return;
    const auto& layout = session.layout();
    tick_cursor_ = layout.model_ticks.next();
    event_cursor_ = layout.applied_events.next();
    sweep_cursor_ = layout.sweeps.next();
    // The status may be of a later tick than the cursor: ticks up to it are not written.
    recording::StartingPoint start{};
    if (layout.model_status.read(start.status)) {
      writer.write(start);
      from_tick_ = start.status.tick + 1;
      from_epoch_ = start.status.epoch;
    }
  }

  void drain() {
    recording::Gap gap{};
    databuffer::ModelTick tick{};
    const auto& layout = session_->layout();
    while (take(layout.model_ticks, tick_cursor_, tick, gap.ticks))
      if (!from_tick_ || tick.tick >= *from_tick_ || tick.epoch != from_epoch_ ||
          (tick.flags & databuffer::kTickRestart) != 0U) {
        from_tick_.reset();
        writer_->write(tick);
        ++ticks_;
      }
    databuffer::AppliedEvent event{};
    while (take(layout.applied_events, event_cursor_, event, gap.events)) writer_->write(event);
    // The latest state, not a ring: live, a state that lasted less than a look is passed over.
    if (state_.refresh()) writer_->write(recording::StateChange{state_.value()});
    while (take(layout.sweeps, sweep_cursor_, sweep_, gap.sweeps)) {
      writer_->write(recording::SweepMark{sweep_.tick, sweep_.hash, sweep_.epoch, sweep_.number, sweep_.flags, 0});
      ++sweeps_;
    }
    if (gap.ticks + gap.events + gap.sweeps == 0) return;
    writer_->write(gap);
    session_->note(databuffer::NoteKind::loss, "recorder fell behind by " + std::to_string(gap.ticks) + " ticks");
  }

  std::uint64_t ticks() const { return ticks_; }
  std::uint64_t sweeps() const { return sweeps_; }

 private:
  template <class Ring, class Record>
  static bool take(const Ring& ring, std::uint64_t& cursor, Record& record, std::uint64_t& lost) {
    const auto outcome = ring.read(cursor, record);
    lost += outcome.lost;
    return outcome.delivered;
  }

  Session* session_;
  recording::TickLogWriter* writer_;
  std::uint64_t tick_cursor_ = 0, event_cursor_ = 0, sweep_cursor_ = 0;
  std::optional<std::int64_t> from_tick_;
  std::uint32_t from_epoch_ = 0;
  shm::LatestReader<databuffer::RadarState> state_;
  databuffer::Sweep sweep_{};
  std::uint64_t ticks_ = 0, sweeps_ = 0;
};

// Live it looks now and then; in lockstep it is the last of each tick, so that nothing is lost at any speed.
bool record_live(Session& session, Recorder& recorder, recording::TickLogWriter& writer) {
  bool whole = true;
  while (whole && !databuffer::stop_requested()) {
    recorder.drain();
    whole = writer.flush();
    session.heartbeat();
    const timespec pause{0, kPause_ns};
    nanosleep(&pause, nullptr);
  }
  recorder.drain();
  return writer.flush() && whole;
}

bool record_in_lockstep(Session& session, Recorder& recorder, recording::TickLogWriter& writer,
                        const std::string& lockstep) {
  auto loop = databuffer::TickLoop::create(session, databuffer::LockstepRole::recorder, lockstep);
  if (!loop) give_up(loop.error());
  while (const auto due = loop->wait()) {
    recorder.drain();
    loop->done(*due);
  }
  recorder.drain();
  const bool whole = writer.flush();
  if (auto outcome = loop->outcome(); !outcome) give_up(outcome.error());
  return whole;
}

// A recording may be replayed from another folder.
std::string absolute(const std::string& path) {
  return path.empty() ? path : std::filesystem::absolute(path).string();
}

void record(const CommonOptions& common, const RecordOptions& options) {
  auto session = Session::open(common.session, "recorder");
  if (!session) give_up(session.error());
  auto role = session->claim(databuffer::Role::recorder);
  if (!role) give_up(databuffer::usage_error(role.error()));
  auto writer = recording::TickLogWriter::create(options.file, {absolute(common.config), absolute(options.terrain)});
  if (!writer) give_up(writer.error());
  const auto recorder_index = static_cast<std::size_t>(databuffer::LockstepRole::recorder);
  const bool from_the_begin =
      !options.lockstep.empty() && session->layout().lockstep.done_tick[recorder_index].load() < 0;
  Recorder recorder(*session, *writer, from_the_begin);
  databuffer::log_info("records session " + common.session + " to " + options.file);
  const bool whole = options.lockstep.empty() ? record_live(*session, recorder, *writer)
                                              : record_in_lockstep(*session, recorder, *writer, options.lockstep);
  std::printf("%llu ticks, %llu sweeps, %llu bytes in %s\n", static_cast<unsigned long long>(recorder.ticks()),
              static_cast<unsigned long long>(recorder.sweeps()), static_cast<unsigned long long>(writer->bytes()),
              options.file.c_str());
  if (!whole)
    give_up({options.file, "room on the disk", "a write that failed", "the recording ends where it is", false});
}

}  // namespace

void add_record_command(CLI::App& app, const CommonOptions& common) {
  auto* command = app.add_subcommand("record", "record the session's ticks and events until Ctrl-C");
  auto options = std::make_shared<RecordOptions>();
  command->add_option("FILE", options->file, "recording to write")->required();
  command->add_option("--terrain", options->terrain, "the directory that radar-model was given, for the replay");
  command->add_option("--lockstep", options->lockstep, "the set's plan, when it runs in lockstep");
  command->callback([&common, options] { record(common, *options); });
}

}  // namespace yars::tools
