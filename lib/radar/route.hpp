// Rules of a route of sequence points: which names go together, the kind of a name, and initial points.
// Inputs: names of points (modes.hpp) and their kinds. Outputs: kinds, conflicts, the place of an initial point.
// Source: docs/pilots_manual.md#rule-11.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "lib/radar/modes.hpp"

namespace yars::radar {

// Words for the kinds, in the order of PointKind.
inline constexpr std::array<std::string_view, 5> kPointKindNames{"steer", "initial", "target", "steer-offset",
                                                                 "target-offset"};

struct NamedPoint {
  PointName name;
  PointKind kind = PointKind::steer;
};

// Kind of a point that has this name and no stated kind. A steer point may become an initial point.
PointKind kind_by_name(const PointName& name);

// True if a point with this name can be of this kind: the one of kind_by_name(), or initial instead of steer.
bool is_kind_of(PointKind kind, const PointName& name);

// Point of the route because of which a new point cannot have this name: it has the name already, or both are no
// offsets and have the same number. nullptr: the name is free.
const NamedPoint* conflict(const PointName& name, std::span<const NamedPoint> route);

// Index of the point that becomes the initial point of a target with this number: the last steer point between the
// target before it and the target, by number. nullopt: there is none, or an initial point lies between them.
std::optional<std::size_t> initial_point_before(int target_number, std::span<const NamedPoint> route);

}  // namespace yars::radar
