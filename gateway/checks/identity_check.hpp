// Check of a folder with the identity of a host for DDS Security, before Cyclone DDS reads it.
// Inputs: the folder of slot `security` with key.pem, certificate.pem, identity_ca.pem, permissions_ca.pem,
//   permissions.p7s and governance.p7s. They are trusted as little as any file: regular files of at most 1 MiB.
// Outputs: warnings, one line each, such as a key that others can read.
// Errors: a file that is missing or unreadable; a key of another certificate; a certificate that identity_ca.pem has
//   not signed or that is not valid now; documents that permissions_ca.pem has not signed; a certificate or permissions
//   of another host.
// Source: OMG DDS Security 1.1, sections 9.3 and 9.4; libcrypto of OpenSSL 3.
#pragma once

#include <string>
#include <vector>

#include "lib/error/error.hpp"

namespace yars::gateway::checks {

// `name`: of this host, as others will know it; empty: unknown, and not compared with the certificate.
error::Expected<std::vector<std::string>> check_identity(const std::string& folder, const std::string& name);

}  // namespace yars::gateway::checks
