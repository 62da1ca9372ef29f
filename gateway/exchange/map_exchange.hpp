// Patch maps on every host: sent row by row at a limited rate, published when whole.
// Inputs: the pool of patch maps of the local segment while the radar model runs here; maps and rows of the host where
//   it runs.
// Outputs: a sample for each map and each row; whole maps in the local pool.
// Errors: an invalid map is refused, counted and noted. A map without a free slot is noted.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "databuffer/session/session_layout.hpp"
#include "gateway/exchange/context.hpp"
#include "gateway/pace.hpp"
#include "gateway/patch_assembly.hpp"

namespace yars::gateway {

class MapExchange {
 public:
  explicit MapExchange(int rows_per_s) : rows_(1'000'000'000 / rows_per_s, std::max(1, rows_per_s / 20)) {}
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
  void send_rows(Context& context, Sent& sent);

  Allowance rows_;  // after a pause of this process those of 0.05 s are sent at once
  std::vector<Sent> sent_;
  PatchAssembly assembly_;
};

}  // namespace yars::gateway
