// Choice of a PROJ coordinate operation: a transformation from one coordinate system to another. Used in this folder
// only. Input: two systems, and sample points in the first system. Output: the operation, and a warning about its
// accuracy. PROJ's last resort is a ballpark transformation. It neglects the difference between the two datums, the
// ellipsoids to which the systems refer and their positions in the earth.
// Errors: a null operation if PROJ has none. Threads: one thread per PJ_CONTEXT.
#pragma once

#include <proj.h>

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

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
  Projection operation;  // null if PROJ has none
  std::string warning;   // set if PROJ has only a ballpark transformation, or if a better operation lacks its grid file
};

// `points`: sample points in the system `from`. Tries the first 16 operations of PROJ's list, best first. Returns the
// operation that transforms the most sample points reversibly: the result, transformed back and forward again, is the
// same. A second list, for the area of these results, takes precedence if one of its operations can be used.
ChosenOperation operation_between(PJ_CONTEXT* context, PJ* from, PJ* to, const SamplePoints& points,
                                  Operations operations);

// "a stated accuracy of 4 m" or "no stated accuracy".
std::string accuracy_text(PJ_CONTEXT* context, PJ* operation);

// Transforms coordinates in place. `third` may be null. Positions that cannot be transformed become infinite.
void transform(PJ* operation, PJ_DIRECTION direction, std::span<double> first, std::span<double> second, double* third);

}  // namespace yars::model::terrain::gdal
