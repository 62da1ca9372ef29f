// Faults of the files that the set reads, most of them while it reads: terrain, scene, configuration. Also damaged
// recordings for `yars replay`.
#include <sys/mount.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <functional>

#include "tests/endtoend/fault_injection/fault_set.hpp"
#include "tests/endtoend/fault_injection/faults.hpp"

namespace yars::endtoend::fault_injection {

namespace {

std::string garbage(FaultSet& set, std::size_t bytes) {
  std::string text(bytes, '\0');
  for (char& byte : text) byte = static_cast<char>(set.chance()());
  return text;
}

// Restarts radar-model, so that it reads its files again.
void restart_radar_model(FaultSet& set) {
  set.kill("radar-model");
  set.mend();
}

// Changes the file seven times at random, most of them while radar-model starts and reads it. Then restores the file.
void spoil_while_read(FaultSet& set, const std::filesystem::path& path) {
  const std::string whole = text_of(path);
  const std::vector<std::function<void()>> alterations{
      [&] { write_text(path, garbage(set, whole.size())); },
      [&] { write_text(path, garbage(set, set.below(5000))); },
      [&] { std::filesystem::resize_file(path, set.below(whole.size())); },
      [&] { std::filesystem::resize_file(path, 0); },
      [&] {
        auto changed = whole;
        for (int i = 0; i < 20; ++i) changed[set.below(changed.size())] = static_cast<char>(set.chance()());
        write_text(path, changed);
      },
      [&] {
        write_text(path.string() + ".new", whole);
        std::filesystem::rename(path.string() + ".new", path);
      },
      [&] {
        std::filesystem::remove(path);
        set.rest_ms(0.0, 20.0);
        write_text(path, whole);
      }};
  set.may_fail("radar-model");
  alterations[set.below(alterations.size())]();
  restart_radar_model(set);
  for (int i = 0; i < 6; ++i) {
    set.rest_ms(0.0, 60.0);
    alterations[set.below(alterations.size())]();
  }
  write_text(path, whole);
  // What radar-model could not read stays void or omitted until radar-model is restarted.
  restart_radar_model(set);
}

void spoil_terrain(FaultSet& set, const std::string&) {
  spoil_while_read(set, set.cell());
}

void spoil_scene(FaultSet& set, const std::string&) {
  spoil_while_read(set, set.scene());
}

// Removes the terrain folder for a time. A radar-model that starts without the folder must end with an error. A running
// one continues with the cells in memory.
void terrain_vanishes(FaultSet& set, const std::string&) {
  const auto away = set.terrain().string() + ".away";
  std::filesystem::rename(set.terrain(), away);
  const bool starts_without = set.below(2) == 0;
  if (starts_without) {
    set.may_fail("radar-model");
    set.kill("radar-model");
    set.mend();
    if (!eventually([&] { return !set.processes().runs("radar-model"); }, 20.0))
      set.tell("radar-model starts without its terrain folder");
  } else {
    set.processes().yars({"sim", "reposition", "37.6", "-122.9", "15000", "20"});
    set.rest_ms(50.0, 400.0);
  }
  std::filesystem::rename(away, set.terrain());
  // Cells that radar-model did not find stay void until it is restarted.
  if (!starts_without) restart_radar_model(set);
}

// Makes the terrain folder read-only: by a bind mount as root, else by its permissions.
void terrain_read_only(FaultSet& set, const std::string&) {
  const char* folder = set.terrain().c_str();
  const bool mounted = set.alone_in_memory() && mount(folder, folder, nullptr, MS_BIND, nullptr) == 0 &&
                       mount(nullptr, folder, nullptr, MS_REMOUNT | MS_BIND | MS_RDONLY, nullptr) == 0;
  if (!mounted) std::filesystem::permissions(set.terrain(), std::filesystem::perms(0500));
  restart_radar_model(set);
  set.rest_ms(50.0, 300.0);
  // MNT_DETACH, because radar-model may still have files open there.
  if (mounted) umount2(folder, MNT_DETACH);
  std::filesystem::permissions(set.terrain(), std::filesystem::perms(0700));
}

// Running roles have already read the configuration. A role that starts must name the unreadable file and end.
void configuration_replaced(FaultSet& set, const std::string&) {
  const std::string whole = text_of(set.configuration());
  write_text(set.configuration(), set.below(2) == 0 ? garbage(set, 300) : "( Apg70 :ranges ( 10 \n");
  // The roles that read the configuration; flight-model and recorder do not.
  const std::vector<std::string> readers{"state-machine", "radar-model", "radar-display", "input-monitor"};
  const auto& role = readers[set.below(readers.size())];
  set.may_fail(role);
  set.kill(role);
  set.mend();
  if (!eventually([&] { return !set.processes().runs(role); }, 20.0))
    set.tell(role + " starts with an unreadable configuration");
  if (set.processes().log_of(role).find(set.configuration().string()) == std::string::npos)
    set.tell(role + " does not name the unreadable configuration");
  write_text(set.configuration(), whole);
}

// A damaged copy of the set's recording: cut off, with changed bytes, or replaced by garbage. `yars replay` must end
// with code 0, or with code 1 and a message.
void spoiled_recording(FaultSet& set, const std::string&) {
  std::string recording = text_of(set.processes().folder() / "recording");
  if (recording.empty()) return;
  constexpr std::size_t kMaxBytes = 300'000;
  recording.resize(std::min(recording.size(), kMaxBytes));
  if (set.below(2) == 0) recording.resize(set.below(recording.size()));
  for (std::size_t i = 0; i < 8 && !recording.empty(); ++i)
    recording[set.below(recording.size())] = static_cast<char>(set.chance()());
  if (set.below(4) == 0) recording = garbage(set, 5000);
  const auto path = set.processes().folder() / "spoiled";
  write_text(path, recording);
  for (const auto* option : {"--print", "--events"}) {
    const auto finished = set.other({"yars", "replay", option, path.string()});
    if (finished.code != 0 && finished.code != 1)
      set.tell(std::string("yars replay ") + option + " ended with code " + std::to_string(finished.code) + ": " +
               finished.errors);
    if (finished.code == 1 && finished.errors.empty() && finished.output.empty())
      set.tell(std::string("yars replay ") + option + " has no message about a damaged recording");
  }
}

}  // namespace

std::vector<Fault> file_faults() {
  return {{"terrain replaced and cut while read", spoil_terrain},
          {"the terrain folder vanishes and comes back", terrain_vanishes},
          {"a read-only terrain folder", terrain_read_only},
          {"a scene replaced and cut while read", spoil_scene},
          {"the configuration replaced by garbage", configuration_replaced},
          {"a spoiled recording for yars replay", spoiled_recording}};
}

}  // namespace yars::endtoend::fault_injection
