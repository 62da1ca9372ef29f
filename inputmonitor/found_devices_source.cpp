#include "inputmonitor/found_devices_source.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <iterator>

namespace yars::inputmonitor {

namespace {

using databuffer::InputEvent;

template <class T>
void append(std::vector<T>& to, std::vector<T> more) {
  to.insert(to.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

// std::filesystem::equivalent refuses devices.
bool is_same_node(const std::filesystem::path& one, const std::filesystem::path& other) {
  struct stat first {};
  struct stat second {};
  return stat(one.c_str(), &first) == 0 && stat(other.c_str(), &second) == 0 && first.st_dev == second.st_dev &&
         first.st_ino == second.st_ino;
}

}  // namespace

FoundDevicesSource::FoundDevicesSource(std::filesystem::path folder, DeviceMaps maps,
                                       std::vector<std::filesystem::path> others)
    : folder_(std::move(folder)), maps_(std::move(maps)), others_(std::move(others)) {
  look_for_new();
}

bool FoundDevicesSource::add_descriptors(std::vector<pollfd>& wanted) const {
  for (const auto& device : devices_) device->add_descriptors(wanted);
  return true;
}

std::optional<std::int64_t> FoundDevicesSource::deadline_ns() const {
  std::int64_t due_ns = look_again_ns_;
  for (const auto& device : devices_) due_ns = std::min(due_ns, device->deadline_ns().value_or(due_ns));
  return due_ns;
}

std::vector<InputEvent> FoundDevicesSource::take(const Moment& moment) {
  if (moment.monotonic_ns >= look_again_ns_) {
    look_for_new();
    look_again_ns_ = moment.monotonic_ns + kLookForNew_ns;
  }
  std::vector<InputEvent> events;
  for (const auto& device : devices_) {
    append(events, device->take(moment));
    append(news_, device->news());
    // Another device may come by the same name: it has to find a map of its own.
    if (!device->is_open()) seen_.erase(device->path());
  }
  std::erase_if(devices_, [](const auto& device) { return !device->is_open(); });
  return events;
}

std::vector<InputEvent> FoundDevicesSource::release() {
  std::vector<InputEvent> events;
  for (const auto& device : devices_) append(events, device->release());
  return events;
}

std::vector<News> FoundDevicesSource::news() {
  for (const auto& device : devices_) append(news_, device->news());
  return std::exchange(news_, {});
}

std::string FoundDevicesSource::description() const {
  return "devices of " + folder_.string() +
         " that have a map: " + (devices_.empty() ? "none yet" : std::to_string(devices_.size()));
}

void FoundDevicesSource::look_for_new() {
  for (const auto& path : device_paths(folder_)) {
    struct stat status {};
    if (stat(path.c_str(), &status) != 0) continue;
    const Node node{status.st_ino, status.st_ctim.tv_sec * 1'000'000'000LL + status.st_ctim.tv_nsec};
    const auto [place, is_new] = seen_.try_emplace(path, node);
    if (!is_new && place->second == node) continue;
    place->second = node;
    const auto is_this = [&path](const auto& device) { return device->path() == path; };
    if (std::ranges::none_of(devices_, is_this)) try_device(path);
  }
}

void FoundDevicesSource::try_device(const std::filesystem::path& path) {
  if (std::ranges::any_of(others_, [&path](const auto& other) { return is_same_node(path, other); })) return;
  if (access(path.c_str(), R_OK) != 0) {
    // Keyboards and mice are among them as a rule, so that this alone is no trouble.
    if (!told_of_permission_)
      news_.push_back({false, path.string() + " and perhaps others may not be read; if one is a panel of yours, " +
                                  kDevicePermission});
    told_of_permission_ = true;
    return;
  }
  // Most of the folder is keyboards and lids, which have no map.
  auto device = DeviceSource::create(path, {}, maps_);
  if (device) devices_.push_back(std::move(*device));
}

}  // namespace yars::inputmonitor
