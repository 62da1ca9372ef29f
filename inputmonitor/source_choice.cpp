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
#include "inputmonitor/terminal.hpp"
#include "lib/file/text_file.hpp"

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

namespace {

using error::Expected;
using SourcePointer = std::unique_ptr<EventSource>;

constexpr std::string_view kScript = "script:";
constexpr std::string_view kDevice = "evdev:";

// Nothing to read from: a set in a container without display and terminal runs all the same.
class IdleSource final : public EventSource {
 public:
  std::vector<databuffer::InputEvent> take(const Moment&) override { return {}; }
  std::vector<databuffer::InputEvent> release() override { return {}; }
  bool ended() const override { return false; }
  bool follows_sim_time() const override { return false; }
  std::string description() const override {
    return "no keyboard: there is neither a display nor a terminal (yars inject sends events)";
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

// A window where there is a display, else the terminal where there is one, else nothing.
SourcePointer open_keyboard(const std::string& session) {
  if (display_is_named()) {
    // A display that is named but not there is no reason to give up.
    if (auto window = open_window_source(session)) return std::move(*window);
  }
  if (is_foreground_terminal(STDIN_FILENO))
    if (auto terminal = open_terminal_source()) return std::move(*terminal);
  return nullptr;
}

// The keyboard there is, and every device that has a map.
SourcePointer open_best(const OpeningNeeds& needs, const std::vector<SourceChoice>& all) {
  std::vector<std::filesystem::path> others;
  for (const SourceChoice& choice : all)
    if (choice.kind == SourceKind::device) others.emplace_back(choice.file);
  std::vector<SourcePointer> sources;
  if (auto keyboard = open_keyboard(needs.session)) sources.push_back(std::move(keyboard));
  auto devices = std::make_unique<FoundDevicesSource>(needs.device_folder, needs.maps, std::move(others));
  if (sources.empty()) sources.push_back(std::make_unique<IdleSource>());
  sources.push_back(std::move(devices));
  return std::make_unique<SourceGroup>(std::move(sources));
}

// NAME of PATH,NAME holds no slash, so that a comma in a folder's name does no harm.
SourceChoice device_choice(std::string_view text) {
  const std::size_t comma = text.rfind(',');
  if (comma == std::string_view::npos || text.find('/', comma) != std::string_view::npos)
    return {SourceKind::device, std::string(text), {}};
  return {SourceKind::device, std::string(text.substr(0, comma)), std::string(text.substr(comma + 1))};
}

Expected<SourcePointer> open_one(const SourceChoice& choice, const std::vector<SourceChoice>& all,
                                 const OpeningNeeds& needs) {
  switch (choice.kind) {
    case SourceKind::window:
      return open_window_source(needs.session);
    case SourceKind::terminal:
      return open_terminal_source();
    case SourceKind::script:
      return open_script(choice.file);
    case SourceKind::device: {
      auto device = DeviceSource::create(choice.file, choice.map_name, needs.maps);
      if (!device) return tl::unexpected(device.error());
      return std::move(*device);
    }
    case SourceKind::automatic:
      break;
  }
  return open_best(needs, all);
}

}  // namespace

Expected<SourceChoice> parse_source(std::string_view text) {
  if (text == "window") return SourceChoice{SourceKind::window, {}, {}};
  if (text == "terminal") return SourceChoice{SourceKind::terminal, {}, {}};
  if (text == "auto") return SourceChoice{SourceKind::automatic, {}, {}};
  if (text.starts_with(kScript) && text.size() > kScript.size())
    return SourceChoice{SourceKind::script, std::string(text.substr(kScript.size())), {}};
  if (text.starts_with(kDevice)) {
    const SourceChoice choice = device_choice(text.substr(kDevice.size()));
    if (!choice.file.empty()) return choice;
  }
  return tl::unexpected(error::usage_error("--source", "window, terminal, script:FILE, evdev:PATH[,MAP] or auto",
                                           '"' + std::string(text) + '"'));
}

Expected<SourcePointer> open_sources(const std::vector<SourceChoice>& choices, const OpeningNeeds& needs) {
  std::vector<SourcePointer> sources;
  for (const SourceChoice& choice : choices) {
    auto source = open_one(choice, choices, needs);
    if (!source) return source;
    sources.push_back(std::move(*source));
  }
  if (sources.size() == 1) return std::move(sources.front());
  return std::make_unique<SourceGroup>(std::move(sources));
}

}  // namespace yars::inputmonitor
