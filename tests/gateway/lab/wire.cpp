// A switch between TAP devices of network namespaces, in user space: a line with loss, delay, duplicates, frames out of
// order, a bandwidth and hosts that are cut off. It stands for tc's netem, which not every kernel has.
//
// usage: wire PORTS [SEED]      ports are numbered from 1; SEED of the random numbers, 1 unless given
//
// Input: one command a line. Each is answered by one line: "ok", "ok NUMBERS" or "error: ...".
//   plug PORT NAMESPACE         makes the device eth0 in a network namespace (/proc/PID/ns/net) and joins it to the
//   port unplug PORT                 removes that device
//   cut PORT, mute PORT, heal PORT   a cut port takes and gives nothing, a mute one no data of DDS: odd UDP ports
//   loss PERCENT, duplicate PERCENT, reorder PERCENT      of the frames, each by itself
//   delay MS JITTER_MS          evenly spread over delay - jitter to delay + jitter; frames may overtake each other
//   bandwidth KBIT_PER_S        of what leaves a port, 0 for no limit; a queue of more than kMaxQueue_s is dropped
//   statistics                  "ok in N out N lost N duplicated N reordered N cut N overrun N"
// A reordered frame is late by its delay once more and kReorderedBy_s, so those behind it overtake it. The end of the
// input ends the program, and with it the devices.
#include <fcntl.h>
#include <linux/if.h>
#include <linux/if_tun.h>
#include <poll.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <optional>
#include <queue>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace {

constexpr double kReorderedBy_s = 0.005;
constexpr double kMaxQueue_s = 0.5;
constexpr double kIdle_s = 1.0;        // longest sleep
constexpr int kMaxFrames = 64;         // taken from a port before the others have their turn
constexpr std::size_t kFrame = 65536;  // bytes, more than any frame has
constexpr std::size_t kAddress = 6;    // bytes of an Ethernet address: a frame begins with target and source
constexpr unsigned long kMaxPorts = 64;

double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// A descriptor that is closed with its owner.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  ~Descriptor() { reset(); }
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    reset();
    number_ = std::exchange(other.number_, -1);
    return *this;
  }
  int get() const { return number_; }
  explicit operator bool() const { return number_ >= 0; }

 private:
  void reset() {
    if (number_ >= 0) ::close(number_);
    number_ = -1;
  }
  int number_;
};

struct Line {
  double loss = 0.0, duplicate = 0.0, reorder = 0.0;  // shares, 0 to 1
  double delay_s = 0.0, jitter_s = 0.0;
  double bytes_per_s = 0.0;  // 0: no limit
};

struct Statistics {
  std::uint64_t in = 0, out = 0, lost = 0, duplicated = 0, reordered = 0, cut = 0, overrun = 0;
};

struct Port {
  Descriptor device;
  bool is_cut = false, is_mute = false;
  double free_at_s = 0.0;  // when the last frame of its queue has left, with a bandwidth
};

struct Frame {
  double due_s;
  std::uint64_t order;  // of frames that are due at once
  std::size_t to;
  std::string data;
  bool operator<(const Frame& other) const {
    return due_s != other.due_s ? due_s > other.due_s : order > other.order;  // the first on top of the queue
  }
};

// The device eth0 in the namespace; this process is in its own again afterwards.
Descriptor make_device(const std::string& network_namespace, std::string& problem) {
  const Descriptor home(::open("/proc/self/ns/net", O_RDONLY | O_CLOEXEC));
  const Descriptor there(::open(network_namespace.c_str(), O_RDONLY | O_CLOEXEC));
  if (!home || !there || ::setns(there.get(), CLONE_NEWNET) != 0) {
    problem = "expected a network namespace, found " + network_namespace + ": " + std::strerror(errno);
    return Descriptor();
  }
  Descriptor device(::open("/dev/net/tun", O_RDWR | O_NONBLOCK | O_CLOEXEC));
  ifreq request{};
  request.ifr_flags = IFF_TAP | IFF_NO_PI;
  std::strcpy(request.ifr_name, "eth0");
  if (!device || ::ioctl(device.get(), TUNSETIFF, &request) != 0) {
    problem = std::string("expected a TAP device eth0 to be made: ") + std::strerror(errno);
    device = Descriptor();
  }
  if (::setns(home.get(), CLONE_NEWNET) != 0) {
    std::perror("wire: expected to come back from a network namespace");
    std::exit(1);
  }
  return device;
}

class Wire {
 public:
  Wire(std::size_t ports, std::uint64_t seed) : ports_(ports), random_(seed) {}

  // Until the end of the input.
  int run() {
    for (;;) {
      std::vector<pollfd> polled{{STDIN_FILENO, POLLIN, 0}};
      std::vector<std::size_t> polled_ports;
      for (std::size_t i = 0; i < ports_.size(); ++i) {
        if (!ports_[i].device) continue;
        polled.push_back({ports_[i].device.get(), POLLIN, 0});
        polled_ports.push_back(i);
      }
      const double sleep_s = waiting_.empty() ? kIdle_s : std::clamp(waiting_.top().due_s - now_s(), 0.0, kIdle_s);
      const auto sleep_ns = static_cast<long>(sleep_s * 1e9);
      const timespec sleep{sleep_ns / 1'000'000'000, sleep_ns % 1'000'000'000};
      ::ppoll(polled.data(), polled.size(), &sleep, nullptr);
      if (polled[0].revents != 0 && !read_commands()) return 0;
      for (std::size_t i = 0; i < polled_ports.size(); ++i) {
        if (polled[i + 1].revents != 0) take(polled_ports[i]);
      }
      send_due();
    }
  }

 private:
  // False at the end of the input.
  bool read_commands() {
    std::array<char, 4096> text;
    const auto length = ::read(STDIN_FILENO, text.data(), text.size());
    if (length <= 0) return length < 0 && errno == EINTR;
    unread_.append(text.data(), static_cast<std::size_t>(length));
    for (std::size_t end; (end = unread_.find('\n')) != std::string::npos; unread_.erase(0, end + 1)) {
      std::printf("%s\n", obey(unread_.substr(0, end)).c_str());
      std::fflush(stdout);
    }
    return true;
  }

  std::string obey(const std::string& command) {
    std::istringstream words(command);
    std::string word;
    words >> word;
    if (word == "statistics") return statistics();
    for (const char* of_a_port : {"plug", "unplug", "cut", "mute", "heal"})
      if (word == of_a_port) return obey_for_port(word, words);
    double value = 0.0, jitter_ms = 0.0;
    if (!(words >> value) || value < 0.0)
      return "error: expected a command and a number of 0 or more, found " + command;
    if (word == "loss") {
      line_.loss = value / 100.0;
    } else if (word == "duplicate") {
      line_.duplicate = value / 100.0;
    } else if (word == "reorder") {
      line_.reorder = value / 100.0;
    } else if (word == "delay" && words >> jitter_ms && jitter_ms >= 0.0) {
      line_.delay_s = value * 1e-3;
      line_.jitter_s = jitter_ms * 1e-3;
    } else if (word == "bandwidth") {
      line_.bytes_per_s = value * 1e3 / 8.0;
    } else {
      return "error: expected a command, found " + command;
    }
    return "ok";
  }

  std::string obey_for_port(const std::string& word, std::istringstream& words) {
    std::size_t number = 0;
    if (!(words >> number) || number < 1 || number > ports_.size()) {
      return "error: expected a port from 1 to " + std::to_string(ports_.size());
    }
    Port& port = ports_[number - 1];
    if (word == "cut" || word == "mute" || word == "heal") {
      port.is_cut = word == "cut";
      port.is_mute = word == "mute";
      return "ok";
    }
    port.device = Descriptor();  // the name eth0 is free before the next is made
    if (word == "unplug") return "ok";
    std::string network_namespace, problem;
    words >> network_namespace;
    port.device = make_device(network_namespace, problem);
    return port.device ? "ok" : "error: " + problem;
  }

  std::string statistics() const {
    std::ostringstream text;
    text << "ok in " << counted_.in << " out " << counted_.out << " lost " << counted_.lost << " duplicated "
         << counted_.duplicated << " reordered " << counted_.reordered << " cut " << counted_.cut << " overrun "
         << counted_.overrun;
    return text.str();
  }

  // Frames that a host sent. A device whose namespace has gone is closed.
  void take(std::size_t from) {
    std::array<char, kFrame> bytes;
    for (int i = 0; i < kMaxFrames; ++i) {
      const auto length = ::read(ports_[from].device.get(), bytes.data(), bytes.size());
      if (length < 0 && errno != EAGAIN && errno != EINTR && errno != EIO) ports_[from].device = Descriptor();
      if (length < static_cast<ssize_t>(2 * kAddress)) return;
      counted_.in++;
      pass_on(from, std::string(bytes.data(), static_cast<std::size_t>(length)));
    }
  }

  // To the port of its target, or to all: broadcast, or a target that has never sent.
  void pass_on(std::size_t from, const std::string& frame) {
    port_of_[frame.substr(kAddress, kAddress)] = from;
    const auto target = port_of_.find(frame.substr(0, kAddress));
    for (std::size_t to = 0; to < ports_.size(); ++to) {
      if (to == from || !ports_[to].device || (target != port_of_.end() && target->second != to)) continue;
      if (ports_[from].is_cut || ports_[to].is_cut) {
        counted_.cut++;
      } else if (happens(line_.loss) || ((ports_[from].is_mute || ports_[to].is_mute) && is_data(frame))) {
        counted_.lost++;
      } else {
        queue(to, frame);
        if (!happens(line_.duplicate)) continue;
        counted_.duplicated++;
        queue(to, frame);
      }
    }
  }

  void queue(std::size_t to, const std::string& frame) {
    const double now = now_s();
    double due = now + std::max(0.0, line_.delay_s + line_.jitter_s * (2.0 * uniform() - 1.0));
    if (happens(line_.reorder)) {
      counted_.reordered++;
      due += line_.delay_s + kReorderedBy_s;
    }
    if (line_.bytes_per_s > 0.0) {
      double& free_at = ports_[to].free_at_s;
      if (free_at - now > kMaxQueue_s) {
        counted_.overrun++;
        return;
      }
      free_at = std::max(free_at, now) + static_cast<double>(frame.size()) / line_.bytes_per_s;
      due += free_at - now;
    }
    waiting_.push({due, order_++, to, frame});
  }

  void send_due() {
    for (const double now = now_s(); !waiting_.empty() && waiting_.top().due_s <= now; waiting_.pop()) {
      const Frame& frame = waiting_.top();
      const Port& port = ports_[frame.to];
      if (port.is_cut) {
        counted_.cut++;
      } else if (port.device && ::write(port.device.get(), frame.data.data(), frame.data.size()) > 0) {
        counted_.out++;
      }
    }
  }

  // UDP over IPv4 to an odd port: discovery has even ones (DDSI-RTPS 2.2, section 9.6.1).
  static bool is_data(const std::string& frame) {
    constexpr std::size_t kHeader = 14;
    if (frame.size() < kHeader + 20 || frame[kHeader - 2] != 8 || frame[kHeader + 9] != 17) return false;
    const std::size_t port = kHeader + 4U * (static_cast<unsigned>(frame[kHeader]) & 15U) + 3;
    return port < frame.size() && (static_cast<unsigned>(frame[port]) & 1U) != 0;
  }

  double uniform() { return std::uniform_real_distribution<>(0.0, 1.0)(random_); }
  bool happens(double share) { return share > 0.0 && uniform() < share; }

  std::vector<Port> ports_;
  Line line_;
  Statistics counted_;
  std::mt19937_64 random_;
  std::priority_queue<Frame> waiting_;
  std::map<std::string, std::size_t> port_of_;  // by Ethernet address
  std::uint64_t order_ = 0;
  std::string unread_;
};

// A whole number from least to most; nothing for anything else.
std::optional<unsigned long> number(const char* text, unsigned long least, unsigned long most) {
  unsigned long value = 0;
  const char* const end = text + std::strlen(text);
  const auto [stop, error] = std::from_chars(text, end, value);
  if (error != std::errc() || stop != end || value < least || value > most) return std::nullopt;
  return value;
}

}  // namespace

int main(int argc, char** argv) {
  const auto ports = argc > 1 ? number(argv[1], 1, kMaxPorts) : std::nullopt;
  const auto seed = argc > 2 ? number(argv[2], 0, ~0UL) : 1UL;
  if (!ports || !seed || argc > 3) {
    std::fprintf(stderr, "usage: wire PORTS [SEED]: expected 1 to %lu ports and a whole number\n", kMaxPorts);
    return 2;
  }
  return Wire(*ports, *seed).run();
}
