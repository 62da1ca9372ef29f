// Sixteen columns of numbers, one after the other: what lies between some of them, and all put side by side, by vectors
// (Highway, chosen at run time, equal bits on every target).
#pragma once

#include <cstddef>

namespace yars::model::hrm::lanes {

// Every `step`th column is given, the first and the last among them; the others become what lies between their
// neighbours on a straight line. `count` rows; up to 15 more of each column are overwritten.
void fill_between(std::size_t count, std::size_t step, float* columns, std::size_t pitch);

// rows[16 * row + column] = columns[column * pitch + row] for `count` rows; `rows` aligned to 64 bytes.
void put_side_by_side(std::size_t count, const float* columns, std::size_t pitch, float* rows);

}  // namespace yars::model::hrm::lanes
