#include "inputmonitor/source_choice.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <iterator>

#include "inputmonitor/device_source.hpp"
#include "inputmonitor/event_source.hpp"
#include "inputmonitor/keyboard_source.hpp"
#include "inputmonitor/tour.hpp"
#include "lib/file/text_file.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::inputmonitor {

namespace {

using databuffer::InputEvent;

template <class T>
void append(std::vector<T>& to, std::vector<T> more) {
  to.insert(to.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

// True if both paths name the same file. std::filesystem::equivalent cannot be used: it fails for device nodes.
bool is_same_node(const std::filesystem::path& one, const std::filesystem::path& other) {
  struct stat first{};
  struct stat second{};
  return stat(one.c_str(), &first) == 0 && stat(other.c_str(), &second) == 0 && first.st_dev == second.st_dev &&
         first.st_ino == second.st_ino;
}

}  // namespace

FoundDevicesSource::FoundDevicesSource(std::filesystem::path folder, DeviceMaps maps,
                                       std::vector<std::filesystem::path> excluded)
    : folder_(std::move(folder)), maps_(std::move(maps)), excluded_(std::move(excluded)) {
  scan_folder();
}

bool FoundDevicesSource::add_descriptors(std::vector<pollfd>& wanted) const {
  for (const auto& device : devices_) device->add_descriptors(wanted);
  return true;
}

std::optional<std::int64_t> FoundDevicesSource::deadline_ns() const {
  std::int64_t due_ns = next_scan_ns_;
  for (const auto& device : devices_) due_ns = std::min(due_ns, device->deadline_ns().value_or(due_ns));
  return due_ns;
}

std::vector<InputEvent> FoundDevicesSource::take(const Moment& moment) {
  if (moment.monotonic_ns >= next_scan_ns_) {
    scan_folder();
    next_scan_ns_ = moment.monotonic_ns + kScanInterval_ns;
  }
  std::vector<InputEvent> events;
  for (const auto& device : devices_) {
    append(events, device->take(moment));
    append(notices_, device->notices());
    // The next search tries this path again, even if its node has not changed.
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

std::vector<Notice> FoundDevicesSource::notices() {
  for (const auto& device : devices_) append(notices_, device->notices());
  return std::exchange(notices_, {});
}

std::string FoundDevicesSource::description() const {
  return "devices of " + folder_.string() +
         " that have a map: " + (devices_.empty() ? "none yet" : std::to_string(devices_.size()));
}

void FoundDevicesSource::scan_folder() {
  for (const auto& path : device_paths(folder_)) {
    struct stat status{};
    if (stat(path.c_str(), &status) != 0) continue;
    const Node node{status.st_ino, status.st_ctim.tv_sec * 1'000'000'000LL + status.st_ctim.tv_nsec};
    const auto [entry, is_new] = seen_.try_emplace(path, node);
    if (!is_new && entry->second == node) continue;
    entry->second = node;
    const auto is_this = [&path](const auto& device) { return device->path() == path; };
    if (std::ranges::none_of(devices_, is_this)) try_device(path);
  }
}

void FoundDevicesSource::try_device(const std::filesystem::path& path) {
  if (std::ranges::any_of(excluded_, [&path](const auto& other) { return is_same_node(path, other); })) return;
  if (access(path.c_str(), R_OK) != 0) {
    // Not a warning: unreadable nodes are usually keyboards and mice.
    if (!permission_reported_)
      notices_.push_back({false, path.string() + " and perhaps others cannot be read; if one is a panel of yours, " +
                                     kDevicePermission});
    permission_reported_ = true;
    return;
  }
  // Errors are ignored: most nodes are keyboards and lid switches, which have no map.
  auto device = DeviceSource::create(path, {}, maps_);
  if (device) devices_.push_back(std::move(*device));
}

namespace {

using error::Expected;
using SourcePointer = std::unique_ptr<EventSource>;

constexpr std::string_view kScript = "script:";
constexpr std::string_view kTour = "tour:";
constexpr std::string_view kForPilot = ",pilot";  // behind the file of a tour
constexpr std::string_view kDevice = "evdev:";

// Source without events, for a system with neither a display nor a terminal, such as a container.
class IdleSource final : public EventSource {
 public:
  std::vector<databuffer::InputEvent> take(const Moment&) override { return {}; }
  std::vector<databuffer::InputEvent> release() override { return {}; }
  bool ended() const override { return false; }
  bool follows_sim_time() const override { return false; }
  std::string description() const override {
    return "no keyboard: neither a window nor a terminal can be opened (yars inject sends events)";
  }
};

bool display_is_named() {
  constexpr std::array kVariables{"DISPLAY", "WAYLAND_DISPLAY"};
  return std::ranges::any_of(kVariables, [](const char* name) {
    const char* value = std::getenv(name);
    return value != nullptr && *value != '\0';
  });
}

Expected<SourcePointer> open_script(const std::string& file) {
  const auto text = file::read_text_file(file);
  if (!text) return tl::unexpected(text.error());
  auto script = parse_script(*text, file);
  if (!script) return tl::unexpected(script.error());
  return std::make_unique<ScriptSource>(std::move(*script), file);
}

Expected<SourcePointer> open_tour(const std::string& file, bool for_pilot) {
  const auto text = file::read_text_file(file);
  if (!text) return tl::unexpected(text.error());
  auto tour = parse_tour(*text, file);
  if (!tour) return tl::unexpected(tour.error());
  return std::make_unique<TourSource>(std::move(*tour), file, for_pilot);
}

// A window if one can be opened, else the terminal if there is one, else nullptr.
SourcePointer open_keyboard(const std::string& session) {
  if (display_is_named()) {
    // If this fails, the terminal is tried.
    if (auto window = open_window_source(session)) return std::move(*window);
  }
  if (is_foreground_terminal(STDIN_FILENO))
    if (auto terminal = open_terminal_source()) return std::move(*terminal);
  return nullptr;
}

// The source of `auto`: a keyboard (window or terminal), and all devices with a map.
SourcePointer open_automatic(const SourceContext& context, const std::vector<SourceChoice>& all) {
  std::vector<std::filesystem::path> excluded;
  for (const SourceChoice& choice : all)
    if (choice.kind == SourceKind::device) excluded.emplace_back(choice.file);
  std::vector<SourcePointer> sources;
  if (auto keyboard = open_keyboard(context.session)) sources.push_back(std::move(keyboard));
  auto devices = std::make_unique<FoundDevicesSource>(context.device_folder, context.maps, std::move(excluded));
  if (sources.empty()) sources.push_back(std::make_unique<IdleSource>());
  sources.push_back(std::move(devices));
  return std::make_unique<SourceGroup>(std::move(sources));
}

// True for the path of something that exists. Such a path is never split at a comma.
bool exists(std::string_view path) {
  struct stat status{};
  return ::stat(std::string(path).c_str(), &status) == 0;
}

// Splits FILE[,pilot].
SourceChoice tour_choice(std::string_view text) {
  SourceChoice choice{SourceKind::tour, {}, {}};
  choice.for_pilot = text.ends_with(kForPilot) && !exists(text);
  if (choice.for_pilot) text.remove_suffix(kForPilot.size());
  choice.file = text;
  return choice;
}

// Splits PATH[,NAME] at the last comma. A comma before a slash is part of PATH, because NAME contains no slash.
SourceChoice device_choice(std::string_view text) {
  const std::size_t comma = text.rfind(',');
  if (comma == std::string_view::npos || text.find('/', comma) != std::string_view::npos || exists(text))
    return {SourceKind::device, std::string(text), {}};
  return {SourceKind::device, std::string(text.substr(0, comma)), std::string(text.substr(comma + 1))};
}

Expected<SourcePointer> open_one(const SourceChoice& choice, const std::vector<SourceChoice>& all,
                                 const SourceContext& context) {
  switch (choice.kind) {
    case SourceKind::window:
      return open_window_source(context.session);
    case SourceKind::terminal:
      return open_terminal_source();
    case SourceKind::script:
      return open_script(choice.file);
    case SourceKind::tour:
      return open_tour(choice.file, choice.for_pilot);
    case SourceKind::device: {
      auto device = DeviceSource::create(choice.file, choice.map_name, context.maps);
      if (!device) return tl::unexpected(device.error());
      return std::move(*device);
    }
    case SourceKind::automatic:
      break;
  }
  return open_automatic(context, all);
}

}  // namespace

Expected<SourceChoice> parse_source(std::string_view text) {
  if (text == "window") return SourceChoice{SourceKind::window, {}, {}};
  if (text == "terminal") return SourceChoice{SourceKind::terminal, {}, {}};
  if (text == "auto") return SourceChoice{SourceKind::automatic, {}, {}};
  if (text.starts_with(kScript) && text.size() > kScript.size())
    return SourceChoice{SourceKind::script, std::string(text.substr(kScript.size())), {}};
  if (text.starts_with(kTour)) {
    const SourceChoice choice = tour_choice(text.substr(kTour.size()));
    if (!choice.file.empty()) return choice;
  }
  if (text.starts_with(kDevice)) {
    const SourceChoice choice = device_choice(text.substr(kDevice.size()));
    if (!choice.file.empty()) return choice;
  }
  static const std::vector<std::string> kKinds{"window", "terminal", "script:", "tour:", "evdev:", "auto"};
  const std::size_t colon = text.find(':');
  const std::string_view kind = text.substr(0, colon == std::string_view::npos ? colon : colon + 1);
  const bool is_known = std::ranges::find(kKinds, kind) != kKinds.end();  // what follows it is missing
  return tl::unexpected(
      error::usage_error("--source", "window, terminal, script:FILE, tour:FILE[,pilot], evdev:PATH[,MAP] or auto",
                         '"' + std::string(text) + '"', is_known ? "" : text::did_you_mean(kind, kKinds)));
}

Expected<SourcePointer> open_sources(const std::vector<SourceChoice>& choices, const SourceContext& context) {
  std::vector<SourcePointer> sources;
  for (const SourceChoice& choice : choices) {
    auto source = open_one(choice, choices, context);
    if (!source) return source;
    sources.push_back(std::move(*source));
  }
  if (sources.size() == 1) return std::move(sources.front());
  return std::make_unique<SourceGroup>(std::move(sources));
}

}  // namespace yars::inputmonitor
