// FlightGear's native FDM packet (also what JSBSim's output of type FLIGHTGEAR sends): one datagram a state, all
// numbers big-endian, versions 24 (408 bytes) and 25 (552 bytes), the same as far as they are read here. The version
// says which length is right; any other pair is refused. The packet has no stamp that tells an old one from a new.
// Source: FlightGear's manual, option --native-fdm; the fields are held to what JSBSim sends (tests/bridges).
#pragma once

#include "databuffer/bridges/byte_order.hpp"
#include "databuffer/bridges/external_sample.hpp"

namespace yars::databuffer::bridges {

// Latitude is geodetic, altitude above mean sea level, angles true, velocity north, east, down.
failure::Expected<ExternalSample> decode_flightgear(Bytes packet);

}  // namespace yars::databuffer::bridges
