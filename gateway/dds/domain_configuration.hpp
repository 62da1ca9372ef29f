// Configuration of Cyclone DDS for one session, as the XML text that dds_create_domain() takes.
// Inputs: the form Network. Its texts are checked (config/schema), so that none can break the XML.
// Outputs: an XML text. Multicast and shared memory are off; hosts find each other by the listed addresses.
// Source: Eclipse Cyclone DDS 0.10, "Configuration guide"; docs/network.md has the reason of each value.
#pragma once

#include <string>

#include "lib/radar/network.hpp"

namespace yars::gateway::dds {

std::string domain_configuration(const radar::NetworkSettings& settings);

}  // namespace yars::gateway::dds
