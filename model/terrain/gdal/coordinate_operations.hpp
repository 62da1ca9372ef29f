// Choice of a PROJ coordinate operation: a transformation from one coordinate system to another. Used in this folder
// only. Input: two systems, and sample points in the first system. Output: the operation, and a warning about its
// accuracy. PROJ's last resort is a ballpark transformation, which treats the datums of the two systems as equal. A
// datum is the ellipsoid to which a system refers, and the position of this ellipsoid in the earth.
// Errors: a null operation, see ChosenOperation. Threads: one thread per PJ_CONTEXT.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "model/terrain/gdal/gdal_library.hpp"

namespace yars::model::terrain::gdal {

struct DestroyContext {
  void operator()(PJ_CONTEXT* context) const { proj_context_destroy(context); }
};
struct DestroyProjection {
  void operator()(PJ* projection) const { proj_destroy(projection); }
};
using ProjContext = std::unique_ptr<PJ_CONTEXT, DestroyContext>;
using Projection = std::unique_ptr<PJ, DestroyProjection>;

// Positions in the axis order and the units of their coordinate system.
struct SamplePoints {
  std::vector<double> x, y;
};

enum class Operations : std::uint8_t {
  all,
  exact_only,  // only operations with all their grid files installed, and no ballpark transformation
};

struct ChosenOperation {
  Projection operation;  // null: no operation transforms a sample point reversibly
  std::string warning;   // set if `operation` is a ballpark transformation, or if a better one lacks its grid file
};

// `points`: sample points in the system `from`. `to`: a system in degrees, latitude first. Tries the first 16
// operations of PROJ's list, which begins with the best one. Returns the operation that transforms the most sample
// points reversibly: a result that is transformed back and forward again is the same within 1e-5 deg. If several
// operations have the same number of points, the first of them is returned. A second list, for the area in which the
// results lie, takes precedence if one of its operations transforms any sample point reversibly.
ChosenOperation operation_between(PJ_CONTEXT* context, PJ* from, PJ* to, const SamplePoints& points,
                                  Operations operations);

// "a stated accuracy of 4 m" or "no stated accuracy".
std::string accuracy_text(PJ_CONTEXT* context, PJ* operation);

// Transforms coordinates in place. `third`: one height per position, or null. Positions that cannot be transformed
// become infinite.
void transform(PJ* operation, PJ_DIRECTION direction, std::span<double> first, std::span<double> second, double* third);

}  // namespace yars::model::terrain::gdal
