#include "lib/radar/route.hpp"

#include <algorithm>

namespace yars::radar {

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
