#include "lib/radar/modes.hpp"

#include <array>
#include <cstddef>

namespace yars::radar {

namespace {

// A value outside its enumeration can come from a foreign writer: it reads as "?" rather than past the table.
template <std::size_t N, class Enum>
std::string_view look_up(const std::array<std::string_view, N>& names, Enum value) {
  const auto index = static_cast<std::size_t>(value);
  return index < N ? names[index] : std::string_view("?");
}

constexpr std::array<std::string_view, 3> kPower{"OFF", "STBY", "OPR"};
constexpr std::array<std::string_view, 8> kMode{"RBM", "HRM", "PATCH", "BCN", "PVU", "AA", "AGR", "MENU"};
constexpr std::array<std::string_view, 3> kMaster{"AG", "AA", "AGR"};
constexpr std::array<std::string_view, 3> kScan{"FULL", "HALF", "QTR"};
constexpr std::array<std::string_view, 5> kCursor{"MAP", "UPDT", "CUE", "TGT", "MARK"};
constexpr std::array<std::string_view, 2> kNavigator{"MN", "INS"};

}  // namespace

std::string_view name_of(Power power) {
  return look_up(kPower, power);
}
std::string_view name_of(Mode mode) {
  return look_up(kMode, mode);
}
std::string_view name_of(Master master) {
  return look_up(kMaster, master);
}
std::string_view name_of(ScanWidth scan) {
  return look_up(kScan, scan);
}
std::string_view name_of(CursorFunction function) {
  return look_up(kCursor, function);
}
std::string_view name_of(Navigator navigator) {
  return look_up(kNavigator, navigator);
}

}  // namespace yars::radar
