// Replay of a recording. Class Replay runs the radar kernel again over the recorded ticks and compares the computed
// sweeps with the recorded ones. Class Player returns the records of the session for any sim time.
// Inputs: RecordingReader, configuration, terrain and scenes. Outputs: counts of equal and different sweeps, records.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "databuffer/messages/model_records.hpp"
#include "lib/radar/world.hpp"
#include "model/kernel/radar_kernel.hpp"
#include "model/kernel/tick_inputs.hpp"
#include "model/scene/index/scene_store.hpp"
#include "model/terrain/sampling/terrain_view.hpp"
#include "radar/recording/branch.hpp"
#include "radar/recording/recorded_kinds.hpp"
#include "radar/recording/recording_io.hpp"

namespace yars::radar {
struct RadarConfiguration;
}  // namespace yars::radar

namespace yars::recording {

// Compares the hashes of replayed sweeps with those of recorded sweeps of the same epoch and number. Two sweeps may
// have the same number, because a model killed between a sweep and its status repeats the number after its restart.
class Comparison {
 public:
  void replayed(const databuffer::Sweep& sweep);
  void recorded(const SweepDigest& digest);

  std::uint64_t equal() const { return equal_; }
  std::uint64_t different() const { return different_; }
  std::uint64_t not_ready() const { return not_ready_; }      // not compared: recorded while terrain was loading
  std::uint64_t missing() const { return recorded_.size(); }  // recorded, not replayed
  std::uint64_t extra() const { return replayed_.size(); }    // replayed, not recorded
  std::uint64_t run_hash() const { return run_hash_; }        // FNV-1a 64 over all recorded hashes in order

 private:
  using Key = std::pair<std::uint32_t, std::uint32_t>;
  using Hashes = std::multimap<Key, std::uint64_t>;
  void match(Hashes& own, Hashes& other, Key sweep, std::uint64_t hash);

  Hashes replayed_, recorded_;  // sweeps without a counterpart yet
  std::uint64_t equal_ = 0, different_ = 0, not_ready_ = 0;
  std::uint64_t run_hash_ = 0xcbf29ce484222325ULL;
};

// Runs the kernel again over the ticks of a recording and compares its sweeps with the recorded sweeps.
class Replay {
 public:
  // All arguments must outlive the replay. `scenes` may be null.
  Replay(const radar::RadarConfiguration& configuration, model::terrain::TerrainStore& store,
         model::scene::SceneStore* scenes = nullptr);

  // Makes a new kernel that resumes from this status. Allowed before the first tick and between ticks.
  void start(const StartingPoint& point);
  // Runs one tick and returns its finished sweep. nullptr: no sweep, or a sweep that is not compared. The first sweeps
  // after start() are not compared, because the azimuth smear and sub-beams combine successive sweeps, some from before
  // the start: two sweeps, and with sub-beams those until the beam has moved by their width or a scan begins.
  const databuffer::Sweep* tick(const databuffer::ModelTick& tick);
  // Sets the traffic from the next tick on.
  void traffic(const databuffer::Traffic& traffic) { traffic_ = model::kernel::points_of(traffic); }
  // Sets the world from the next tick on. One with kWorldConfigured is that of this replay's configuration.
  void world(const databuffer::WorldState& world);
  void recorded(const SweepDigest& digest) { comparison_.recorded(digest); }

  std::uint64_t ticks() const { return ticks_; }
  std::uint64_t sweeps() const { return sweeps_; }
  const Comparison& comparison() const { return comparison_; }

 private:
  void restart(std::int64_t resumed_tick);
  void begin_kernel(const databuffer::ModelStatus& status);
  bool is_whole(const databuffer::Sweep& sweep);

  const radar::RadarConfiguration* configuration_;
  model::terrain::TerrainStore* store_;
  model::kernel::RadarKernel kernel_;
  bool kernel_is_new_ = true;  // it has not been resumed or stepped
  model::terrain::TerrainViewPointer view_;
  model::scene::SceneStore* scenes_;
  model::scene::SceneViewPointer scene_view_;
  std::vector<model::physics::MovingPoint> traffic_;
  radar::WorldConfiguration world_;
  databuffer::Sweep sweep_{};
  databuffer::ModelStatus last_{}, before_last_{};  // status after the newest tick, and after the tick before
  Comparison comparison_;
  std::uint64_t ticks_ = 0, sweeps_ = 0;
  int smeared_sweeps_ = 0;             // number of sweeps still to come with smear from before the start
  bool old_rays_ = false;              // rays from before the start may be in use
  std::optional<geo::Bearing> begin_;  // azimuth of the first sweep after the start
};

// Configuration, terrain and scenes of the kernel. The stores must outlive the player; `scenes` may be null.
struct PlayerWorld {
  std::shared_ptr<radar::RadarConfiguration> configuration;  // for this player alone, which sets fidelity.samples
  model::terrain::TerrainStore* store = nullptr;
  model::scene::SceneStore* scenes = nullptr;
};

// Records that Player returns from one call: the newest state, status, outputs and world if they changed, all sweeps
// and maps.
struct Played {
  std::optional<databuffer::RadarState> state;
  std::optional<databuffer::ModelStatus> status;  // newest status, with the ownship of the newest tick
  std::optional<databuffer::Outputs> outputs;
  std::optional<databuffer::WorldState> world;  // newest world in effect, if it changed
  std::optional<databuffer::Traffic> traffic;   // never from Player: a live set goes on with it
  std::deque<databuffer::Sweep> sweeps;
  std::vector<Patch> maps;
  std::optional<std::int64_t> cut_to_tick;  // tick at which the recording continues after a cut (see Player)
  bool ended = false;                       // the recording has no more items
};

// Plays a recording: seek() returns a key frame of a tick, play_to() returns the records that follow it.
// A key frame has state, status, outputs and world at that tick, the maps that the state names, and the newest sweeps.
// The sweeps include the current scan and the complete scan before it, up to kMaxSeekSweeps sweeps. If the recording
// has video, sweeps are returned as recorded. Else the kernel computes the sweeps, from a status recorded before them.
// A cut ends a call of play_to(). A cut is a pause of the recorder, a new epoch, or a jump of the ticks by over 10 s.
// After a damaged block the kernel waits for the next status.
class Player {
 public:
  static constexpr std::uint32_t kPictureSweeps = 1024;  // a seek reads at least so many sweeps before its tick
  static constexpr std::size_t kMaxSeekSweeps = 900;     // maximum that a seek returns; the session's ring holds 1,024

  // `world` must be empty if has_video(reader), because the kernel's sweeps would be returned in addition to the
  // recorded sweeps. Without video, `world` is required for sweeps.
  Player(RecordingReader& reader, std::optional<PlayerWorld> world);
  Player(const Player&) = delete;
  Player& operator=(const Player&) = delete;

  static bool has_video(const RecordingReader& reader);
  static bool has_ticks(const RecordingReader& reader);

  Played seek(std::int64_t tick);
  // Picture of a branch point: its maps, and the sweeps of the current scan and the one before up to its tick.
  Played picture(const BranchPoint& point);
  // Records after those that seek() and play_to() have returned so far, up to and including this tick.
  Played play_to(std::int64_t tick);

  std::int64_t tick() const { return tick_; }  // newest tick that was played
  std::uint64_t different() const;             // sweeps computed since the seek that differ from the recorded ones

 private:
  bool look_ahead();
  bool is_cut() const;
  bool is_due(std::int64_t tick) const;
  void take(Played& played);
  void take_tick(const databuffer::ModelTick& tick, Played& played);
  void take_status(const databuffer::ModelStatus& status, Played& played);
  void run_kernel(const databuffer::ModelTick& tick, Played& played);
  void pass_over_damage();
  void start_late(const databuffer::ModelStatus& status, Played& played);
  void start_kernel(const databuffer::ModelStatus& status);
  Replay& kernel();
  void use(const databuffer::Traffic& traffic);
  void use(const databuffer::WorldState& world);
  void use_targets(const RecordingItem& item);
  Played seek(std::int64_t tick, std::uint32_t least_sweeps);
  std::size_t picture_begin(std::size_t block, std::int64_t tick, std::uint32_t least_sweeps);
  std::optional<databuffer::ModelStatus> status_at(std::size_t block, std::int64_t tick);
  void find_maps(std::size_t block, Played& played);

  RecordingReader* reader_;
  std::optional<PlayerWorld> world_;
  std::optional<Replay> kernel_;
  bool awaits_status_ = false;          // the kernel needs a status to resume from
  std::vector<RecordingItem> pending_;  // ticks, traffic and worlds while awaits_status_ is true
  // Tick of the status from which the kernel resumed; -1: none. Ticks up to this tick are not run.
  std::int64_t kernel_from_tick_ = -1;
  std::uint32_t kernel_from_epoch_ = 0;
  std::optional<RecordingItem> ahead_;  // the next item, already read
  bool started_ = false;                // an item with a tick was played since the seek
  bool cut_reported_ = false;           // the cut before the next item was reported
  std::int64_t tick_ = 0;
  std::uint32_t epoch_ = 0;
  std::optional<databuffer::ModelTick> newest_tick_;
  std::optional<databuffer::ModelStatus> status_;
};

}  // namespace yars::recording
