// Names of sequence points and their order. Source: docs/spec/pilots_interface.md#rule-11. Steer and initial points
// `n`, targets `n.`, offsets `n.1` to `n.9`, target offsets `n.01` to `n.99`, n from 1 to 100.
#pragma once

#include <optional>
#include <string_view>

namespace yars::radar {

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
