#include "inputmonitor/device_source.hpp"

#include <fcntl.h>
#include <linux/input.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "lib/text/plain_text.hpp"

namespace yars::inputmonitor {

namespace {

using error::fail;

constexpr const char* kFindDevice = "find the device in /dev/input/by-id; sticks end with -event-joystick";
constexpr std::string_view kDeviceName = "event";  // device nodes are named /dev/input/eventN

// Reads a bit set of the kernel by ioctl. On an error no bit is set. Assumes a little-endian machine.
template <std::size_t Bits>
std::bitset<Bits> bits_of(int descriptor, unsigned long request) {
  std::array<std::uint8_t, (Bits + 7) / 8 + 8> bytes{};
  std::bitset<Bits> bits;
  if (ioctl(descriptor, request, bytes.data()) < 0) return bits;
  for (std::size_t i = 0; i < Bits; ++i) bits.set(i, (bytes[i / 8] >> (i % 8) & 1U) != 0);
  return bits;
}

DeviceInfo info_of(int descriptor) {
  DeviceInfo info;
  input_id identity{};
  if (ioctl(descriptor, EVIOCGID, &identity) < 0) return info;
  info.known = true;
  info.vendor = identity.vendor;
  info.product = identity.product;
  std::array<char, 256> name{};
  if (ioctl(descriptor, EVIOCGNAME(name.size() - 1), name.data()) >= 0) info.name = name.data();
  info.buttons = bits_of<KEY_CNT>(descriptor, EVIOCGBIT(EV_KEY, (KEY_CNT + 7) / 8));
  const auto axes = bits_of<ABS_CNT>(descriptor, EVIOCGBIT(EV_ABS, (ABS_CNT + 7) / 8));
  for (std::size_t code = 0; code < ABS_CNT; ++code) {
    input_absinfo axis{};
    if (!axes.test(code) || ioctl(descriptor, EVIOCGABS(code), &axis) < 0) continue;
    info.axes[code] = AxisRange{axis.minimum, axis.maximum};
  }
  return info;
}

}  // namespace

error::Expected<std::unique_ptr<DeviceReader>> DeviceReader::open(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) {
    const int code = errno;
    return fail(path.string(), "an input device that can be read", error::reason_of(code),
                code == EACCES   ? kDevicePermission
                : code == ENOENT ? kFindDevice
                                 : "");
  }
  std::unique_ptr<DeviceReader> reader(new DeviceReader(descriptor));
  struct stat status{};
  fstat(descriptor, &status);
  reader->is_file_ = S_ISREG(status.st_mode);
  if (S_ISCHR(status.st_mode)) reader->info_ = info_of(descriptor);
  if (reader->is_file_ || S_ISFIFO(status.st_mode) || reader->info_.known) return reader;
  return fail(path.string(), "an input device, a FIFO or a file of struct input_event", "another kind of file",
              kFindDevice);
}

DeviceReader::~DeviceReader() {
  close(descriptor_);
}

std::optional<DeviceState> DeviceReader::state() const {
  if (!info_.known) return std::nullopt;
  DeviceState state;
  state.buttons = bits_of<KEY_CNT>(descriptor_, EVIOCGKEY((KEY_CNT + 7) / 8));
  for (std::size_t code = 0; code < ABS_CNT; ++code) {
    input_absinfo axis{};
    if (!info_.axes[code] || ioctl(descriptor_, EVIOCGABS(code), &axis) < 0) continue;
    state.axes.emplace_back(static_cast<std::uint16_t>(code), axis.value);
  }
  return state;
}

DeviceReader::Outcome DeviceReader::read(std::span<std::byte> bytes, std::size_t& count) {
  count = 0;
  pollfd wanted{descriptor_, POLLIN, 0};
  // poll() distinguishes a FIFO that has had no writer yet from one that its writer has closed; read() returns 0 for
  // both. Without POLLIN the event is POLLHUP or POLLERR: the writer has closed the FIFO, or the device is unplugged.
  if (poll(&wanted, 1, 0) <= 0) return Outcome::nothing;
  if ((wanted.revents & POLLIN) == 0) return Outcome::gone;
  const ssize_t found = ::read(descriptor_, bytes.data(), bytes.size());
  if (found < 0) return errno == EAGAIN || errno == EINTR ? Outcome::nothing : Outcome::gone;
  count = static_cast<std::size_t>(found);
  return found == 0 ? Outcome::gone : Outcome::some;
}

bool DeviceReader::is_at(const std::filesystem::path& path) const {
  struct stat opened{};
  struct stat present{};
  return fstat(descriptor_, &opened) == 0 && stat(path.c_str(), &present) == 0 && opened.st_dev == present.st_dev &&
         opened.st_ino == present.st_ino;
}

std::vector<std::filesystem::path> device_paths(const std::filesystem::path& folder) {
  std::vector<std::pair<int, std::filesystem::path>> found;
  std::error_code problem;
  for (std::filesystem::directory_iterator entry(folder, problem), end; !problem && entry != end;
       entry.increment(problem)) {
    const std::string name = entry->path().filename().string();
    if (!name.starts_with(kDeviceName)) continue;
    const auto number = text::whole_number<int>(std::string_view(name).substr(kDeviceName.size()));
    if (number) found.emplace_back(*number, entry->path());
  }
  std::ranges::sort(found);
  std::vector<std::filesystem::path> paths;
  paths.reserve(found.size());
  for (auto& [number, path] : found) paths.push_back(std::move(path));
  return paths;
}

namespace {

using databuffer::InputEvent;
using error::Expected;

// [bytes] Limit of one take(): 128 events, more than a device reports in 10 ms.
constexpr std::size_t kMaxBytes = 128 * kRecordBytes;

Expected<const radar::Device*> map_for(const DeviceInfo& info, const std::string& path, const std::string& name,
                                       const std::vector<radar::Device>& maps) {
  if (!name.empty()) {
    if (const auto* map = named_map(name, maps)) return map;
    return fail(path, "a map with the name \"" + name + "\"", "none", "see config/devices.guf, or give --config");
  }
  if (const auto* map = fitting_map(info, maps)) return map;
  if (info.known)
    return fail(path, "a map for it", "none for \"" + info.name + '"',
                "name one (evdev:PATH,NAME) or make one: input-monitor --learn " + path + " --out FILE");
  if (maps.size() == 1) return &maps.front();
  return fail(path, "the name of a map, as evdev:PATH,NAME", "none; a FIFO or file has no name and no ids",
              "config/devices.guf and the file of --config have the names");
}

}  // namespace

DeviceSource::DeviceSource(std::filesystem::path path, std::string map_name, DeviceMaps maps)
    : path_(std::move(path)), map_name_(std::move(map_name)), maps_(std::move(maps)) {}

Expected<std::unique_ptr<DeviceSource>> DeviceSource::create(std::filesystem::path path, std::string map_name,
                                                             DeviceMaps maps) {
  std::unique_ptr<DeviceSource> source(new DeviceSource(std::move(path), std::move(map_name), std::move(maps)));
  std::error_code problem;
  if (!std::filesystem::exists(source->path_, problem) && !problem) {
    source->last_problem_ = "absent";
    source->notices_.push_back({true, source->path_.string() + " is missing; input-monitor waits for it"});
    // A wrong map name is an error even while the device is absent.
    if (!source->map_name_.empty() && named_map(source->map_name_, *source->maps_) == nullptr)
      return tl::unexpected(map_for({}, source->path_.string(), source->map_name_, *source->maps_).error());
    return source;
  }
  if (auto connected = source->connect(); !connected) return tl::unexpected(connected.error());
  return source;
}

Expected<void> DeviceSource::connect() {
  auto reader = DeviceReader::open(path_);
  if (!reader) return tl::unexpected(reader.error());
  const DeviceInfo& info = (*reader)->info();
  const auto map = map_for(info, path_.string(), map_name_, *maps_);
  if (!map) return tl::unexpected(map.error());
  auto ready = resolve_map(**map, info);
  if (!ready)
    return fail(path_.string() + ", map " + (*map)->name, "a map that fits the device", ready.error().message());
  decoder_.emplace(std::move(*ready));
  dropped_ = 0;
  reader_ = std::move(*reader);
  stream_.restart();
  if (const auto state = reader_->state()) decoder_->begin(*state);
  notices_.push_back(
      {false, path_.string() + (info.known ? " (" + info.name + ")" : "") + " uses the map " + (*map)->name});
  last_problem_.clear();
  return {};
}

bool DeviceSource::add_descriptors(std::vector<pollfd>& wanted) const {
  if (reader_) wanted.push_back({reader_->descriptor(), POLLIN, 0});
  return true;
}

std::optional<std::int64_t> DeviceSource::deadline_ns() const {
  if (played_) return std::nullopt;
  const auto due_ns = decoder_ ? decoder_->deadline_ns() : std::nullopt;
  return std::min(due_ns.value_or(next_check_ns_), next_check_ns_);
}

std::vector<InputEvent> DeviceSource::take(const Moment& moment) {
  if (moment.monotonic_ns >= next_check_ns_ && !played_) {
    check_path();
    next_check_ns_ = moment.monotonic_ns + kCheckInterval_ns;
  }
  std::vector<InputEvent> events = std::exchange(releases_, {});
  if (reader_) read_some(moment.monotonic_ns);
  events.insert(events.end(), releases_.begin(), releases_.end());
  releases_.clear();
  if (!decoder_) return events;
  const auto more = decoder_->take(moment.monotonic_ns);
  events.insert(events.end(), more.begin(), more.end());
  return events;
}

std::vector<InputEvent> DeviceSource::release() {
  if (!decoder_) return {};
  auto events = decoder_->take(0);
  decoder_->release_all();
  const auto more = decoder_->take(0);
  events.insert(events.end(), more.begin(), more.end());
  return events;
}

void DeviceSource::check_path() {
  if (reader_ && !reader_->is_at(path_)) disconnect("was removed or replaced");
  if (decoder_) report_dropped();
  if (reader_) return;
  const auto connected = connect();
  if (connected) return;
  std::error_code problem;
  const bool absent = !std::filesystem::exists(path_, problem);
  const std::string issue = absent ? "absent" : connected.error().message();
  if (issue != last_problem_ && !absent) notices_.push_back({true, issue});
  last_problem_ = issue;
}

void DeviceSource::read_some(std::int64_t now_ns) {
  std::array<std::byte, kMaxBytes> bytes;
  std::size_t count = 0;
  const auto outcome = reader_->read(bytes, count);
  for (const RawEvent& raw : stream_.feed({bytes.data(), count})) {
    decoder_->feed(raw, now_ns);
    if (!decoder_->needs_resync()) continue;
    ++losses_;
    const auto state = reader_->state();
    decoder_->resync(state, now_ns);
    // The remaining events of this read are ignored, because `state` is newer.
    if (state) break;
  }
  if (outcome == DeviceReader::Outcome::gone)
    disconnect(reader_->plays_once() ? "was read to its end" : "is disconnected");
}

void DeviceSource::disconnect(const std::string& why) {
  report_dropped();
  releases_ = release();
  played_ = reader_->plays_once();
  notices_.push_back({!played_, path_.string() + ' ' + why + (played_ ? "" : "; input-monitor waits for it")});
  last_problem_ = "absent";
  reader_.reset();
  decoder_.reset();
}

void DeviceSource::report_dropped() {
  if (losses_ > 0) notices_.push_back({true, path_.string() + " lost events, " + std::to_string(losses_) + " times"});
  losses_ = 0;
  if (decoder_->dropped() == dropped_) return;
  notices_.push_back({true, path_.string() + ": " + std::to_string(decoder_->dropped() - dropped_) +
                                " presses dropped; the limit is 100 per second"});
  dropped_ = decoder_->dropped();
}

std::string DeviceSource::description() const {
  return path_.string() + (map_name_.empty() ? "" : " with the map " + map_name_);
}

}  // namespace yars::inputmonitor
