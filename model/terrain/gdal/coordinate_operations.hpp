// PROJ's ways from one coordinate system to another, and what to say about the one that is taken.
// Private to this folder.
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

// Places in the order and the units of a system.
struct Net {
  std::vector<double> x, y;
};

enum class Ways : std::uint8_t {
  all,
  exact_only,  // no ballpark, and every grid is there
};

struct Found {
  Projection operation;  // null: there is none
  std::string warning;   // a ballpark, or that a better way's grid is not installed; empty: neither
};

// The first of PROJ's ways, best first, that serves the most of the net and leads back.
Found operation_between(PJ_CONTEXT* context, PJ* from, PJ* to, const Net& net, Ways ways);

// "stated accuracy 4 m", or that none is stated.
std::string accuracy_text(PJ_CONTEXT* context, PJ* operation);

// In place; `third` may be null. What cannot be transformed becomes infinite.
void transform(PJ* operation, PJ_DIRECTION direction, std::span<double> first, std::span<double> second, double* third);

}  // namespace yars::model::terrain::gdal
