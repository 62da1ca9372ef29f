// Numbers by chance that are the same on every run: from a seed and a count, without a state that somebody must keep.
#pragma once

#include <cstdint>

namespace yars::radar {

// Of a normal distribution with mean 0 and variance 1. `draw` tells the numbers of one count apart.
double standard_normal(std::uint64_t seed, std::uint64_t count, std::uint64_t draw);

}  // namespace yars::radar
