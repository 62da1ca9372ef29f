// Time of each stage of the real beam map's algorithm `standard` over the sweeps of a scan. For comparison, the floor
// of the stage: the time to read and write as many arrays without computing.
#pragma once

#include "model/kernel/offline_scan.hpp"
#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::benchmarks {

// Prints one line of JSON: nanoseconds per sample of each stage and of its floor.
void print_stages(const model::terrain::TerrainView& terrain, const model::kernel::ScanRequest& request, int samples);

}  // namespace yars::benchmarks
