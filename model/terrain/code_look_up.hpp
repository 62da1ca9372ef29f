// The fast look-up in one culture: material codes over a run of places, by vectors (Highway, chosen at run time; the
// same codes on every target).
#pragma once

#include <cstddef>
#include <cstdint>

#include "model/terrain/culture.hpp"

namespace yars::model::terrain::look_up {

// Code of the culture's post nearest to each place, as whole numbers; places [deg] from the cell's corner, [0, 1];
// beyond counts as on the edge. Arrays have kRunSlack more; those of `material` are overwritten.
void codes(const Culture& culture, const float* north_deg, const float* east_deg, std::size_t count,
           std::int32_t* material);

}  // namespace yars::model::terrain::look_up
