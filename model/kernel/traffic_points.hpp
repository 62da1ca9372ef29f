// The traffic that a tick latched, as points that the radar sees.
#pragma once

#include <vector>

#include "databuffer/records/traffic.hpp"
#include "model/rbm/moving_point.hpp"

namespace yars::model::kernel {

// Each goes on from where it was at the tick at which it was latched.
std::vector<rbm::MovingPoint> points_of(const databuffer::Traffic& traffic);

}  // namespace yars::model::kernel
