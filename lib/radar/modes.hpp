// The radar's modes and switch positions, as fixed numbers: records in shared memory carry them.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace yars::radar {

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

}  // namespace yars::radar
