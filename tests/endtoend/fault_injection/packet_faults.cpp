// Faults of UDP packets to a flight-model: out of order, duplicated, cut off, with hostile numbers, of unknown kind,
// and faster than they can be read.
#include <signal.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <span>

#include "tests/endtoend/fault_injection/fault_set.hpp"
#include "tests/endtoend/fault_injection/faults.hpp"
#include "tests/flightmodel/bridges/live/udp_peer.hpp"
#include "tests/flightmodel/bridges/packets.hpp"

namespace yars::endtoend::fault_injection {

namespace {

using flightmodel::bridges::bytes_of;
using flightmodel::bridges::packet_of;
using flightmodel::bridges::PacketBytes;
using flightmodel::bridges::put;

constexpr int kPackets = 400;

std::vector<PacketBytes> packets_of(const std::string& kind) {
  std::vector<PacketBytes> packets;
  const std::filesystem::path folder =
      std::filesystem::path(YARS_SOURCE_DIR) / "tests/flightmodel/bridges/packets" / kind;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.file_size() < 2000) packets.push_back(packet_of(kind + "/" + entry.path().filename().string()));
  if (kind == "jsbsim") {
    // Each line of the text is one packet: the labels, and each row of numbers.
    const auto text = flightmodel::bridges::text_of_packet("jsbsim/turn.txt");
    for (std::size_t begin = 0, end = 0; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1)
      packets.push_back(bytes_of(text.substr(begin, end + 1 - begin)));
  }
  return packets;
}

// Damages the packet in one of seven ways at random.
void spoil(FaultSet& set, PacketBytes& packet) {
  constexpr std::array<double, 6> kBad{std::numeric_limits<double>::quiet_NaN(),
                                       std::numeric_limits<double>::infinity(),
                                       -std::numeric_limits<double>::infinity(),
                                       1e300,
                                       -1e18,
                                       181.0};
  const auto order = set.below(2) == 0 ? std::endian::big : std::endian::little;
  switch (packet.size() < 16 ? 6 : set.below(7)) {
    case 0:
      packet.resize(set.below(packet.size()));
      break;
    case 1:
      put(packet, set.below(packet.size() / 8) * 8, kBad[set.below(kBad.size())], order);
      break;
    case 2:
      put(packet, set.below(packet.size() / 4) * 4, static_cast<float>(kBad[set.below(3)]), order);
      break;
    case 3:
      packet[set.below(4)] ^= std::byte{0xff};
      break;
    case 4:
      for (int i = 0; i < 10; ++i) packet[set.below(packet.size())] = static_cast<std::byte>(set.chance()());
      break;
    case 5:
      packet.resize(packet.size() + set.below(60'000));
      break;
    default:
      packet = bytes_of("nan,inf,-inf,1e300,,,%n%s,\n");
  }
}

// UDP port that the named flight-model reports in its log. 0: no report within 20 s.
std::uint16_t port_of(FaultSet& set, const std::string& name) {
  const std::string before_port = "on 127.0.0.1:";
  std::uint16_t port = 0;
  eventually(
      [&] {
        const std::string log = set.processes().log_of(name);
        const auto position = log.rfind(before_port);
        if (position == std::string::npos || log.find('\n', position) == std::string::npos) return false;
        port = static_cast<std::uint16_t>(std::stoi(log.substr(position + before_port.size())));
        return true;
      },
      20.0);
  return port;
}

void fire(FaultSet& set, const UdpPeer& peer, const std::string& kind, std::uint16_t port) {
  const auto packets = packets_of(kind);
  for (int i = 0; i < kPackets; ++i) {
    // A random choice, so that packets arrive out of order and repeatedly. About half of them are damaged.
    PacketBytes packet = packets[set.below(packets.size())];
    if (set.below(2) == 0) spoil(set, packet);
    peer.send(packet, port);
    if (i % 10 == 0) set.rest_ms(1.0, 6.0);
  }
}

// Expects that the bridge still runs and ends with code 0 on SIGTERM.
void end_bridge(FaultSet& set, const std::string& name, const std::string& kind) {
  const bool ran = set.processes().runs(name);
  set.processes().kill(name, SIGTERM);
  const int code = set.processes().wait(name);
  if (!ran || code != 0)
    set.tell("the bridge of " + kind + " ended with code " + std::to_string(code) + ": " +
             set.processes().log_of(name));
  std::filesystem::remove(set.processes().folder() / (name + ".log"));
}

void hostile_packets(FaultSet& set, const std::string& kind) {
  const UdpPeer peer;
  const std::string source = kind == "xplane" ? "xplane:127.0.0.1:" + std::to_string(peer.port()) : kind + ":0";
  set.processes().start("bridge", {"flight-model", "--source", source});
  std::uint16_t port = 0;
  if (kind == "xplane") {
    if (const auto request = peer.hear(20'000)) port = request->port;
  } else {
    port = port_of(set, "bridge");
  }
  if (port == 0)
    set.tell("the bridge of " + kind + " does not listen");
  else
    fire(set, peer, kind, port);
  end_bridge(set, "bridge", kind);
}

void flood_of_packets(FaultSet& set, const std::string&) {
  set.processes().start("bridge", {"flight-model", "--source", "flightgear:0"});
  const std::uint16_t port = port_of(set, "bridge");
  const PacketBytes packet = packet_of("flightgear/v24.bin");
  const UdpPeer peer;
  constexpr int kFlood = 30'000;
  for (int i = 0; i < kFlood && port != 0; ++i) peer.send(packet, port);
  end_bridge(set, "bridge", "flightgear");
}

}  // namespace

std::vector<Fault> packet_faults() {
  std::vector<Fault> faults;
  for (const auto* kind : {"flightgear", "jsbsim", "xplane", "dis"})
    faults.push_back({std::string("hostile packets, ") + kind, hostile_packets, kind});
  faults.push_back({"a flood of packets", flood_of_packets});
  return faults;
}

}  // namespace yars::endtoend::fault_injection
