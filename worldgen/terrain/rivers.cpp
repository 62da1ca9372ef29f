#include "worldgen/terrain/rivers.hpp"

#include <algorithm>
#include <cmath>

#include "lib/geo/frames.hpp"
#include "lib/random/counter_rng.hpp"

namespace yars::worldgen {

namespace {

constexpr double kBend_m = 1150.0;          // wavelength of meanders
constexpr double kBendAmplitude_m = 170.0;  // amplitude of meanders
constexpr int kPiecesPerNode = 5;           // pieces of the course at one node
constexpr double kFloorAboveWater_m = 1.0;

double half_width_m(double area_km2) {
  return 10.0 + 2.2 * std::sqrt(area_km2);
}

// A point of a river's course with its cross-section.
struct CoursePoint {
  double latitude_deg, longitude_deg;  // the longitude may lie outside [-180, 180]
  RiverPiece::End river;
};

double mean(double a, double b) {
  return 0.5 * (a + b);
}
RiverPiece::End interpolated(const RiverPiece::End& a, const RiverPiece::End& b, double t) {
  const auto mix = [t](double x, double y) { return x + t * (y - x); };
  return {mix(a.water_m, b.water_m), mix(a.half_width_m, b.half_width_m), mix(a.floor_m, b.floor_m),
          mix(a.extent_m, b.extent_m)};
}

// Cross-section of a river by its drained area. `depth_m`: height of the ground above the water; deeper cuts have wider
// slopes.
RiverPiece::End river_of(double area_km2, double water_m, double depth_m) {
  const double half_m = half_width_m(area_km2);
  const double floor_m = half_m + 40.0 + 1.5 * half_m;
  return {water_m, half_m, floor_m, floor_m + std::clamp(250.0 + 3.0 * std::abs(depth_m), 300.0, 2400.0)};
}

class CourseMaker {
 public:
  CourseMaker(const ReliefTile& relief, const Drainage& drainage, std::uint32_t seed)
      : relief_(relief), drainage_(drainage), seed_(seed) {}

  std::vector<RiverPiece> pieces() {
    std::vector<bool> has_source(drainage_.nodes.size(), false);
    for (std::size_t index = 0; index < drainage_.nodes.size(); ++index) {
      const RiverNode& node = drainage_.nodes[index];
      if (node.downstream < 0) continue;
      has_source[static_cast<std::size_t>(node.downstream)] = true;
      add_bend(middle(node), drainage_.nodes[static_cast<std::size_t>(node.downstream)]);
    }
    for (std::size_t index = 0; index < drainage_.nodes.size(); ++index) {
      const RiverNode& node = drainage_.nodes[index];
      bool entered = has_source[index];
      for (const RiverEntry& entry : drainage_.entries) {
        const TileNode target = gate_target(entry.gate);
        if (target.row != node.row || target.column != node.column || entry.area_km2 < kRiverKm2) continue;
        add_bend(gate_point(entry.gate, entry.area_km2, gate_target(entry.gate), -1), node);
        entered = true;
      }
      if (!entered) add_bend(node_point(node), node);  // a spring
    }
    return std::move(pieces_);
  }

 private:
  // Position of a node with a random offset of up to 0.35 nodes, so that rivers do not follow the lattice.
  CoursePoint jittered_node(int row, int column) const {
    const int earth_row = (relief_.corner().south_deg + 90) * kTileNodes + row;
    const int round = model::terrain::kCellColumns * kTileNodes;
    const int earth_column = ((relief_.corner().west_deg + 180) * kTileNodes + column + round) % round;
    const std::uint32_t hash = random::lattice_hash(earth_column, earth_row, 2, seed_);
    const double north = 0.7 * (static_cast<double>(hash >> 16U) / 65536.0 - 0.5);
    const double east = 0.7 * (static_cast<double>(hash & 0xFFFFU) / 65536.0 - 0.5);
    return {(earth_row + north) / kTileNodes - 90.0, (earth_column + east) / kTileNodes - 180.0, {}};
  }
  CoursePoint node_point(const RiverNode& node) const {
    CoursePoint point = jittered_node(node.row, node.column);
    point.river = river_of(node.area_km2, node.water_m, node.ground_m - node.water_m);
    return point;
  }
  // The point half way between `a` and `b`, also across the antimeridian. `area_km2`, the drained area, gives the
  // widths of water and valley floor.
  static CoursePoint between(const CoursePoint& a, const CoursePoint& b, double area_km2) {
    const double turn = std::abs(a.longitude_deg - b.longitude_deg) > 180.0 ? 360.0 : 0.0;
    const double east_deg = b.longitude_deg + (b.longitude_deg < a.longitude_deg ? turn : -turn);
    CoursePoint point{mean(a.latitude_deg, b.latitude_deg), mean(a.longitude_deg, east_deg),
                      interpolated(a.river, b.river, 0.5)};
    const RiverPiece::End whole = river_of(area_km2, point.river.water_m, 0.0);
    point.river.half_width_m = whole.half_width_m;
    point.river.floor_m = whole.floor_m;
    return point;
  }
  // The point of the course half way between a node and its downstream node.
  CoursePoint middle(const RiverNode& node) const {
    return between(node_point(node), node_point(drainage_.nodes[static_cast<std::size_t>(node.downstream)]),
                   node.area_km2);
  }
  // The point midway between the two nodes of a gate. `node` is the gate's node in this tile. `sense` is 1 for an exit,
  // -1 for an entry. Both tiles compute the same point.
  CoursePoint gate_point(const RiverGate& gate, double area_km2, TileNode node, int sense) const {
    const CoursePoint here = jittered_node(node.row, node.column);
    const CoursePoint beyond = jittered_node(node.row + sense * gate.north, node.column + sense * gate.east);
    // The gate's source node comes first, so that both tiles compute equal bits.
    CoursePoint middle = sense > 0 ? between(here, beyond, area_km2) : between(beyond, here, area_km2);
    middle.river = river_of(area_km2, gate.water_m, 40.0);  // a fixed depth of 40 m, equal in both tiles
    return middle;
  }

  // Adds the pieces of a smooth bend (quadratic Bezier curve) from `start` past the node. The bend ends half way to the
  // next node, at the node's exit gate, or at the node if the river ends there.
  void add_bend(const CoursePoint& start, const RiverNode& node) {
    CoursePoint end = node_point(node);
    if (node.downstream >= 0) end = middle(node);
    if (node.exit >= 0) {
      const auto exit = static_cast<std::size_t>(node.exit);
      end = gate_point(drainage_.exits[exit], drainage_.exits_km2[exit], gate_source(drainage_.exits[exit]), 1);
    }
    const CoursePoint control = node_point(node);
    CoursePoint last = with_meanders(start);
    for (int step = 1; step <= kPiecesPerNode; ++step) {
      const CoursePoint next =
          with_meanders(bezier_point(start, control, end, static_cast<double>(step) / kPiecesPerNode));
      add_piece(last, next);
      last = next;
    }
  }
  // The longitude, shifted by 360 deg if that brings it within 180 deg of `other_deg`.
  static double unwrapped_deg(double longitude_deg, double other_deg) {
    const double difference_deg = longitude_deg - other_deg;
    return difference_deg > 180.0 ? longitude_deg - 360.0
                                  : (difference_deg < -180.0 ? longitude_deg + 360.0 : longitude_deg);
  }
  static CoursePoint bezier_point(const CoursePoint& a, const CoursePoint& control, const CoursePoint& b, double t) {
    const double s = 1.0 - t;
    const auto at = [&](double from, double by, double to) { return s * s * from + 2 * s * t * by + t * t * to; };
    CoursePoint point{at(a.latitude_deg, control.latitude_deg, b.latitude_deg),
                      at(unwrapped_deg(a.longitude_deg, control.longitude_deg), control.longitude_deg,
                         unwrapped_deg(b.longitude_deg, control.longitude_deg)),
                      interpolated(a.river, b.river, t)};
    point.river.water_m = at(a.river.water_m, control.river.water_m, b.river.water_m);
    point.river.extent_m = at(a.river.extent_m, control.river.extent_m, b.river.extent_m);
    return point;
  }
  // Displaces a point by a noise field. The field depends on position only, so courses that meet stay connected.
  CoursePoint with_meanders(CoursePoint point) const {
    const double latitude = point.latitude_deg * geo::kRadiansPerDegree;
    const double longitude = geo::wrapped_degrees(point.longitude_deg) * geo::kRadiansPerDegree;
    constexpr double kRadius = 6371000.0 / kBend_m;
    const geo::Vector3 at{kRadius * std::cos(latitude) * std::cos(longitude),
                          kRadius * std::cos(latitude) * std::sin(longitude), kRadius * std::sin(latitude)};
    point.latitude_deg += kBendAmplitude_m * random::gradient_noise(at, seed_ + 1U) / kTileMetres;
    point.longitude_deg +=
        kBendAmplitude_m * random::gradient_noise(at, seed_ + 2U) / east_m_per_degree(point.latitude_deg);
    return point;
  }
  void add_piece(const CoursePoint& from, const CoursePoint& to) {
    RiverPiece piece;
    piece.from = {from.latitude_deg, geo::wrapped_degrees(from.longitude_deg)};
    piece.parallel = std::cos(mean(from.latitude_deg, to.latitude_deg) * geo::kRadiansPerDegree);
    piece.east_m =
        (unwrapped_deg(to.longitude_deg, from.longitude_deg) - from.longitude_deg) * kTileMetres * piece.parallel;
    piece.north_m = (to.latitude_deg - from.latitude_deg) * kTileMetres;
    piece.ends[0] = from.river;
    piece.ends[1] = to.river;
    pieces_.push_back(piece);
  }

  const ReliefTile& relief_;
  const Drainage& drainage_;
  std::uint32_t seed_;
  std::vector<RiverPiece> pieces_;
};

}  // namespace

std::vector<RiverPiece> river_pieces(const ReliefTile& relief, const Drainage& drainage, std::uint32_t seed) {
  return CourseMaker(relief, drainage, seed).pieces();
}

void RiverRow::add(const RiverPiece& piece) {
  const double extent_m = piece.extent_m();
  const double north_m = (latitude_deg_ - piece.from.latitude_deg) * kTileMetres;
  if (north_m < std::min(0.0, piece.north_m) - extent_m || north_m > std::max(0.0, piece.north_m) + extent_m) return;
  // Columns are evenly spaced, so a division gives the first and the last column near the piece, with a margin of one
  // column.
  const double first_deg = longitudes_deg_.front();
  double step_deg = longitudes_deg_[1] - first_deg;
  if (step_deg < 0) step_deg += 360.0;
  double offset_deg = piece.from.longitude_deg - first_deg;
  offset_deg -= 360.0 * std::floor(offset_deg / 360.0 + 0.5);
  const double metres_per_column = step_deg * kTileMetres * piece.parallel;
  const double at = offset_deg / step_deg;
  const double west = at + (std::min(0.0, piece.east_m) - extent_m) / metres_per_column - 1.0;
  const double east = at + (std::max(0.0, piece.east_m) + extent_m) / metres_per_column + 1.0;
  const auto count = static_cast<double>(longitudes_deg_.size());
  if (east < 0.0 || west >= count) return;
  const auto last = static_cast<std::size_t>(std::min(east, count - 1.0));
  for (auto post = static_cast<std::size_t>(std::max(0.0, west)); post <= last; ++post) {
    double offset_east_deg = longitudes_deg_[post] - piece.from.longitude_deg;
    if (offset_east_deg > 180.0) offset_east_deg -= 360.0;
    if (offset_east_deg < -180.0) offset_east_deg += 360.0;
    add_post(piece, post, offset_east_deg * kTileMetres * piece.parallel, north_m);
  }
}

void RiverRow::add_post(const RiverPiece& piece, std::size_t post, double east_m, double north_m) {
  const double square = piece.east_m * piece.east_m + piece.north_m * piece.north_m;
  const double t = std::clamp((east_m * piece.east_m + north_m * piece.north_m) / std::max(square, 1e-6), 0.0, 1.0);
  const double across_east_m = east_m - t * piece.east_m;
  const double across_north_m = north_m - t * piece.north_m;
  const double distance_square = across_east_m * across_east_m + across_north_m * across_north_m;
  const RiverPiece::End here = interpolated(piece.ends[0], piece.ends[1], t);
  if (distance_square >= here.extent_m * here.extent_m) return;
  const double distance_m = std::sqrt(distance_square);
  influences_.push_back(
      {post, here.water_m,
       distance_m < here.half_width_m ? -1.0 : random::smooth_step(here.floor_m, here.extent_m, distance_m)});
}

// Combines the influences of the pieces by minimum and maximum only, so that their order does not matter. First fills
// the ground below valley floors, then cuts the ground above them.
void RiverRow::shape(std::span<double> heights_m, std::span<float> valley) {
  std::vector<double> filled_m(heights_m.begin(), heights_m.end());
  for (const Influence& influence : influences_) {
    const double land_m = heights_m[influence.post];
    const double floor_m = influence.water_m + kFloorAboveWater_m;
    if (land_m <= 0.0 || land_m >= floor_m) continue;
    filled_m[influence.post] =
        std::max(filled_m[influence.post], floor_m + (land_m - floor_m) * std::max(0.0, influence.part));
  }
  for (const Influence& influence : influences_) {
    if (heights_m[influence.post] <= 0.0) continue;
    const double floor_m = influence.water_m + (influence.part < 0.0 ? 0.0 : kFloorAboveWater_m);
    const double cut_m = floor_m + (filled_m[influence.post] - floor_m) * std::max(0.0, influence.part);
    double& height_m = heights_m[influence.post];
    // The first influence on a post starts at the height of the filled ground.
    if (valley[influence.post] > 1.5F) height_m = filled_m[influence.post];
    valley[influence.post] = std::min(valley[influence.post], static_cast<float>(influence.part));
    height_m = std::min(height_m, cut_m);
  }
  for (float& part : valley) part = std::min(part, 1.0F);
}

}  // namespace yars::worldgen
