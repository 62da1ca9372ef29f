#include "lib/radar/modes.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <limits>
#include <tuple>

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

namespace {

constexpr int kMaxNumber = 100;

std::optional<int> number_of(std::string_view digits) {
  const bool plain = std::all_of(digits.begin(), digits.end(), [](char c) { return c >= '0' && c <= '9'; });
  int value = 0;
  if (!plain || std::from_chars(digits.data(), digits.data() + digits.size(), value).ec != std::errc()) {
    return std::nullopt;
  }
  return value;
}

auto order_of(std::string_view text) {
  const auto name = point_name(text);
  const int last = std::numeric_limits<int>::max();
  return name ? std::make_tuple(name->number, name->offset, text) : std::make_tuple(last, last, text);
}

}  // namespace

std::optional<PointName> point_name(std::string_view text) {
  const std::size_t dot = text.find('.');
  const std::string_view whole = text.substr(0, dot);
  const auto number = number_of(whole);
  // A leading zero would give one point two names.
  if (!number || whole.front() == '0' || *number > kMaxNumber) return std::nullopt;
  if (dot == std::string_view::npos) return PointName{*number, 0, false};

  const std::string_view behind = text.substr(dot + 1);
  if (behind.empty()) return PointName{*number, 0, true};
  const auto offset = number_of(behind);
  if (behind.size() > 2 || !offset || *offset == 0) return std::nullopt;
  return PointName{*number, *offset, behind.size() == 2};
}

bool precedes(std::string_view left, std::string_view right) {
  return order_of(left) < order_of(right);
}

}  // namespace yars::radar
