// Sixteen columns of numbers, one after the other, put side by side, by vectors (Highway, chosen at run time; numbers
// are moved and not changed).
#pragma once

#include <cstddef>

namespace yars::model::hrm::lanes {

// rows[16 * row + column] = columns[column * pitch + row] for `count` rows; `rows` aligned to 64 bytes.
void put_side_by_side(std::size_t count, const float* columns, std::size_t pitch, float* rows);

}  // namespace yars::model::hrm::lanes
