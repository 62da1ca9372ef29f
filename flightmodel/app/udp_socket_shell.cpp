#include "flightmodel/app/udp_socket_shell.hpp"

#include <net/if.h>
#include <netdb.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <optional>
#include <vector>

#include "databuffer/session/session.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::flightmodel {

// An address of either family.
struct SocketAddress {
  sockaddr_storage storage{};
  socklen_t size = 0;
  sockaddr* get() { return reinterpret_cast<sockaddr*>(&storage); }
  const sockaddr* get() const { return reinterpret_cast<const sockaddr*>(&storage); }
  int family() const { return storage.ss_family; }
};

namespace {

using bridges::Sender;

constexpr std::size_t kDatagramsPerCall = 16;
// [bytes] Size of the kernel's receive queue: about 1 s of packets of 600 bytes at 400 Hz. After a pause, a larger
// queue would deliver older packets. The kernel is here that of the operating system.
constexpr int kQueue_bytes = 256 * 1024;
// [ns] Maximum age of a packet by its kernel time stamp. A change of the wall clock can make the age greater than this
// limit or negative. Such an age counts as 0.
constexpr std::int64_t kMaxPacketAge_ns = 60'000'000'000;

// The text before and after '%'.
struct ZonedHost {
  std::string host, zone;
};
ZonedHost split_zone(const std::string& host) {
  const std::size_t percent = std::min(host.find('%'), host.size());
  return {host.substr(0, percent), host.substr(std::min(percent + 1, host.size()))};
}

// IPv4 comes first: a name such as localhost may have both. `flags`: of getaddrinfo().
error::Expected<SocketAddress> resolve(const std::string& host, std::uint16_t port, int flags = 0) {
  int problem = 0;
  for (const int family : {AF_INET, AF_INET6}) {
    addrinfo hints{};
    hints.ai_family = family;
    hints.ai_socktype = SOCK_DGRAM;
    hints.ai_flags = flags;
    addrinfo* found = nullptr;
    const std::string name = family == AF_INET ? split_zone(host).host : host;
    problem = getaddrinfo(name.c_str(), std::to_string(port).c_str(), &hints, &found);
    if (problem != 0 || found == nullptr) continue;
    SocketAddress address;
    std::memcpy(&address.storage, found->ai_addr, found->ai_addrlen);
    address.size = found->ai_addrlen;
    freeaddrinfo(found);
    return address;
  }
  return error::fail("--source", "a host by name or address", "'" + host + "': " + gai_strerror(problem));
}

Sender sender_of(const SocketAddress& address) {
  std::array<char, NI_MAXHOST> host{};
  std::array<char, NI_MAXSERV> port{};
  if (getnameinfo(address.get(), address.size, host.data(), host.size(), port.data(), port.size(),
                  NI_NUMERICHOST | NI_NUMERICSERV) != 0)
    return {};
  return {host.data(), text::whole_number<std::uint16_t>(port.data()).value_or(0)};
}

bool is_multicast(const SocketAddress& address) {
  if (address.family() == AF_INET)
    return IN_MULTICAST(ntohl(reinterpret_cast<const sockaddr_in*>(&address.storage)->sin_addr.s_addr));
  return IN6_IS_ADDR_MULTICAST(&reinterpret_cast<const sockaddr_in6*>(&address.storage)->sin6_addr);
}

// Joins a group on the interface `zone`; an empty one is the system's choice. False: errno has the reason.
bool join_group(int descriptor, const SocketAddress& group, const std::string& zone) {
  const unsigned interface = zone.empty() ? 0 : if_nametoindex(zone.c_str());
  if (!zone.empty() && interface == 0) return false;
  if (group.family() == AF_INET) {
    ip_mreqn request{};
    request.imr_multiaddr = reinterpret_cast<const sockaddr_in*>(&group.storage)->sin_addr;
    request.imr_ifindex = static_cast<int>(interface);
    return setsockopt(descriptor, IPPROTO_IP, IP_ADD_MEMBERSHIP, &request, sizeof request) == 0;
  }
  ipv6_mreq request{};
  request.ipv6mr_multiaddr = reinterpret_cast<const sockaddr_in6*>(&group.storage)->sin6_addr;
  request.ipv6mr_interface = interface;
  return setsockopt(descriptor, IPPROTO_IPV6, IPV6_JOIN_GROUP, &request, sizeof request) == 0;
}

std::int64_t realtime_ns() {
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  return now.tv_sec * 1'000'000'000 + now.tv_nsec;
}

}  // namespace

std::string text_of(const Sender& sender) {
  const bool is_ipv6 = sender.address.find(':') != std::string::npos;
  return (is_ipv6 ? '[' + sender.address + ']' : sender.address) + ':' + std::to_string(sender.port);
}

struct UdpSocket::State {
  int descriptor = -1;
  Sender endpoint;
  bool one_host = false;  // only datagrams from the peer's address are delivered
  SocketAddress peer;
  std::uint32_t kernel_drops = 0;  // last value of the kernel's drop counter, which wraps at 2^32
  std::uint64_t dropped = 0;

  struct Slot {
    std::array<std::byte, kMaxDatagram_bytes> bytes;
    SocketAddress from;
    iovec span;
    alignas(cmsghdr) std::array<std::byte, 128> control;
  };
  std::vector<Slot> slots{kDatagramsPerCall};
  std::array<mmsghdr, kDatagramsPerCall> headers{};

  State() = default;
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() {
    if (descriptor >= 0) close(descriptor);
  }

  error::Expected<void> open(int family) {
    descriptor = socket(family, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    if (descriptor < 0) return error::fail("UDP", "a socket", std::strerror(errno));
    const int yes = 1;
    // Failures of setsockopt are ignored. Without SO_TIMESTAMPNS the arrival time is the time of the read; without
    // SO_RXQ_OVFL drops are not counted.
    setsockopt(descriptor, SOL_SOCKET, SO_TIMESTAMPNS, &yes, sizeof yes);
    setsockopt(descriptor, SOL_SOCKET, SO_RXQ_OVFL, &yes, sizeof yes);
    setsockopt(descriptor, SOL_SOCKET, SO_RCVBUF, &kQueue_bytes, sizeof kQueue_bytes);
    return {};
  }

  int read_batch(std::size_t max_count) {
    const std::size_t count = std::min(max_count, kDatagramsPerCall);
    for (std::size_t i = 0; i < count; ++i) {
      Slot& slot = slots[i];
      slot.span = {slot.bytes.data(), slot.bytes.size()};
      msghdr& header = headers[i].msg_hdr;
      header = {};
      header.msg_name = &slot.from.storage;
      header.msg_namelen = sizeof slot.from.storage;
      header.msg_iov = &slot.span;
      header.msg_iovlen = 1;
      header.msg_control = slot.control.data();
      header.msg_controllen = slot.control.size();
    }
    return recvmmsg(descriptor, headers.data(), static_cast<unsigned>(count), MSG_DONTWAIT, nullptr);
  }

  // Returns the age of the datagram [ns] by the kernel's time stamp; 0 without a valid stamp. `now_ns`: CLOCK_REALTIME,
  // the clock of the stamp. Adds the kernel's new drops to `dropped`.
  std::int64_t read_control(msghdr& header, std::int64_t now_ns) {
    std::int64_t age_ns = 0;
    for (cmsghdr* part = CMSG_FIRSTHDR(&header); part != nullptr; part = CMSG_NXTHDR(&header, part)) {
      if (part->cmsg_level != SOL_SOCKET) continue;
      if (part->cmsg_type == SO_TIMESTAMPNS) {
        timespec stamp{};
        std::memcpy(&stamp, CMSG_DATA(part), sizeof stamp);
        age_ns = now_ns - (stamp.tv_sec * 1'000'000'000 + stamp.tv_nsec);
      } else if (part->cmsg_type == SO_RXQ_OVFL) {
        std::uint32_t count = 0;
        std::memcpy(&count, CMSG_DATA(part), sizeof count);
        dropped += count - kernel_drops;
        kernel_drops = count;
      }
    }
    return age_ns >= 0 && age_ns <= kMaxPacketAge_ns ? age_ns : 0;
  }
};

UdpSocket::UdpSocket(std::unique_ptr<State> state) : state_(std::move(state)) {}
UdpSocket::UdpSocket(UdpSocket&&) noexcept = default;
UdpSocket::~UdpSocket() = default;

error::Expected<UdpSocket> UdpSocket::listen(const std::string& host, std::uint16_t port) {
  auto address = resolve(host, port);
  if (!address) return tl::unexpected(address.error());
  auto state = std::make_unique<State>();
  if (auto opened = state->open(address->family()); !opened) return tl::unexpected(opened.error());
  const std::string subject = "UDP " + text_of(sender_of(*address));
  const bool is_group = is_multicast(*address);
  const int yes = 1;
  if (is_group) setsockopt(state->descriptor, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  if (bind(state->descriptor, address->get(), address->size) != 0) {
    if (errno == EADDRINUSE)
      return error::fail(subject, "a free port", "a port on which another program listens",
                         "end that program (ss -ulpn names it), or choose another port in both programs");
    return error::fail(subject, "an address of this machine", std::strerror(errno));
  }
  if (is_group && !join_group(state->descriptor, *address, split_zone(host).zone))
    return error::fail(subject, "a multicast group that can be joined", std::strerror(errno),
                       "name the network's interface: " + split_zone(host).host + "%eth0 (ip link lists them)");
  SocketAddress bound;
  bound.size = sizeof bound.storage;
  getsockname(state->descriptor, bound.get(), &bound.size);
  state->endpoint = sender_of(bound);
  return UdpSocket(std::move(state));
}

error::Expected<UdpSocket> UdpSocket::open_to_peer(const std::string& host, std::uint16_t port) {
  auto address = resolve(host, port);
  if (!address) return tl::unexpected(address.error());
  auto state = std::make_unique<State>();
  if (auto opened = state->open(address->family()); !opened) return tl::unexpected(opened.error());
  state->peer = *address;
  state->endpoint = sender_of(*address);
  state->one_host = true;
  return UdpSocket(std::move(state));
}

void UdpSocket::receive(std::size_t max_count, const DatagramHandler& take) {
  while (max_count > 0) {
    const int count = state_->read_batch(max_count);
    // Either no datagram is left, or the kernel reports that no program listens at the peer of an earlier send. The
    // next call can read again.
    if (count <= 0) return;
    const std::int64_t wall_ns = realtime_ns();
    const std::int64_t now_ns = databuffer::monotonic_ns();
    for (int i = 0; i < count; ++i) {
      auto& slot = state_->slots[static_cast<std::size_t>(i)];
      auto& header = state_->headers[static_cast<std::size_t>(i)];
      slot.from.size = header.msg_hdr.msg_namelen;
      const Sender from = sender_of(slot.from);
      const std::int64_t age_ns = state_->read_control(header.msg_hdr, wall_ns);
      if (state_->one_host && from.address != state_->endpoint.address) continue;
      take(std::span(slot.bytes).first(header.msg_len), from, now_ns - age_ns);
    }
    max_count -= static_cast<std::size_t>(count);
    if (static_cast<std::size_t>(count) < kDatagramsPerCall) return;
  }
}

// Connects the socket to `sender`; the kernel then discards new datagrams of all other senders. sendto() with an
// address still works.
void UdpSocket::receive_only_from(const Sender& sender) {
  // If connect() fails, the socket continues to accept all senders.
  if (const auto address = resolve(sender.address, sender.port, AI_NUMERICHOST))
    static_cast<void>(connect(state_->descriptor, address->get(), address->size));
}

void UdpSocket::receive_from_all() {
  sockaddr unspecified{};
  unspecified.sa_family = AF_UNSPEC;
  static_cast<void>(connect(state_->descriptor, &unspecified, sizeof unspecified));
}

bool UdpSocket::send(std::span<const std::byte> datagram) {
  const auto sent = sendto(state_->descriptor, datagram.data(), datagram.size(), MSG_DONTWAIT | MSG_NOSIGNAL,
                           state_->peer.get(), state_->peer.size);
  return sent == static_cast<ssize_t>(datagram.size());
}

const Sender& UdpSocket::endpoint() const {
  return state_->endpoint;
}

std::uint64_t UdpSocket::dropped() const {
  return state_->dropped;
}

}  // namespace yars::flightmodel
