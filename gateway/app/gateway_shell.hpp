// Gateway of one host: in passes of 5 ms it exchanges records between the local segment and the other hosts.
// Inputs: the local segment; samples of other hosts.
// Outputs: samples; records of other hosts in the local segment; NetworkStatus twice a second.
// Errors: none ends the gateway. Invalid samples are refused, counted and noted.
// Threads: one.
// Source: docs/network.md.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "databuffer/session/session.hpp"
#include "gateway/dds/link.hpp"
#include "gateway/exchange/clock_exchange.hpp"
#include "gateway/exchange/context.hpp"
#include "gateway/exchange/event_exchange.hpp"
#include "gateway/exchange/history_exchange.hpp"
#include "gateway/exchange/hosts.hpp"
#include "gateway/exchange/lane_names.hpp"
#include "gateway/exchange/lockstep_exchange.hpp"
#include "gateway/exchange/map_exchange.hpp"
#include "gateway/exchange/roles.hpp"
#include "gateway/exchange/state_exchange.hpp"
#include "gateway/exchange/world_exchange.hpp"

namespace yars::gateway {

class GatewayShell {
 public:
  GatewayShell(databuffer::Session& session, const std::string& session_name, dds::Link link,
               const radar::NetworkSettings& settings, Identity identity);
  // Addresses of the other computers that are asked, for messages.
  void set_asked(std::vector<std::string> peers) { asked_ = std::move(peers); }
  // Waits for the next pass and runs it. Probes and input events are taken as soon as they arrive.
  void step();
  // The host whose handshake with this one was lost; empty: none. The caller then opens a new link and a new shell.
  const std::string& lost_handshake() const { return lost_handshake_; }
  // Runs further passes until the other hosts have what this one has sent, for 1 s at most. Without them the last tick
  // of a lockstep run would not reach a slower host.
  void finish();

 private:
  void pass();
  void receive();
  void send();
  void report();
  void look_at_processes();
  void report_joined() const;
  void report_messages();
  void report_silence();

  dds::Link link_;
  databuffer::Session* session_;
  Hosts hosts_;
  Roles roles_;
  Context context_;
  LaneNames lanes_;
  ClockExchange clock_;
  StateExchange states_{lanes_};
  EventExchange events_{lanes_};
  WorldNumbers world_numbers_;
  WorldExchange world_{world_numbers_};
  HistoryExchange history_{lanes_, world_numbers_};
  MapExchange maps_;
  LockstepExchange lockstep_;
  std::vector<std::string> asked_;
  std::string lost_handshake_;
  int domain_, participants_;
  bool secured_;
  bool reported_joined_ = false;
  bool reported_silence_ = false;
  std::int64_t first_pass_ns_ = 0;
  std::int64_t next_pass_ns_ = 0;
  std::int64_t next_report_ns_ = 0;
  std::int64_t last_report_ns_ = 0;
  double last_cpu_s_ = 0.0;
  double load_ = 0.0;
};

}  // namespace yars::gateway
