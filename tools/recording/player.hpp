// Plays a recording as its session went: at any moment what stood in the session, between two moments what came.
// A seek gives a key frame: state, status and outputs at that tick, the sweeps of the picture that was on the glass
// (the scan under way and the whole one before it, at least kPictureSweeps), the maps that the state names. Sweeps are
// those recorded; where there are none with video, the kernel makes them of the ticks, from the nearest status before.
// Time is the ticks'. It is cut where the recorder paused, where a new epoch began, and where ticks jump by more than
// 10 s: a cut ends a call. Behind a damaged block the kernel waits for the next status.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "lib/radar/configuration.hpp"
#include "tools/recording/recording_reader.hpp"
#include "tools/recording/replay.hpp"

namespace yars::tools::recording {

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
  static constexpr std::uint32_t kPictureSweeps = 1024;   // as many as a glass holds
  static constexpr std::size_t kMostSweepsOfASeek = 900;  // fewer than the session's ring holds

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
