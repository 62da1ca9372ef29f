// Histories of the radar model on every host: latched traffic, ticks and sweeps, in the order in which a replay needs
// them. WorldExchange has the latched worlds.
// Inputs: rings of the local segment while the radar model runs here; samples of the host where it runs.
// Outputs: a sample for each record; the records in the local rings: traffic and world before the tick that names them,
//   a tick before its sweep.
// Errors: an invalid record, a sweep whose hash is wrong, a sim time that is not that of the tick, and a tick that goes
//   back are refused, counted and noted. Records of an earlier epoch are left out. Lost samples are counted by their
//   numbers.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "databuffer/session/session_layout.hpp"
#include "gateway/exchange/context.hpp"
#include "gateway/exchange/history_progress.hpp"

namespace yars::gateway {

class HistoryExchange {
 public:
  HistoryExchange(LaneNames& lanes, const WorldNumbers& worlds) : lanes_(&lanes), worlds_(&worlds) {}
  void send(Context& context);
  void receive(Context& context);
  // Publishes what has arrived and is in order.
  void publish(Context& context);
  bool is_empty() const { return ticks_.empty() && sweeps_.empty(); }  // nothing waits for its predecessor

  void receive(Context& context, const yars_net_LatchedTrafficSample& sample);
  void receive(Context& context, const yars_net_ModelTickSample& sample);
  void receive(Context& context, const yars_net_SweepSample& sample);

 private:
  template <class Record>
  struct Waiting {
    Record record;
    std::int64_t arrived_ns;
    std::uint64_t host, start, number;  // of its sample
  };
  // The last tick that was published. Ticks count from 0 again in a new epoch.
  struct LastTick {
    std::uint32_t epoch = 0;
    std::int64_t tick = -1;
    bool precedes(const databuffer::Sweep& sweep) const {
      const auto newer = static_cast<std::int32_t>(sweep.epoch - epoch);
      return tick < 0 || newer > 0 || (newer == 0 && sweep.tick > tick);
    }
  };
  bool is_wanted(Context& context, std::uint64_t host, std::uint32_t epoch, std::int64_t tick);
  template <class Sample, class Record>
  bool is_in_order(Context& context, const Sample& sample, const Record& record, TickOrder& order);

  LaneNames* lanes_;
  const WorldNumbers* worlds_;
  // ModelTick::world of the host with the role whose record did not come in time. Later ticks do not wait for it.
  std::uint64_t missing_world_ = 0;
  static constexpr std::uint64_t kRecent = 200;  // 1 s of ticks
  History<yars_net_LatchedTrafficSample, databuffer::Traffic> traffic_history_{kRecent};
  History<yars_net_ModelTickSample, databuffer::ModelTick> tick_history_{kRecent};
  History<yars_net_SweepSample, databuffer::Sweep> sweep_history_{kRecent};
  std::deque<Waiting<databuffer::ModelTick>> ticks_;
  std::deque<Waiting<databuffer::Sweep>> sweeps_;
  RecordNumbers<64> traffic_numbers_;  // the depth of the ring
  TickOrder tick_order_, sweep_order_;
  LastTick last_tick_;
  std::uint64_t last_host_ = 0;  // from which it came
};

}  // namespace yars::gateway
