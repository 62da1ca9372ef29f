// Fixed numbers and names that records carry: counts, tick, modes, switch positions, points.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace yars::radar {

// Counts that shape records: changing one changes the layout version.
inline constexpr int kMaxSamples = 4096;  // samples of a sweep
inline constexpr int kBezelButtons = 20;
inline constexpr int kMaxPointsDrawn = 8;  // five nearest, the selected one, two spare
inline constexpr std::int64_t kTickNanoseconds =
    5'000'000;  // [ns] of sim time; radar-model and state-machine step by it
inline constexpr double kTickSeconds = 0.005;

// The radar's modes and switch positions, as fixed numbers: records in shared memory carry them.
enum class Power : std::uint8_t { off = 0, standby = 1, operate = 2 };
enum class Mode : std::uint8_t {
  rbm = 0,
  hrm = 1,
  patch = 2,
  beacon = 3,
  pvu = 4,
  air_to_air = 5,
  ranging = 6,
  menu = 7
};
enum class Master : std::uint8_t { air_to_ground = 0, air_to_air = 1, ranging = 2 };
enum class ScanWidth : std::uint8_t { full = 0, half = 1, quarter = 2 };
enum class CursorFunction : std::uint8_t { map = 0, update = 1, cue = 2, target = 3, mark = 4 };
enum class Navigator : std::uint8_t { mission = 0, ins = 1 };
enum class PointKind : std::uint8_t { steer = 0, initial = 1, target = 2, steer_offset = 3, target_offset = 4 };
enum class Recall : std::uint8_t { none = 0, newest = 1, old = 2, store = 3 };

// The words of `yars watch` and of the legends: "OPR", "RBM", "AG", "FULL", "MAP", "MN".
std::string_view name_of(Power power);
std::string_view name_of(Mode mode);
std::string_view name_of(Master master);
std::string_view name_of(ScanWidth scan);
std::string_view name_of(CursorFunction function);
std::string_view name_of(Navigator navigator);

// Names of sequence points and their order. Source: docs/spec/pilots_interface.md#rule-11. Steer and initial points
// `n`, targets `n.`, offsets `n.1` to `n.9`, target offsets `n.01` to `n.99`, n from 1 to 100.
struct PointName {
  int number = 0;       // 1..100
  int offset = 0;       // 1..99; 0 = the point itself
  bool target = false;  // a target, or an offset of one
  friend bool operator==(const PointName&, const PointName&) = default;
};

// Nothing when the text is no name.
std::optional<PointName> point_name(std::string_view text);

// The order of stepping: ascending number, each point before its offsets; texts that are no names last, by spelling.
bool precedes(std::string_view left, std::string_view right);

}  // namespace yars::radar
