#include "inputmonitor/device_reader.hpp"

#include <fcntl.h>
#include <linux/input.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <system_error>

namespace yars::inputmonitor {

namespace {

using failure::fail;

constexpr std::string_view kDeviceName = "event";

// The kernel's bit sets are bytes here; its words are little endian on all machines that YARS builds on.
template <std::size_t Bits>
std::bitset<Bits> bits_of(int descriptor, unsigned long request) {
  std::array<std::uint8_t, (Bits + 7) / 8 + 8> bytes{};
  std::bitset<Bits> bits;
  if (ioctl(descriptor, request, bytes.data()) < 0) return bits;
  for (std::size_t i = 0; i < Bits; ++i) bits.set(i, (bytes[i / 8] >> (i % 8) & 1U) != 0);
  return bits;
}

DeviceFacts facts_of(int descriptor) {
  DeviceFacts facts;
  input_id identity{};
  if (ioctl(descriptor, EVIOCGID, &identity) < 0) return facts;
  facts.known = true;
  facts.vendor = identity.vendor;
  facts.product = identity.product;
  std::array<char, 256> name{};
  if (ioctl(descriptor, EVIOCGNAME(name.size() - 1), name.data()) >= 0) facts.name = name.data();
  facts.buttons = bits_of<KEY_CNT>(descriptor, EVIOCGBIT(EV_KEY, (KEY_CNT + 7) / 8));
  const auto axes = bits_of<ABS_CNT>(descriptor, EVIOCGBIT(EV_ABS, (ABS_CNT + 7) / 8));
  for (std::size_t code = 0; code < ABS_CNT; ++code) {
    input_absinfo axis{};
    if (!axes.test(code) || ioctl(descriptor, EVIOCGABS(code), &axis) < 0) continue;
    facts.axes[code] = AxisRange{axis.minimum, axis.maximum};
  }
  return facts;
}

}  // namespace

failure::Expected<std::unique_ptr<DeviceReader>> DeviceReader::open(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) {
    const std::string why = std::generic_category().message(errno);
    return fail(path.string(), "an input device that may be read", why, errno == EACCES ? kDevicePermission : "");
  }
  std::unique_ptr<DeviceReader> reader(new DeviceReader(descriptor));
  struct stat status {};
  fstat(descriptor, &status);
  reader->is_file_ = S_ISREG(status.st_mode);
  if (S_ISCHR(status.st_mode)) reader->facts_ = facts_of(descriptor);
  if (reader->is_file_ || S_ISFIFO(status.st_mode) || reader->facts_.known) return reader;
  return fail(path.string(), "an input device, a FIFO or a file of struct input_event", "something else",
              "look for the device in /dev/input/by-id");
}

DeviceReader::~DeviceReader() {
  close(descriptor_);
}

std::optional<DeviceState> DeviceReader::state() const {
  if (!facts_.known) return std::nullopt;
  DeviceState state;
  state.buttons = bits_of<KEY_CNT>(descriptor_, EVIOCGKEY((KEY_CNT + 7) / 8));
  for (std::size_t code = 0; code < ABS_CNT; ++code) {
    input_absinfo axis{};
    if (!facts_.axes[code] || ioctl(descriptor_, EVIOCGABS(code), &axis) < 0) continue;
    state.axes.emplace_back(static_cast<std::uint16_t>(code), axis.value);
  }
  return state;
}

DeviceReader::Outcome DeviceReader::read(std::span<std::byte> bytes, std::size_t& count) {
  count = 0;
  pollfd wanted{descriptor_, POLLIN, 0};
  // A FIFO that nobody has opened for writing yet reads as ended; only its hang-up tells that a writer has left.
  if (poll(&wanted, 1, 0) <= 0) return Outcome::nothing;
  if ((wanted.revents & POLLIN) == 0) return Outcome::gone;
  const ssize_t found = ::read(descriptor_, bytes.data(), bytes.size());
  if (found < 0) return errno == EAGAIN || errno == EINTR ? Outcome::nothing : Outcome::gone;
  count = static_cast<std::size_t>(found);
  return found == 0 ? Outcome::gone : Outcome::some;
}

bool DeviceReader::is_at(const std::filesystem::path& path) const {
  struct stat mine {};
  struct stat there {};
  return fstat(descriptor_, &mine) == 0 && stat(path.c_str(), &there) == 0 && mine.st_dev == there.st_dev &&
         mine.st_ino == there.st_ino;
}

std::vector<std::filesystem::path> device_paths(const std::filesystem::path& folder) {
  std::vector<std::pair<int, std::filesystem::path>> found;
  std::error_code problem;
  for (std::filesystem::directory_iterator entry(folder, problem), end; !problem && entry != end;
       entry.increment(problem)) {
    const std::string name = entry->path().filename().string();
    int number = 0;
    if (!name.starts_with(kDeviceName)) continue;
    const auto [stop, wrong] = std::from_chars(name.data() + kDeviceName.size(), name.data() + name.size(), number);
    if (wrong == std::errc{} && stop == name.data() + name.size()) found.emplace_back(number, entry->path());
  }
  std::ranges::sort(found);
  std::vector<std::filesystem::path> paths;
  for (auto& [number, path] : found) paths.push_back(std::move(path));
  return paths;
}

}  // namespace yars::inputmonitor
