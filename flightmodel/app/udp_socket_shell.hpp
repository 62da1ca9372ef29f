// Non-blocking UDP socket (IPv4 or IPv6) with arrival times.
// Inputs: datagrams from any sender (listen), or from one host (open_to_peer).
// Outputs: datagrams in the order of arrival, with sender and arrival time.
// Units: arrival time [ns] of CLOCK_MONOTONIC, from the kernel's receive stamp, else from the time of the read.
// Errors: an unknown host, or a port in use, when opening. Datagrams lost by a full kernel queue are counted.
// Threads: one. receive() and send() never wait. The two functions that open a socket can wait for a name server.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "flightmodel/bridges/bridge.hpp"

namespace yars::flightmodel {

// Buffer [bytes] of one datagram: one byte more than the longest packet of any bridge (kMaxJsbsimLine). A longer
// datagram is truncated to this length, which no decoder accepts.
inline constexpr std::size_t kMaxDatagram_bytes = 16'385;

std::string text_of(const bridges::Sender& sender);  // "127.0.0.1:5500", "[::1]:5500"

class UdpSocket {
 public:
  // Listens on an address of this machine; port 0 picks any free port. A port in use is an error. `host` may be a
  // multicast group, "GROUP" or "GROUP%INTERFACE", which is joined; several programs of a machine may listen to a
  // group.
  static error::Expected<UdpSocket> listen(const std::string& host, std::uint16_t port);
  // Makes a socket that sends to one address and receives from that host only.
  static error::Expected<UdpSocket> open_to_peer(const std::string& host, std::uint16_t port);
  UdpSocket(UdpSocket&&) noexcept;
  ~UdpSocket();

  // Makes the kernel discard new datagrams of all other senders, until receive_from_all(). send() continues to use the
  // address of open_to_peer(), because X-Plane answers from another port than the port on which it listens.
  void receive_only_from(const bridges::Sender& sender);
  void receive_from_all();

  // Passes up to `max_count` datagrams to `take`, oldest first; `received_ns` is the arrival time by CLOCK_MONOTONIC.
  using DatagramHandler =
      std::function<void(memory::Bytes datagram, const bridges::Sender& from, std::int64_t received_ns)>;
  void receive(std::size_t max_count, const DatagramHandler& take);
  // Sends to the address given to open_to_peer(). False: this datagram was not sent; a later call can succeed.
  bool send(std::span<const std::byte> datagram);

  const bridges::Sender& endpoint() const;  // local address of listen(), or remote address of open_to_peer()
  std::uint64_t dropped() const;            // datagrams lost because the queue was full

 private:
  struct State;
  explicit UdpSocket(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace yars::flightmodel
