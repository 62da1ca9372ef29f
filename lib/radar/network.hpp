// Settings of the network that joins the computers of a session: form Network of a configuration file.
// config/schema reads them; gateway/ uses them. Each computer has settings of its own, and no kernel depends on them.
// The defaults open no network: the gateway talks to itself alone, over the loopback interface.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace yars::radar {

// Topics, in the order of gateway/yars_network.idl. A topic in DDS is `yars/` and this name.
inline constexpr std::array<std::string_view, 24> kTopicNames{
    "hosts",          "probes",          "clock",       "clock_requests",  "ownship",       "input_events",
    "event_receipts", "applied_events",  "radar_state", "outputs",         "advice",        "model_status",
    "model_ticks",    "sweeps",          "traffic",     "traffic_latched", "patch_maps",    "patch_rows",
    "captions",       "recorder_status", "lockstep",    "world",           "world_latched", "world_requests"};

inline constexpr std::size_t kMaxHostName = 31;   // [bytes] maximum length of NetworkSettings::name
inline constexpr std::size_t kMaxInterfaces = 8;  // maximum number of network interfaces
inline constexpr std::size_t kMaxPeers = 64;      // maximum number of addresses that are asked for participants

struct NetworkSettings {
  std::string name;                             // of the computer; empty: its host name
  int priority = 0;                             // [0, 1000] when two computers hold one role, the higher one keeps it
  int domain = 0;                               // [0, 230] DDS domain: ports from 7400 + 250 * domain
  std::vector<std::string> interfaces{"lo"};    // network interfaces of this computer
  std::vector<std::string> peers{"127.0.0.1"};  // addresses and host names of the session's computers
  std::vector<std::string> topics_in;           // topics read from other computers; empty: all
  std::vector<std::string> topics_out;          // topics written for other computers; empty: all
  int participants = 4;                         // [1, 32] maximum number of DDS participants on one computer
  int map_rows_per_s = 1000;                    // [10, 20000] rows of patch maps written in a second
  int max_message_bytes = 1400;                 // [512, 65000] [bytes] maximum size of a datagram
  std::string security;                         // folder of the identity for DDS Security; empty: none
};

}  // namespace yars::radar
