// Time of each stage of `standard` over the sweeps of a scan, and its floor: the time to read and write the same arrays
// without computing.
#pragma once

#include "model/kernel/offline_scan.hpp"
#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::benchmarks {

// One JSON line: nanoseconds a sample of each stage and of its floor.
void print_stages(const model::terrain::TerrainView& terrain, const model::kernel::ScanRequest& request, int samples);

}  // namespace yars::benchmarks
