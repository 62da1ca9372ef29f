// Faults of files that the set reads, most of them during reading: terrain, scene, configuration. Also damaged
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
  for (char& letter : text) letter = static_cast<char>(set.chance()());
  return text;
}

// radar-model begins anew, so that it reads its files now.
void begin_radar_anew(FaultSet& set) {
  set.kill("radar-model");
  set.mend();
}

// One spoiling after the other in place, while radar-model begins and reads; then the file is as it was.
void spoil_while_read(FaultSet& set, const std::filesystem::path& path) {
  const std::string whole = text_of(path);
  const std::vector<std::function<void()>> spoilings{
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
  spoilings[set.below(spoilings.size())]();
  begin_radar_anew(set);
  for (int i = 0; i < 6; ++i) {
    set.rest_ms(0.0, 60.0);
    spoilings[set.below(spoilings.size())]();
  }
  write_text(path, whole);
  // What it could not read it counts as void for its lifetime.
  begin_radar_anew(set);
}

void spoil_terrain(FaultSet& set, const std::string&) {
  spoil_while_read(set, set.cell());
}

void spoil_scene(FaultSet& set, const std::string&) {
  spoil_while_read(set, set.scene());
}

// The folder goes under the running set, and while radar-model begins; it says so and ends, or flies on what it has.
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
  // Cells that it looked for meanwhile are void for its lifetime.
  if (!starts_without) begin_radar_anew(set);
}

// A mount that forbids writing, as a medium is; without root the folder's permissions.
void terrain_read_only(FaultSet& set, const std::string&) {
  const char* folder = set.terrain().c_str();
  const bool mounted = set.alone_in_memory() && mount(folder, folder, nullptr, MS_BIND, nullptr) == 0 &&
                       mount(nullptr, folder, nullptr, MS_REMOUNT | MS_BIND | MS_RDONLY, nullptr) == 0;
  if (!mounted) std::filesystem::permissions(set.terrain(), std::filesystem::perms(0500));
  begin_radar_anew(set);
  set.rest_ms(50.0, 300.0);
  // Its files may still be open.
  if (mounted) umount2(folder, MNT_DETACH);
  std::filesystem::permissions(set.terrain(), std::filesystem::perms(0700));
}

// Running roles have read theirs; one that begins says what is wrong and where, and ends.
void configuration_replaced(FaultSet& set, const std::string&) {
  const std::string whole = text_of(set.configuration());
  write_text(set.configuration(), set.below(2) == 0 ? garbage(set, 300) : "( Apg70 :ranges ( 10 \n");
  // Those that read one; flight-model and recorder do not.
  const std::vector<std::string> readers{"state-machine", "radar-model", "radar-display", "input-monitor"};
  const auto& role = readers[set.below(readers.size())];
  set.may_fail(role);
  set.kill(role);
  set.mend();
  if (!eventually([&] { return !set.processes().runs(role); }, 20.0))
    set.tell(role + " starts with a configuration that nobody can read");
  if (set.processes().log_of(role).find(set.configuration().string()) == std::string::npos)
    set.tell(role + " does not name the configuration that it cannot read");
  write_text(set.configuration(), whole);
}

// The set's own recording so far: cut off, or with bytes changed. Refused in a line, or played as far as it is good.
void spoiled_recording(FaultSet& set, const std::string&) {
  std::string recording = text_of(set.processes().folder() / "recording");
  if (recording.empty()) return;
  constexpr std::size_t kMost = 300'000;
  recording.resize(std::min(recording.size(), kMost));
  if (set.below(2) == 0) recording.resize(set.below(recording.size()));
  for (std::size_t i = 0; i < 8 && !recording.empty(); ++i)
    recording[set.below(recording.size())] = static_cast<char>(set.chance()());
  if (set.below(4) == 0) recording = garbage(set, 5000);
  const auto path = set.processes().folder() / "spoiled";
  write_text(path, recording);
  for (const auto* way : {"--print", "--events"}) {
    const auto finished = set.other({"yars", "replay", way, path.string()});
    if (finished.code != 0 && finished.code != 1)
      set.tell(std::string("yars replay ") + way + " ended with code " + std::to_string(finished.code) + ": " +
               finished.errors);
    if (finished.code == 1 && finished.errors.empty() && finished.output.empty())
      set.tell(std::string("yars replay ") + way + " says nothing of a spoiled recording");
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
