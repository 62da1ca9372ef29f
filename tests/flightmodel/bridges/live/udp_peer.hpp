// Simulated external program: a UDP socket on a loopback address that sends, and receives with a time limit.
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace yars::endtoend {

class UdpPeer {
 public:
  explicit UdpPeer(const std::string& host = "127.0.0.1", std::uint16_t own_port = 0)
      : descriptor_(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    const sockaddr_in own = address(host, own_port);
    const int queue_bytes = 4 << 20;
    setsockopt(descriptor_, SOL_SOCKET, SO_RCVBUF, &queue_bytes, sizeof queue_bytes);
    if (descriptor_ < 0 || bind(descriptor_, reinterpret_cast<const sockaddr*>(&own), sizeof own) != 0)
      throw std::runtime_error("no UDP socket on " + host);
  }
  ~UdpPeer() { close(descriptor_); }
  UdpPeer(const UdpPeer&) = delete;
  UdpPeer& operator=(const UdpPeer&) = delete;

  std::uint16_t port() const {
    sockaddr_in own{};
    socklen_t size = sizeof own;
    getsockname(descriptor_, reinterpret_cast<sockaddr*>(&own), &size);
    return ntohs(own.sin_port);
  }

  void send(std::span<const std::byte> datagram, std::uint16_t port) const {
    const sockaddr_in to = address("127.0.0.1", port);
    sendto(descriptor_, datagram.data(), datagram.size(), 0, reinterpret_cast<const sockaddr*>(&to), sizeof to);
  }

  struct Heard {
    std::vector<std::byte> datagram;
    std::uint16_t port;  // of the sender
  };
  // Waits for a datagram; nullopt: none within timeout_ms.
  std::optional<Heard> hear(int timeout_ms) const {
    pollfd waits{descriptor_, POLLIN, 0};
    if (poll(&waits, 1, timeout_ms) <= 0) return std::nullopt;
    Heard heard{std::vector<std::byte>(65'536), 0};
    sockaddr_in from{};
    socklen_t size = sizeof from;
    const ssize_t count = recvfrom(descriptor_, heard.datagram.data(), heard.datagram.size(), 0,
                                   reinterpret_cast<sockaddr*>(&from), &size);
    if (count < 0) return std::nullopt;
    heard.datagram.resize(static_cast<std::size_t>(count));
    heard.port = ntohs(from.sin_port);
    return heard;
  }

 private:
  static sockaddr_in address(const std::string& host, std::uint16_t port) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    inet_pton(AF_INET, host.c_str(), &address.sin_addr);
    return address;
  }

  int descriptor_;
};

}  // namespace yars::endtoend
