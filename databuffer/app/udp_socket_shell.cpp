#include "databuffer/app/udp_socket_shell.hpp"

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

namespace yars::databuffer {

namespace {

using bridges::Sender;

constexpr std::size_t kDatagramsPerCall = 16;
// [bytes] Size of the kernel's receive queue: about 1 s of packets of 600 bytes at 400 Hz. After a pause, a larger
// queue would deliver older packets. The kernel is here that of the operating system.
constexpr int kQueue_bytes = 256 * 1024;
// [ns] Maximum age of a packet by its kernel time stamp. A change of the wall clock can make the age greater than this
// limit or negative. Such an age counts as 0.
constexpr std::int64_t kMaxPacketAge_ns = 60'000'000'000;

error::Expected<sockaddr_in> resolve(const std::string& host, std::uint16_t port) {
  addrinfo hints{};
  hints.ai_family = AF_INET;
  hints.ai_socktype = SOCK_DGRAM;
  addrinfo* found = nullptr;
  if (const int problem = getaddrinfo(host.c_str(), nullptr, &hints, &found); problem != 0 || found == nullptr)
    return error::fail("--source", "a host by name or IPv4 address", "'" + host + "': " + gai_strerror(problem));
  sockaddr_in address{};
  std::memcpy(&address, found->ai_addr, sizeof address);
  freeaddrinfo(found);
  address.sin_port = htons(port);
  return address;
}

Sender sender_of(const sockaddr_in& address) {
  return {ntohl(address.sin_addr.s_addr), ntohs(address.sin_port)};
}

std::int64_t realtime_ns() {
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  return now.tv_sec * 1'000'000'000 + now.tv_nsec;
}

}  // namespace

std::string text_of(const Sender& sender) {
  std::string text;
  for (const int shift : {24, 16, 8, 0})
    text.append(text.empty() ? "" : ".").append(std::to_string(sender.address >> shift & 255U));
  return text + ':' + std::to_string(sender.port);
}

struct UdpSocket::State {
  int descriptor = -1;
  Sender endpoint;
  bool one_host = false;  // only datagrams from the peer's address are delivered
  sockaddr_in peer{};
  std::uint32_t kernel_drops = 0;  // last value of the kernel's drop counter, which wraps at 2^32
  std::uint64_t dropped = 0;

  struct Slot {
    std::array<std::byte, kMaxDatagram_bytes> bytes;
    sockaddr_in from;
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

  error::Expected<void> open() {
    descriptor = socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
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
      header.msg_name = &slot.from;
      header.msg_namelen = sizeof slot.from;
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
  if (auto opened = state->open(); !opened) return tl::unexpected(opened.error());
  if (bind(state->descriptor, reinterpret_cast<const sockaddr*>(&*address), sizeof *address) != 0) {
    const std::string subject = "UDP " + text_of(sender_of(*address));
    if (errno == EADDRINUSE)
      return error::fail(subject, "a free port", "a port on which another program listens",
                         "end that program (ss -ulpn names it), or choose another port in both programs");
    return error::fail(subject, "an address of this machine", std::strerror(errno));
  }
  sockaddr_in bound{};
  socklen_t size = sizeof bound;
  getsockname(state->descriptor, reinterpret_cast<sockaddr*>(&bound), &size);
  state->endpoint = sender_of(bound);
  return UdpSocket(std::move(state));
}

error::Expected<UdpSocket> UdpSocket::open_to_peer(const std::string& host, std::uint16_t port) {
  auto address = resolve(host, port);
  if (!address) return tl::unexpected(address.error());
  auto state = std::make_unique<State>();
  if (auto opened = state->open(); !opened) return tl::unexpected(opened.error());
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
    const std::int64_t now_ns = monotonic_ns();
    for (int i = 0; i < count; ++i) {
      auto& slot = state_->slots[static_cast<std::size_t>(i)];
      auto& header = state_->headers[static_cast<std::size_t>(i)];
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
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(sender.address);
  address.sin_port = htons(sender.port);
  // If connect() fails, the socket continues to accept all senders.
  static_cast<void>(connect(state_->descriptor, reinterpret_cast<const sockaddr*>(&address), sizeof address));
}

void UdpSocket::receive_from_all() {
  sockaddr unspecified{};
  unspecified.sa_family = AF_UNSPEC;
  static_cast<void>(connect(state_->descriptor, &unspecified, sizeof unspecified));
}

bool UdpSocket::send(std::span<const std::byte> datagram) {
  const auto sent = sendto(state_->descriptor, datagram.data(), datagram.size(), MSG_DONTWAIT | MSG_NOSIGNAL,
                           reinterpret_cast<const sockaddr*>(&state_->peer), sizeof state_->peer);
  return sent == static_cast<ssize_t>(datagram.size());
}

const Sender& UdpSocket::endpoint() const {
  return state_->endpoint;
}

std::uint64_t UdpSocket::dropped() const {
  return state_->dropped;
}

}  // namespace yars::databuffer
