#include "lib/radar/modes.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <limits>
#include <tuple>

namespace yars::radar {

namespace {

// Text of an enumerator. A record of another program can have a value outside the table; the text is then "?".
template <std::size_t N, class Enum>
std::string_view text_of(const std::array<std::string_view, N>& names, Enum value) {
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
  return text_of(kPower, power);
}
std::string_view name_of(Mode mode) {
  return text_of(kMode, mode);
}
std::string_view name_of(Master master) {
  return text_of(kMaster, master);
}
std::string_view name_of(ScanWidth scan) {
  return text_of(kScan, scan);
}
std::string_view name_of(CursorFunction function) {
  return text_of(kCursor, function);
}
std::string_view name_of(Navigator navigator) {
  return text_of(kNavigator, navigator);
}

namespace {

std::optional<int> number_of(std::string_view digits) {
  const bool all_digits = std::all_of(digits.begin(), digits.end(), [](char c) { return c >= '0' && c <= '9'; });
  int value = 0;
  if (!all_digits || std::from_chars(digits.data(), digits.data() + digits.size(), value).ec != std::errc()) {
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
  const std::string_view number_text = text.substr(0, dot);
  const auto number = number_of(number_text);
  // A number with leading zeros is refused, because one point would then have several names.
  if (!number || number_text.front() == '0' || *number > kMaxPointNumber) return std::nullopt;
  if (dot == std::string_view::npos) return PointName{*number, 0, false};

  const std::string_view offset_text = text.substr(dot + 1);
  if (offset_text.empty()) return PointName{*number, 0, true};
  const auto offset = number_of(offset_text);
  if (offset_text.size() > 2 || !offset || *offset == 0) return std::nullopt;
  return PointName{*number, *offset, offset_text.size() == 2};
}

std::string text_of(const PointName& name) {
  std::string text = std::to_string(name.number);
  if (name.target || name.offset != 0) text += '.';
  if (name.offset == 0) return text;
  if (name.target && name.offset < 10) text += '0';
  return text + std::to_string(name.offset);
}

bool precedes(std::string_view left, std::string_view right) {
  return order_of(left) < order_of(right);
}

namespace {

bool is_offset(const PointName& name) {
  return name.offset != 0;
}

}  // namespace

PointKind kind_by_name(const PointName& name) {
  if (is_offset(name)) return name.target ? PointKind::target_offset : PointKind::steer_offset;
  return name.target ? PointKind::target : PointKind::steer;
}

bool is_kind_of(PointKind kind, const PointName& name) {
  const PointKind by_name = kind_by_name(name);
  return kind == by_name || (kind == PointKind::initial && by_name == PointKind::steer);
}

const NamedPoint* conflict(const PointName& name, std::span<const NamedPoint> route) {
  const auto found = std::ranges::find_if(route, [&name](const NamedPoint& other) {
    const bool same_number = !is_offset(name) && !is_offset(other.name) && other.name.number == name.number;
    return other.name == name || same_number;
  });
  return found == route.end() ? nullptr : &*found;
}

std::optional<std::size_t> initial_point_before(int target_number, std::span<const NamedPoint> route) {
  const NamedPoint* last_steer = nullptr;
  const NamedPoint* last_other = nullptr;
  for (const NamedPoint& point : route) {
    if (is_offset(point.name) || point.name.number >= target_number) continue;
    const NamedPoint*& last = point.kind == PointKind::steer ? last_steer : last_other;
    if (last == nullptr || point.name.number > last->name.number) last = &point;
  }
  if (last_steer == nullptr) return std::nullopt;
  const bool has_other = last_other != nullptr;
  if (has_other && last_other->kind == PointKind::initial) return std::nullopt;
  if (has_other && last_other->name.number > last_steer->name.number) return std::nullopt;
  return static_cast<std::size_t>(last_steer - route.data());
}

}  // namespace yars::radar
