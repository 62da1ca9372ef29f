// What `yars patch` writes: a picture (.png), power (.f32: float_file.hpp), or either with its place on the
// earth (.tif, by GDAL). Rows from the far edge. Fails as commands do.
#pragma once

#include <string>

#include "model/hrm/patch_process.hpp"

namespace yars::tools {

struct PatchOutput {
  std::string file;              // empty: none
  std::string pixels = "video";  // of a .tif: "video" or "power"
};

// Before the work: a name that no writer knows, or GDAL that is not built in.
void check_patch_output(const PatchOutput& output);

// Power: gamma of level ground, of the preset 1996 brightness; what the blind zone hides is no data in a .tif, -1 else.
void write_patch(const PatchOutput& output, const model::hrm::PatchOrder& order,
                 const model::hrm::PatchProcess& process);

}  // namespace yars::tools
