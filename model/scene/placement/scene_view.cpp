#include "model/scene/placement/scene_view.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lib/geo/frames.hpp"
#include "model/scene/placement/geometry.hpp"

namespace yars::model::scene {

std::uint64_t square_key(double east_m, double north_m, double side_m) {
  const auto column = static_cast<std::int32_t>(std::floor(east_m / side_m));
  const auto row = static_cast<std::int32_t>(std::floor(north_m / side_m));
  return static_cast<std::uint64_t>(static_cast<std::uint32_t>(row)) << 32U | static_cast<std::uint32_t>(column);
}

std::size_t Scatterers::level_for(double resolved_m) const {
  std::size_t level = finest;
  while (level + 1 < kScattererSides_m.size() && kScattererSides_m[level + 1] <= resolved_m) ++level;
  return level;
}

std::uint64_t Scatterers::bytes() const {
  constexpr std::uint64_t kHashNode = 64;  // [bytes] approximate size of an unordered_map node
  std::uint64_t sum = sizeof(Scatterers);
  for (const ScattererLevel& level : levels)
    sum += level.scatterers.capacity() * sizeof(Scatterer) + level.facings.capacity() * sizeof(Facing) +
           level.covers.size() * kHashNode + level.tree.bytes();
  return sum;
}

namespace {

// Bins of a normal's direction. Cardinal effect: stronger return of walls that face the radar. Its half-power width is
// 6 degrees by default.
constexpr double kAzimuthBin_rad = std::numbers::pi / 45.0;    // 4 degrees, below the width of the cardinal effect
constexpr double kElevationBin_rad = std::numbers::pi / 12.0;  // 15 degrees
constexpr std::uint32_t kWall = 1U << 31U;                     // bit of a key: the face is a wall
// Maximum number of squares with standing faces in a scene. The same limit applies to squares with lying faces. It
// bounds memory to about 100 MB.
constexpr std::size_t kMaxSquares = 1U << 18U;
// Maximum extent east and north of a triangle on the ground, in squares. For a larger triangle, the builder changes to
// a coarser level.
constexpr double kMaxSquaresPerEdge = 64.0;

// Key of a face: its material, the bins of its normal's elevation and azimuth, and whether it is a wall. Within a
// square, faces with equal keys are summed.
std::uint32_t key_of(std::uint8_t material, geo::Vector3 normal) {
  const double horizontal2 = normal.x * normal.x + normal.y * normal.y;
  const auto elevation = static_cast<std::uint32_t>(
      std::floor((std::asin(std::clamp(normal.z, -1.0, 1.0)) + std::numbers::pi / 2) / kElevationBin_rad));
  const bool level = std::abs(normal.z) > kLevelNormal;
  const auto azimuth =
      level ? 0U
            : static_cast<std::uint32_t>((std::atan2(normal.y, normal.x) + std::numbers::pi) / kAzimuthBin_rad) % 90U;
  const bool wall = normal.z * normal.z < kWallNormal2 * horizontal2;
  return static_cast<std::uint32_t>(material) << 16U | elevation << 8U | azimuth | (wall ? kWall : 0U);
}

geo::Vector3 middle_of(const std::array<geo::Vector3, 3>& corners) {
  return (1.0 / 3.0) * (corners[0] + corners[1] + corners[2]);
}

geo::Vector3 area_of(const std::array<geo::Vector3, 3>& corners) {
  return 0.5 * cross(corners[1] - corners[0], corners[2] - corners[0]);
}

}  // namespace

void ScatterBuilder::add(Square& square, std::uint32_t key, geo::Vector3 area_m2) {
  const auto same = std::find_if(square.facings.begin(), square.facings.end(),
                                 [key](const FacingSum& facing) { return facing.key == key; });
  if (same == square.facings.end())
    square.facings.push_back({key, area_m2});
  else
    same->area_m2 = same->area_m2 + area_m2;
}

bool ScatterBuilder::coarsen() {
  if (finest_ + 1 == kScattererSides_m.size()) return false;
  ++finest_;
  standing_ = coarser(standing_);
  lying_ = coarser(lying_);
  return true;
}

// Returns the square that contains a point. Null if this square is new and exceeds the limit of squares at the coarsest
// level.
ScatterBuilder::Square* ScatterBuilder::square_in(Squares& squares, geo::Vector3 at) {
  while (squares.size() >= kMaxSquares && coarsen()) continue;
  const std::uint64_t key = square_key(at.x, at.y, side_m());
  if (squares.size() >= kMaxSquares && !squares.contains(key)) return nullptr;
  return &squares[key];
}

bool ScatterBuilder::within_reach(const std::array<geo::Vector3, 3>& corners) const {
  const geo::Vector3 middle = middle_of(corners);
  return middle.x * middle.x + middle.y * middle.y <= max_reach_m_ * max_reach_m_;
}

void ScatterBuilder::add_standing(const std::array<geo::Vector3, 3>& corners, std::uint8_t material) {
  const geo::Vector3 area_m2 = area_of(corners);
  const double weight = length(area_m2);
  if (!(weight > 0.0) || !within_reach(corners)) return;
  const geo::Vector3 middle = middle_of(corners);
  Square* const found = square_in(standing_, middle);
  if (found == nullptr) return;
  Square& square = *found;
  const bool is_new = square.facings.empty();
  const auto [min, max] = std::minmax({corners[0].z, corners[1].z, corners[2].z});
  square.min_m = is_new ? min : std::min(square.min_m, min);
  square.max_m = is_new ? max : std::max(square.max_m, max);
  square.middle = square.middle + weight * middle;
  square.spread += weight * (middle.x * middle.x + middle.y * middle.y);
  square.area_m2 += weight;
  add(square, key_of(material, (1.0 / weight) * area_m2), area_m2);
}

void ScatterBuilder::add_lying(const std::array<geo::Vector3, 3>& corners, std::uint8_t material) {
  if (!(area_of(corners).z > 0.0) || !within_reach(corners)) return;
  const PlanPolygon whole(corners);
  const auto [west, east] = whole.bounds(&geo::Vector3::x);
  const auto [min_y, max_y] = whole.bounds(&geo::Vector3::y);
  while (std::max(east - west, max_y - min_y) > kMaxSquaresPerEdge * side_m())
    if (!coarsen()) return;
  const double side = side_m();
  const auto first_of = [side](double from_m) { return static_cast<std::int64_t>(std::floor(from_m / side)); };
  for (std::int64_t column = first_of(west); static_cast<double>(column) * side < east; ++column) {
    const double column_m = static_cast<double>(column) * side;
    const PlanPolygon strip = whole.between(&geo::Vector3::x, column_m, column_m + side);
    const auto [south, north] = strip.bounds(&geo::Vector3::y);
    for (std::int64_t row = first_of(south); static_cast<double>(row) * side < north; ++row) {
      const double row_m = static_cast<double>(row) * side;
      const double area_m2 = strip.between(&geo::Vector3::y, row_m, row_m + side).area();
      if (!(area_m2 > 0.0)) continue;
      const geo::Vector3 middle{column_m + 0.5 * side, row_m + 0.5 * side, 0.0};
      Square* const square = square_in(lying_, middle);
      if (square == nullptr) return;
      square->middle = square->middle + area_m2 * middle;
      square->area_m2 += area_m2;
      add(*square, key_of(material, {0, 0, 1}), {0.0, 0.0, area_m2});
    }
  }
}

ScatterBuilder::Keys ScatterBuilder::sorted_keys(const Squares& squares) {
  Keys keys;
  keys.reserve(squares.size());
  for (const auto& [key, square] : squares) keys.push_back(key);
  std::sort(keys.begin(), keys.end());
  return keys;
}

// Merges every 2 x 2 squares into one square of the next coarser level.
ScatterBuilder::Squares ScatterBuilder::coarser(const Squares& squares) {
  Squares merged;
  for (const std::uint64_t key : sorted_keys(squares)) {
    const auto row = static_cast<std::int32_t>(static_cast<std::uint32_t>(key >> 32U)) >> 1;
    const auto column = static_cast<std::int32_t>(static_cast<std::uint32_t>(key)) >> 1;
    const Square& part = squares.at(key);
    const auto [found, is_new] = merged.try_emplace(static_cast<std::uint64_t>(static_cast<std::uint32_t>(row)) << 32U |
                                                    static_cast<std::uint32_t>(column));
    Square& whole = found->second;
    if (is_new) {
      whole = part;
      continue;
    }
    whole.middle = whole.middle + part.middle;
    whole.spread += part.spread;
    whole.area_m2 += part.area_m2;
    whole.min_m = std::min(whole.min_m, part.min_m);
    whole.max_m = std::max(whole.max_m, part.max_m);
    for (const FacingSum& facing : part.facings) add(whole, facing.key, facing.area_m2);
  }
  return merged;
}

void ScatterBuilder::finish(const geo::AzimuthalEquidistant& plane, double side_m, Scatterers& result,
                            ScattererLevel& level) const {
  const auto append_facings = [&level](const Square& square) {
    for (const FacingSum& sum : square.facings)
      level.facings.push_back({static_cast<float>(sum.area_m2.x), static_cast<float>(sum.area_m2.y),
                               static_cast<float>(sum.area_m2.z), static_cast<std::uint8_t>(sum.key >> 16U & 0xffU),
                               (sum.key & kWall) != 0U});
  };
  std::vector<Scatterer> found;
  std::vector<Ball> balls;
  for (const std::uint64_t key : sorted_keys(standing_)) {
    const Square& square = standing_.at(key);
    const geo::Vector3 middle = (1.0 / square.area_m2) * square.middle;
    const double middle2 = middle.x * middle.x + middle.y * middle.y;
    // The mean squared distance of a uniformly filled square of side s from its centre is s^2 / 6.
    const double extent_m = std::sqrt(6.0 * std::max(0.0, square.spread / square.area_m2 - middle2));
    const geo::Vector3 at = result.frame.enu_from_geodetic(plane.geodetic_from_plane({middle.x, middle.y}),
                                                           geo::HeightAboveEllipsoid::metres(0.0));
    found.push_back({static_cast<float>(at.x), static_cast<float>(at.y), static_cast<float>(at.z),
                     static_cast<float>(middle.z), static_cast<float>(square.min_m), static_cast<float>(square.max_m),
                     static_cast<float>(std::min(extent_m, side_m)), static_cast<std::uint32_t>(level.facings.size()),
                     static_cast<std::uint32_t>(square.facings.size())});
    append_facings(square);
    balls.push_back({at, side_m});
    result.reach_m = std::max(result.reach_m, std::sqrt(middle2) + side_m);
  }
  std::vector<std::uint32_t> order;
  level.tree = SphereTree(balls, order);
  level.scatterers.reserve(found.size());
  for (const std::uint32_t number : order) level.scatterers.push_back(found[number]);
  for (const std::uint64_t key : sorted_keys(lying_)) {
    const Square& square = lying_.at(key);
    level.covers[key] = {static_cast<float>(std::min(1.0, square.area_m2 / (side_m * side_m))),
                         static_cast<std::uint32_t>(level.facings.size()),
                         static_cast<std::uint32_t>(square.facings.size())};
    append_facings(square);
    const double middle2 = square.middle.x * square.middle.x + square.middle.y * square.middle.y;
    result.reach_m = std::max(result.reach_m, std::sqrt(middle2) / square.area_m2 + 2.0 * side_m);
  }
  level.facings.insert(level.facings.end(), kFacingSlack, Facing{});
  level.facings.shrink_to_fit();
}

std::shared_ptr<const Scatterers> ScatterBuilder::take(const geo::AzimuthalEquidistant& plane) {
  if (standing_.empty() && lying_.empty()) return nullptr;
  auto result = std::make_shared<Scatterers>(plane.origin());
  result->finest = finest_;
  for (std::size_t level = finest_; level < kScattererSides_m.size(); ++level) {
    if (level > finest_) {
      standing_ = coarser(standing_);
      lying_ = coarser(lying_);
    }
    finish(plane, kScattererSides_m[level], *result, result->levels[level]);
  }
  standing_.clear();
  lying_.clear();
  return result;
}

}  // namespace yars::model::scene
