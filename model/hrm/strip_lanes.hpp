// Sixteen columns of numbers, one after the other: what lies between some of them, and all put side by side, by vectors
// (Highway, chosen at run time, equal bits on every target).
#pragma once

#include <cstddef>

#include "model/hrm/fan_point.hpp"

namespace yars::model::hrm::lanes {

// Every `step`th column is given, the first and the last among them; the others become what lies between their
// neighbours on a straight line. `count` rows; up to 15 more of each column are overwritten.
void fill_between(std::size_t count, std::size_t step, float* columns, std::size_t pitch);

// points[16 * row + column] = {gain[column * pitch + row], height_m[column * pitch + row]} for `count` rows.
void put_side_by_side(std::size_t count, const float* gain, const float* height_m, std::size_t pitch,
                      SurfacePoint* points);

}  // namespace yars::model::hrm::lanes
