// Check of the form Network against the computer that it is used on: its interfaces, and the addresses of its peers.
// Also the name that a computer has in a session when the form names none.
// Inputs: the form Network, valid by itself (config/schema); interfaces and name service of this computer.
// Outputs: warnings, one line each; the peers that have an address; those of other computers.
// Errors: an interface that this computer does not have, or that has no IPv4 address; a peer that is a broadcast
//   address of this computer's networks.
// The name service may answer after seconds.
#pragma once

#include <string>
#include <vector>

#include "lib/error/error.hpp"
#include "lib/radar/network.hpp"

namespace yars::gateway::checks {

struct ComputerCheck {
  std::vector<std::string> warnings;
  std::vector<std::string> known_peers;  // without those whose name has no address: Cyclone DDS cannot ask them
  std::vector<std::string> other_peers;  // of known_peers, those that are not this computer
};

// The first part of the computer's host name, of at most kMaxHostName bytes.
std::string host_name();

error::Expected<ComputerCheck> check_computer(const radar::NetworkSettings& settings);

}  // namespace yars::gateway::checks
