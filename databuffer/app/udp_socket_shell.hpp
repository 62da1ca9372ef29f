// A UDP socket (IPv4) that never waits: what has come is taken in one go, up to a bound; what the kernel's queue cannot
// hold is dropped and counted. Each datagram comes with the moment it reached this machine, so that whoever looks late
// knows how old it is.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "databuffer/bridges/bridge.hpp"

namespace yars::databuffer {

// One byte more than any protocol here sends: what is longer arrives cut to this, and no decoder takes that length.
inline constexpr std::size_t kLongestDatagram = 16'385;

std::string text_of(const bridges::Sender& sender);  // "127.0.0.1:5500"

class UdpSocket {
 public:
  // Listens at an address of this machine; port 0 is any free one. A port in use is an error that says so.
  static error::Expected<UdpSocket> listen(const std::string& host, std::uint16_t port);
  // Sends to one place, and hears what comes from that host alone.
  static error::Expected<UdpSocket> ask(const std::string& host, std::uint16_t port);
  UdpSocket(UdpSocket&&) noexcept;
  ~UdpSocket();

  // Hears this sender alone from now on, or again all of the host asked; the rest does not even reach the queue. Where
  // it sends to stays: X-Plane answers from another port than it is asked at.
  void hear_only(const bridges::Sender& sender);
  void hear_all();

  // Takes up to `most` datagrams, oldest first; `received_ns` is CLOCK_MONOTONIC.
  using Taker = std::function<void(memory::Bytes datagram, const bridges::Sender& from, std::int64_t received_ns)>;
  void receive(std::size_t most, const Taker& take);
  // To the place asked; false: it did not go (then the next may).
  bool send(std::span<const std::byte> datagram);

  const bridges::Sender& place() const;  // where it listens, or whom it asks
  std::uint64_t dropped() const;         // datagrams that came faster than they were taken

 private:
  struct State;
  explicit UdpSocket(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace yars::databuffer
