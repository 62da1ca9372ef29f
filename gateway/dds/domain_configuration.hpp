// Configuration of Cyclone DDS for one session, as the XML text that dds_create_domain() takes.
// Inputs: the form Network. Its texts are checked (config/schema), so that none can break the XML.
// Outputs: an XML text. Multicast and shared memory are off; hosts find each other by the listed addresses.
// Source: Eclipse Cyclone DDS 0.10, "Configuration guide"; docs/network.md has the reason of each value.
#pragma once

#include <filesystem>
#include <string>

#include "lib/radar/network.hpp"

namespace yars::gateway::dds {

// Repairs of lost packets start after a few ms, so that sweeps arrive within 0.15 s on a line that loses 1 %. The
// watermarks hold what a host that is cut off for 1 s has missed. With the default, 30 kB, they throttle the sweeps.
inline constexpr const char* kInternal =
    "<Internal><Watermarks><WhcAdaptive>false</WhcAdaptive><WhcHighInit>8MB</WhcHighInit><WhcHigh>8MB</WhcHigh>"
    "<WhcLow>1MB</WhcLow></Watermarks>"
    "<HeartbeatInterval min=\"5ms\" minsched=\"10ms\" max=\"1s\">20ms</HeartbeatInterval>"
    "<NackDelay>10ms</NackDelay><AckDelay>5ms</AckDelay></Internal>";

// First UDP port of a DDS domain; those of its participants begin 10 ports later (DDSI-RTPS 2.2, section 9.6.1).
constexpr int first_port(int domain) {
  return 7400 + 250 * domain;
}

inline std::string plugin(const std::string& element, const std::string& name, const std::string& function) {
  return "<" + element + "><Library initFunction=\"init_" + function + "\" finalizeFunction=\"finalize_" + function +
         "\" path=\"dds_security_" + name + "\"/>";
}

inline std::string security(const std::filesystem::path& folder) {
  std::string place;  // the folder, with the characters that have a meaning in XML replaced
  for (const char letter : folder.string())
    place += letter == '&' ? "&amp;" : letter == '<' ? "&lt;" : std::string(1, letter);
  const auto file = [&place](const std::string& element, const std::string& name) {
    return "<" + element + ">file:" + place + "/" + name + "</" + element + ">";
  };
  return "<Security>" + plugin("Authentication", "auth", "authentication") + file("IdentityCA", "identity_ca.pem") +
         file("IdentityCertificate", "certificate.pem") + file("PrivateKey", "key.pem") + "</Authentication>" +
         plugin("AccessControl", "ac", "access_control") + file("PermissionsCA", "permissions_ca.pem") +
         file("Governance", "governance.p7s") + file("Permissions", "permissions.p7s") + "</AccessControl>" +
         plugin("Cryptographic", "crypto", "crypto") + "</Cryptographic></Security>";
}

inline std::string domain_configuration(const radar::NetworkSettings& settings) {
  constexpr int kFragmentHeaders_bytes = 100;
  std::string text = "<CycloneDDS><Domain Id=\"any\"><General><Interfaces>";
  for (const std::string& name : settings.interfaces)
    text += "<NetworkInterface name=\"" + name + "\" multicast=\"false\"/>";
  text += "</Interfaces><AllowMulticast>false</AllowMulticast><MaxMessageSize>" +
          std::to_string(settings.max_message_bytes) + "B</MaxMessageSize><FragmentSize>" +
          std::to_string(settings.max_message_bytes - kFragmentHeaders_bytes) +
          "B</FragmentSize></General><Discovery>" +
          "<ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>" + std::to_string(settings.participants) +
          "</MaxAutoParticipantIndex><Peers>";
  for (const std::string& peer : settings.peers) text += "<Peer Address=\"" + peer + "\"/>";
  text += "</Peers><LeaseDuration>1000ms</LeaseDuration><SPDPInterval>200ms</SPDPInterval></Discovery>";
  text += kInternal;
  text += "<SharedMemory><Enable>false</Enable></SharedMemory>";
  if (!settings.security.empty()) text += security(settings.security);
  return text + "</Domain></CycloneDDS>";
}

}  // namespace yars::gateway::dds
