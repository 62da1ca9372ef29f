#include "model/terrain/gdal/coordinate_operations.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>

namespace yars::model::terrain::gdal {

namespace {

struct DestroyList {
  void operator()(PJ_OBJ_LIST* list) const { proj_list_destroy(list); }
};
using List = std::unique_ptr<PJ_OBJ_LIST, DestroyList>;
struct DestroyFactory {
  void operator()(PJ_OPERATION_FACTORY_CONTEXT* factory) const { proj_operation_factory_context_destroy(factory); }
};
using Factory = std::unique_ptr<PJ_OPERATION_FACTORY_CONTEXT, DestroyFactory>;

struct Area {
  double south_deg, west_deg, north_deg, east_deg;
};

List operations_between(PJ_CONTEXT* context, PJ* from, PJ* to, Operations operations, const std::optional<Area>& area) {
  const Factory factory(proj_create_operation_factory_context(context, nullptr));
  proj_operation_factory_context_set_spatial_criterion(context, factory.get(),
                                                       PROJ_SPATIAL_CRITERION_PARTIAL_INTERSECTION);
  const bool exact = operations == Operations::exact_only;
  proj_operation_factory_context_set_grid_availability_use(
      context, factory.get(),
      exact ? PROJ_GRID_AVAILABILITY_DISCARD_OPERATION_IF_MISSING_GRID : PROJ_GRID_AVAILABILITY_USED_FOR_SORTING);
  if (exact) proj_operation_factory_context_set_allow_ballpark_transformations(context, factory.get(), 0);
  if (area)
    proj_operation_factory_context_set_area_of_interest(context, factory.get(), area->west_deg, area->south_deg,
                                                        area->east_deg, area->north_deg);
  return List(proj_create_operations(context, from, to, factory.get()));
}

// Transforms `points` forward, back and forward again. Returns the number of points for which the two forward results
// agree within 1e-5 deg. `reached` receives the first forward results: latitude in x, longitude in y [deg].
std::size_t count_round_trips(PJ* operation, const SamplePoints& points, SamplePoints& reached) {
  constexpr double kSame_deg = 1e-5;
  reached = points;
  transform(operation, PJ_FWD, reached.x, reached.y, nullptr);
  SamplePoints again = reached;
  transform(operation, PJ_INV, again.x, again.y, nullptr);
  transform(operation, PJ_FWD, again.x, again.y, nullptr);
  std::size_t count = 0;
  for (std::size_t i = 0; i < points.x.size(); ++i) {
    const double difference_deg = std::remainder(again.y[i] - reached.y[i], 360.0);
    const bool at_pole = std::abs(reached.x[i]) > 89.99;  // at a pole all longitudes are the same position
    if (std::abs(again.x[i] - reached.x[i]) < kSame_deg && (at_pole || std::abs(difference_deg) < kSame_deg)) ++count;
  }
  return count;
}

// Bounding box of the points that could be transformed. Nullopt if there are none, or if the box is wider than 180
// degrees.
std::optional<Area> area_of(const SamplePoints& reached) {
  std::optional<Area> area;
  double first_deg = 0.0;
  for (std::size_t i = 0; i < reached.x.size(); ++i) {
    if (!std::isfinite(reached.x[i]) || !std::isfinite(reached.y[i])) continue;
    if (!area) {
      first_deg = reached.y[i];
      area = Area{reached.x[i], first_deg, reached.x[i], first_deg};
    }
    const double longitude_deg = reached.y[i] - 360.0 * std::round((reached.y[i] - first_deg) / 360.0);
    area->south_deg = std::min(area->south_deg, reached.x[i]);
    area->north_deg = std::max(area->north_deg, reached.x[i]);
    area->west_deg = std::min(area->west_deg, longitude_deg);
    area->east_deg = std::max(area->east_deg, longitude_deg);
  }
  if (!area || area->east_deg - area->west_deg > 180.0) return std::nullopt;
  const auto wrapped = [](double degrees) { return degrees - 360.0 * std::round(degrees / 360.0); };
  area->west_deg = wrapped(area->west_deg);
  area->east_deg = wrapped(area->east_deg);
  return area;
}

struct Choice {
  Projection operation;
  SamplePoints reached;
};

// Selects the operation of PROJ's list that transforms the most points reversibly; of several such, the first.
Choice choose(PJ_CONTEXT* context, PJ_OBJ_LIST* list, const SamplePoints& points) {
  constexpr int kMaxTried = 16;
  Choice best;
  std::size_t max_count = 0;
  for (int position = 0; list != nullptr && position < std::min(proj_list_get_count(list), kMaxTried); ++position) {
    Projection candidate(proj_list_get(context, list, position));
    if (!candidate || proj_coordoperation_is_instantiable(context, candidate.get()) == 0) continue;
    SamplePoints reached;
    const std::size_t count = points.x.empty() ? 1 : count_round_trips(candidate.get(), points, reached);
    if (count <= max_count) continue;
    max_count = count;
    best = {std::move(candidate), std::move(reached)};
    if (count >= points.x.size()) break;
  }
  return best;
}

std::string metres(double accuracy_m) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.6g m", accuracy_m);
  return text.data();
}

// Name of the first grid file that an operation needs and that is not installed; empty if there is none.
std::string missing_grid(PJ_CONTEXT* context, PJ* operation) {
  for (int grid = 0; grid < proj_coordoperation_get_grid_used_count(context, operation); ++grid) {
    const char* name = nullptr;
    int available = 0;
    if (proj_coordoperation_get_grid_used(context, operation, grid, &name, nullptr, nullptr, nullptr, nullptr, nullptr,
                                          &available) != 0 &&
        available == 0 && name != nullptr)
      return name;
  }
  return {};
}

// Text that names the missing grid file of the most accurate operation that cannot be used without it. Empty if no such
// operation is better than the chosen one by more than 1 m. `accuracy_m`: accuracy of the chosen operation; negative:
// not known, so any operation with a known accuracy is better.
std::string better_operation_lacking_grid(PJ_CONTEXT* context, PJ_OBJ_LIST* list, double accuracy_m) {
  std::string best;
  double best_m = accuracy_m < 0.0 ? 1e9 : accuracy_m - 1.0;
  for (int position = 0; position < proj_list_get_count(list); ++position) {
    const Projection candidate(proj_list_get(context, list, position));
    if (!candidate || proj_coordoperation_is_instantiable(context, candidate.get()) != 0) continue;
    const double candidate_m = proj_coordoperation_get_accuracy(context, candidate.get());
    const std::string grid = missing_grid(context, candidate.get());
    if (grid.empty() || candidate_m < 0.0 || candidate_m >= best_m) continue;
    best_m = candidate_m;
    best = "the grid " + grid + ", with an accuracy of " + metres(candidate_m) + ", is not installed";
  }
  return best;
}

std::string warning_of(PJ_CONTEXT* context, PJ_OBJ_LIST* list, PJ* operation) {
  const bool ballpark = proj_coordoperation_has_ballpark_transformation(context, operation) != 0;
  const std::string better = better_operation_lacking_grid(
      context, list, ballpark ? -1.0 : proj_coordoperation_get_accuracy(context, operation));
  if (!ballpark && better.empty()) return {};
  const std::string what =
      ballpark ? "PROJ has only a ballpark transformation to WGS84: posts may be displaced by hundreds of metres"
               : "the data are converted to WGS84 with " + accuracy_text(context, operation);
  return better.empty() ? what : what + "; " + better;
}

}  // namespace

void transform(PJ* operation, PJ_DIRECTION direction, std::span<double> first, std::span<double> second,
               double* third) {
  proj_trans_generic(operation, direction, first.data(), sizeof(double), first.size(), second.data(), sizeof(double),
                     second.size(), third, sizeof(double), third == nullptr ? 0 : first.size(), nullptr, 0, 0);
}

std::string accuracy_text(PJ_CONTEXT* context, PJ* operation) {
  const double accuracy_m = proj_coordoperation_get_accuracy(context, operation);
  return accuracy_m < 0.0 ? "no stated accuracy" : "a stated accuracy of " + metres(accuracy_m);
}

ChosenOperation operation_between(PJ_CONTEXT* context, PJ* from, PJ* to, const SamplePoints& points,
                                  Operations operations) {
  List list = operations_between(context, from, to, operations, std::nullopt);
  Choice choice = choose(context, list.get(), points);
  // The area of the raster is known only after a first operation. The best operation for that area may be another one.
  if (const std::optional<Area> area = choice.operation ? area_of(choice.reached) : std::nullopt) {
    List nearby = operations_between(context, from, to, operations, area);
    if (Choice better = choose(context, nearby.get(), points); better.operation) {
      choice = std::move(better);
      list = std::move(nearby);
    }
  }
  if (!choice.operation) return {};
  std::string warning = warning_of(context, list.get(), choice.operation.get());
  return {std::move(choice.operation), std::move(warning)};
}

}  // namespace yars::model::terrain::gdal
