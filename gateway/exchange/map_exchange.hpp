// Patch maps on every host: sent row by row at a limited rate, published when whole.
// Inputs: the pool of patch maps of the local segment while the radar model runs here; maps and rows of the host where
// it
//   runs.
// Outputs: a sample for each map and each row; whole maps in the local pool.
// Errors: an invalid map is refused, counted and noted. A map without a free slot is noted.
// Units: times [ns].
// Threads: one.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "databuffer/session/session_layout.hpp"
#include "gateway/exchange/context.hpp"
#include "gateway/patch_assembly.hpp"

namespace yars::gateway {

class MapExchange {
 public:
  explicit MapExchange(int rows_per_s) : rows_per_s_(rows_per_s) {}
  void send(Context& context);
  void receive(Context& context);

  void receive(Context& context, const yars_net_PatchMapSample& sample);
  void receive(Context& context, const yars_net_PatchRowSample& sample);
  void publish(Context& context);

 private:
  struct Sent {
    std::uint64_t id = 0;
    std::uint32_t size = 0;
    std::uint32_t next_row = 0;
    std::vector<std::uint8_t> pixels = {};  // empty when all rows are sent
  };
  void begin_maps(Context& context);
  void end_maps(Context& context);
  bool send_row(Context& context);

  double rows_per_s_;
  double rows_due_ = 0.0;
  std::int64_t last_pass_ns_ = 0;
  std::vector<Sent> sent_;
  PatchAssembly assembly_;
};

}  // namespace yars::gateway
