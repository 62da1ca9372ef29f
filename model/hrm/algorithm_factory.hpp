// Factory of the configured patch map algorithm.
// Input: the fidelity's `algorithm`. Output: Standard, Reference or Report1996.
#pragma once

#include <memory>

#include "lib/radar/configuration.hpp"
#include "model/hrm/algorithm.hpp"

namespace yars::model::hrm {

// Makes the algorithm that the fidelity names.
std::unique_ptr<Algorithm> make_algorithm(const radar::RadarConfiguration& configuration);

}  // namespace yars::model::hrm
