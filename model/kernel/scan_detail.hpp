// How fine the terrain of a scan has to be: the fidelity's posts a sample at a range. "A scene costs what is in view."
#pragma once

#include "lib/geo/quantity.hpp"
#include "lib/radar/configuration.hpp"

namespace yars::model::kernel {

// Of TerrainRegion; 0 = the finest.
int scan_detail(const radar::Fidelity& fidelity, geo::Length range);

}  // namespace yars::model::kernel
