// A recording brought back: the kernel run again and compared, and the player of what a session showed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "databuffer/messages/model_records.hpp"
#include "lib/radar/configuration.hpp"
#include "model/kernel/radar_kernel.hpp"
#include "model/kernel/tick_inputs.hpp"
#include "model/scene/index/scene_store.hpp"
#include "model/terrain/sampling/terrain_view.hpp"
#include "tools/recording/recorded_kinds.hpp"
#include "tools/recording/recording_reader.hpp"

namespace yars::tools::recording {

// Sweeps made again against sweeps recorded, by epoch and number of the sweep. Of one number there are two sweeps
// where a model was killed between a sweep and its status.
class Comparison {
 public:
  void made(const databuffer::Sweep& sweep);
  void recorded(const SweepMark& mark);

  std::uint64_t equal() const { return equal_; }
  std::uint64_t different() const { return different_; }
  std::uint64_t not_ready() const { return not_ready_; }      // recorded over posts that were still loading
  std::uint64_t missing() const { return recorded_.size(); }  // recorded, not made again
  std::uint64_t extra() const { return made_.size(); }        // the other way round
  std::uint64_t run_hash() const { return run_hash_; }        // FNV-1a 64 over the recorded hashes in order

 private:
  using Key = std::pair<std::uint32_t, std::uint32_t>;
  using Hashes = std::multimap<Key, std::uint64_t>;
  void settle(Hashes& own, Hashes& other, Key sweep, std::uint64_t hash);

  Hashes made_, recorded_;  // those without a partner yet
  std::uint64_t equal_ = 0, different_ = 0, not_ready_ = 0;
  std::uint64_t run_hash_ = 0xcbf29ce484222325ULL;
};

// Runs the kernel again over the ticks of a recording and compares its sweeps with those recorded.
class Replay {
 public:
  // All must outlive it; without a store of scenes there are none.
  Replay(const radar::RadarConfiguration& configuration, model::terrain::TerrainStore& store,
         model::scene::SceneStore* scenes = nullptr);

  // Before ticks, or between them: a new kernel that goes on from there.
  void start(const StartingPoint& point);
  // The sweep that came out of it; nullptr: none, or one whose smear needs those from before the start.
  const databuffer::Sweep* tick(const databuffer::ModelTick& tick);
  // Holds from the next tick on.
  void traffic(const databuffer::Traffic& traffic) { traffic_ = model::kernel::points_of(traffic); }
  void recorded(const SweepMark& mark) { comparison_.recorded(mark); }

  std::uint64_t ticks() const { return ticks_; }
  std::uint64_t sweeps() const { return sweeps_; }
  const Comparison& comparison() const { return comparison_; }

 private:
  void restart(std::int64_t resumed_tick);

  const radar::RadarConfiguration* configuration_;
  model::terrain::TerrainStore* store_;
  model::kernel::RadarKernel kernel_;
  model::terrain::TerrainViewPointer view_;
  model::scene::SceneStore* scenes_;
  model::scene::SceneViewPointer scene_view_;
  std::vector<model::physics::MovingPoint> traffic_;
  databuffer::Sweep sweep_{};
  databuffer::ModelStatus last_{}, before_last_{};  // after the newest tick and after the one before
  Comparison comparison_;
  std::uint64_t ticks_ = 0, sweeps_ = 0;
  std::uint64_t smeared_ = 0;  // sweeps to come whose smear needs those from before the start
};

// Plays a recording as its session went: at any moment what stood in the session, between two moments what came.
// A seek gives a key frame: state, status and outputs at that tick, the sweeps of the picture that was on the glass
// (the scan under way and the whole one before it, at least kPictureSweeps), the maps that the state names. Sweeps are
// those recorded; where there are none with video, the kernel makes them of the ticks, from the nearest status before.
// Time is the ticks'. It is cut where the recorder paused, where a new epoch began, and where ticks jump by more than
// 10 s: a cut ends a call. Behind a damaged block the kernel waits for the next status.

// Of what the kernel makes sweeps. The stores must outlive the player; without a store of scenes there are none.
struct PlayerWorld {
  radar::RadarConfiguration configuration;
  model::terrain::TerrainStore* store = nullptr;
  model::scene::SceneStore* scenes = nullptr;
};

// The newest of each, where it changed; all sweeps and maps.
struct Played {
  std::optional<databuffer::RadarState> state;
  std::optional<databuffer::ModelStatus> status;  // with the ownship of the newest tick
  std::optional<databuffer::Outputs> outputs;
  std::deque<databuffer::Sweep> sweeps;
  std::vector<Patch> maps;
  std::optional<std::int64_t> cut_to_tick;  // what follows begins there
  bool ended = false;                       // nothing follows
};

class Player {
 public:
  static constexpr std::uint32_t kPictureSweeps = 1024;  // as many as a glass holds
  static constexpr std::size_t kMaxSweepsOfASeek = 900;  // fewer than the session's ring holds

  // `world` is needed unless has_video(reader).
  Player(RecordingReader& reader, std::optional<PlayerWorld> world);
  Player(const Player&) = delete;
  Player& operator=(const Player&) = delete;

  static bool has_video(const RecordingReader& reader);
  static bool has_ticks(const RecordingReader& reader);

  Played seek(std::int64_t tick);
  // All up to and with this tick that has not come yet.
  Played play_to(std::int64_t tick);

  std::int64_t tick() const { return tick_; }  // of the newest that came
  std::uint64_t different() const;             // sweeps made since the seek that were recorded as others

 private:
  bool look_ahead();
  bool is_cut() const;
  bool is_due(std::int64_t tick) const;
  void take(Played& played);
  void take_tick(const databuffer::ModelTick& tick, Played& played);
  void take_status(const databuffer::ModelStatus& status, Played& played);
  void run_kernel(const databuffer::ModelTick& tick, Played& played);
  void pass_over_hole();
  void start_late(const databuffer::ModelStatus& status, Played& played);
  void start_kernel(const databuffer::ModelStatus& status);
  void use_traffic(const databuffer::Traffic& traffic);
  std::size_t picture_begin(std::size_t block, std::int64_t tick);
  std::optional<databuffer::ModelStatus> status_at(std::size_t block, std::int64_t tick);
  void find_maps(std::size_t block, Played& played);

  RecordingReader* reader_;
  std::optional<PlayerWorld> world_;
  std::optional<Replay> kernel_;
  bool waiting_ = false;                // for a status from which the kernel may go on
  std::vector<RecordingItem> waited_;   // ticks, and the traffic between them
  std::int64_t kernel_from_tick_ = -1;  // ticks up to it are in the status that the kernel took up
  std::uint32_t kernel_from_epoch_ = 0;
  std::optional<RecordingItem> ahead_;
  bool started_ = false;   // something with a time came since the seek
  bool cut_told_ = false;  // of the item ahead
  std::int64_t tick_ = 0;
  std::uint32_t epoch_ = 0;
  std::optional<databuffer::ModelTick> newest_tick_;
  std::optional<databuffer::ModelStatus> status_;
};

}  // namespace yars::tools::recording
