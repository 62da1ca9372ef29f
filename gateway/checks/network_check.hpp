// Checks of the form Network on the computer that it is used on, before Cyclone DDS reads it: interfaces, addresses of
// peers, identity. Also the name that a computer has in a session when the form names none.
// Inputs: the form Network, valid by itself (config/schema); interfaces and name service of this computer; the folder
//   of slot `security` with key.pem, certificate.pem, identity_ca.pem, permissions_ca.pem, permissions.p7s and
//   governance.p7s. They are trusted as little as any file: regular files of at most 1 MiB.
// Outputs: warnings, one line each; the peers that have an address; those of other computers.
// Errors: an interface that is not here, or has no IPv4 address; a peer that is a broadcast address of a network here;
//   files that are missing or unreadable, of another host, not signed by the authority beside them, or not valid now.
// The name service may answer after seconds.
// Source: OMG DDS Security 1.1, sections 9.3 and 9.4; libcrypto of OpenSSL 3.
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

// Checks interfaces and peers.
error::Expected<ComputerCheck> check_computer(const radar::NetworkSettings& settings);

// Checks the folder with the identity of a host for DDS Security. Output: warnings, such as a key that others can read.
// `name`: of this host, as others will know it; empty: unknown, and not compared with the certificate.
error::Expected<std::vector<std::string>> check_identity(const std::string& folder, const std::string& name);

}  // namespace yars::gateway::checks
