#include "worldgen/terrain/rivers.hpp"

#include <algorithm>
#include <cmath>

#include "lib/geo/frames.hpp"
#include "lib/random/gradient_noise.hpp"

namespace yars::worldgen {

namespace {

constexpr double kBend_m = 1150.0;      // [m] wavelength of meanders
constexpr double kBendAside_m = 170.0;  // [m] to either side
constexpr int kPiecesPerNode = 5;
constexpr double kFloorAboveWater_m = 1.0;

double half_width_m(double area_km2) {
  return 10.0 + 2.2 * std::sqrt(area_km2);
}

// A point of the plane that a course is drawn in, and what the river is there.
struct Knot {
  double latitude_deg, longitude_deg;  // longitude may pass 180: neighbours are told apart by differences
  RiverPiece::End river;
};

double mean(double a, double b) {
  return 0.5 * (a + b);
}
RiverPiece::End mixed(const RiverPiece::End& a, const RiverPiece::End& b, double t) {
  const auto mix = [t](double x, double y) { return x + t * (y - x); };
  return {mix(a.water_m, b.water_m), mix(a.half_width_m, b.half_width_m), mix(a.floor_m, b.floor_m),
          mix(a.reach_m, b.reach_m)};
}

// The river between a node and the next: as wide as what the upper node drains; a deep cut has wide slopes.
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
      curve(middle(node), drainage_.nodes[static_cast<std::size_t>(node.downstream)]);
    }
    for (std::size_t index = 0; index < drainage_.nodes.size(); ++index) {
      const RiverNode& node = drainage_.nodes[index];
      bool entered = has_source[index];
      for (const RiverEntry& entry : drainage_.entries) {
        const TileNode target = gate_target(entry.gate);
        if (target.row != node.row || target.column != node.column || entry.area_km2 < kRiverKm2) continue;
        curve(gate_knot(entry.gate, entry.area_km2, gate_target(entry.gate), -1), node);
        entered = true;
      }
      if (!entered) curve(knot(node), node);  // a spring
    }
    return std::move(pieces_);
  }

 private:
  // Nodes stand scattered about their lattice places, or rivers would show the lattice.
  Knot place_of(int row, int column) const {
    const int earth_row = (relief_.place().south_deg + 90) * kTileNodes + row;
    const int round = model::terrain::kCellColumns * kTileNodes;
    const int earth_column = ((relief_.place().west_deg + 180) * kTileNodes + column + round) % round;
    const std::uint32_t hash = random::lattice_hash(earth_column, earth_row, 2, seed_);
    const double north = 0.7 * (static_cast<double>(hash >> 16U) / 65536.0 - 0.5);
    const double east = 0.7 * (static_cast<double>(hash & 0xFFFFU) / 65536.0 - 0.5);
    return {(earth_row + north) / kTileNodes - 90.0, (earth_column + east) / kTileNodes - 180.0, {}};
  }
  Knot knot(const RiverNode& node) const {
    Knot knot = place_of(node.row, node.column);
    knot.river = river_of(node.area_km2, node.water_m, node.ground_m - node.water_m);
    return knot;
  }
  static Knot between(const Knot& a, const Knot& b, double area_km2) {
    const double turn = std::abs(a.longitude_deg - b.longitude_deg) > 180.0 ? 360.0 : 0.0;
    const double east_deg = b.longitude_deg + (b.longitude_deg < a.longitude_deg ? turn : -turn);
    Knot knot{mean(a.latitude_deg, b.latitude_deg), mean(a.longitude_deg, east_deg), mixed(a.river, b.river, 0.5)};
    const RiverPiece::End whole = river_of(area_km2, knot.river.water_m, 0.0);
    knot.river.half_width_m = whole.half_width_m;
    knot.river.floor_m = whole.floor_m;
    return knot;
  }
  // Half way to the next node.
  Knot middle(const RiverNode& node) const {
    return between(knot(node), knot(drainage_.nodes[static_cast<std::size_t>(node.downstream)]), node.area_km2);
  }
  // Half way through a gate, from its node in this tile; `sense` 1 = out of the tile. Both tiles draw it alike.
  Knot gate_knot(const RiverGate& gate, double area_km2, TileNode node, int sense) const {
    const Knot here = place_of(node.row, node.column);
    const Knot beyond = place_of(node.row + sense * gate.north, node.column + sense * gate.east);
    // Of equal bits from both sides: the source first.
    Knot middle = sense > 0 ? between(here, beyond, area_km2) : between(beyond, here, area_km2);
    middle.river = river_of(area_km2, gate.bed_m, 40.0);
    return middle;
  }

  // From `start` by the node toward the next one: a bend without a corner (quadratic Bezier).
  void curve(const Knot& start, const RiverNode& node) {
    Knot end = knot(node);
    if (node.downstream >= 0) end = middle(node);
    if (node.exit >= 0) {
      const auto exit = static_cast<std::size_t>(node.exit);
      end = gate_knot(drainage_.exits[exit], drainage_.exits_km2[exit], gate_source(drainage_.exits[exit]), 1);
    }
    const Knot control = knot(node);
    Knot last = bent(start);
    for (int step = 1; step <= kPiecesPerNode; ++step) {
      const Knot next = bent(point_of(start, control, end, static_cast<double>(step) / kPiecesPerNode));
      add_piece(last, next);
      last = next;
    }
  }
  static double near(double longitude_deg, double other_deg) {
    const double way = longitude_deg - other_deg;
    return way > 180.0 ? longitude_deg - 360.0 : (way < -180.0 ? longitude_deg + 360.0 : longitude_deg);
  }
  static Knot point_of(const Knot& a, const Knot& control, const Knot& b, double t) {
    const double s = 1.0 - t;
    const auto at = [&](double from, double by, double to) { return s * s * from + 2 * s * t * by + t * t * to; };
    Knot knot{at(a.latitude_deg, control.latitude_deg, b.latitude_deg),
              at(near(a.longitude_deg, control.longitude_deg), control.longitude_deg,
                 near(b.longitude_deg, control.longitude_deg)),
              mixed(a.river, b.river, t)};
    knot.river.water_m = at(a.river.water_m, control.river.water_m, b.river.water_m);
    knot.river.reach_m = at(a.river.reach_m, control.river.reach_m, b.river.reach_m);
    return knot;
  }
  // Pushed aside by a field of bends: a function of place, so that courses which meet still meet.
  Knot bent(Knot knot) const {
    const double latitude = knot.latitude_deg * geo::kRadiansPerDegree;
    const double longitude = geo::wrapped_degrees(knot.longitude_deg) * geo::kRadiansPerDegree;
    constexpr double kRadius = 6371000.0 / kBend_m;
    const geo::Vector3 at{kRadius * std::cos(latitude) * std::cos(longitude),
                          kRadius * std::cos(latitude) * std::sin(longitude), kRadius * std::sin(latitude)};
    knot.latitude_deg += kBendAside_m * random::gradient_noise(at, seed_ + 1U) / kTileMetres;
    knot.longitude_deg += kBendAside_m * random::gradient_noise(at, seed_ + 2U) / east_m_per_degree(knot.latitude_deg);
    return knot;
  }
  void add_piece(const Knot& from, const Knot& to) {
    RiverPiece piece;
    piece.from = {from.latitude_deg, geo::wrapped_degrees(from.longitude_deg)};
    piece.parallel = std::cos(mean(from.latitude_deg, to.latitude_deg) * geo::kRadiansPerDegree);
    piece.east_m = (near(to.longitude_deg, from.longitude_deg) - from.longitude_deg) * kTileMetres * piece.parallel;
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
  const double reach_m = piece.reach_m();
  const double north_m = (latitude_deg_ - piece.from.latitude_deg) * kTileMetres;
  if (north_m < std::min(0.0, piece.north_m) - reach_m || north_m > std::max(0.0, piece.north_m) + reach_m) return;
  // Columns are even: find the first and the last by division, a column to spare on either side.
  const double first_deg = longitudes_deg_.front();
  double step_deg = longitudes_deg_[1] - first_deg;
  if (step_deg < 0) step_deg += 360.0;
  double offset_deg = piece.from.longitude_deg - first_deg;
  offset_deg -= 360.0 * std::floor(offset_deg / 360.0 + 0.5);
  const double metres_per_column = step_deg * kTileMetres * piece.parallel;
  const double at = offset_deg / step_deg;
  const double west = at + (std::min(0.0, piece.east_m) - reach_m) / metres_per_column - 1.0;
  const double east = at + (std::max(0.0, piece.east_m) + reach_m) / metres_per_column + 1.0;
  const auto count = static_cast<double>(longitudes_deg_.size());
  if (east < 0.0 || west >= count) return;
  const auto last = static_cast<std::size_t>(std::min(east, count - 1.0));
  for (auto post = static_cast<std::size_t>(std::max(0.0, west)); post <= last; ++post) {
    double way_deg = longitudes_deg_[post] - piece.from.longitude_deg;
    if (way_deg > 180.0) way_deg -= 360.0;
    if (way_deg < -180.0) way_deg += 360.0;
    add_post(piece, post, way_deg * kTileMetres * piece.parallel, north_m);
  }
}

void RiverRow::add_post(const RiverPiece& piece, std::size_t post, double east_m, double north_m) {
  const double square = piece.east_m * piece.east_m + piece.north_m * piece.north_m;
  const double t = std::clamp((east_m * piece.east_m + north_m * piece.north_m) / std::max(square, 1e-6), 0.0, 1.0);
  const double aside_east = east_m - t * piece.east_m;
  const double aside_north = north_m - t * piece.north_m;
  const double way_square = aside_east * aside_east + aside_north * aside_north;
  const RiverPiece::End here = mixed(piece.ends[0], piece.ends[1], t);
  if (way_square >= here.reach_m * here.reach_m) return;
  const double way_m = std::sqrt(way_square);
  touches_.push_back(
      {post, here.water_m, way_m < here.half_width_m ? -1.0 : random::smooth_step(here.floor_m, here.reach_m, way_m)});
}

// Least and greatest only: the order of pieces does not matter.
void RiverRow::shape(std::span<double> heights_m, std::span<float> valley) {
  std::vector<double> filled_m(heights_m.begin(), heights_m.end());
  for (const Touch& touch : touches_) {
    const double land_m = heights_m[touch.post];
    const double floor_m = touch.water_m + kFloorAboveWater_m;
    if (land_m <= 0.0 || land_m >= floor_m) continue;
    filled_m[touch.post] = std::max(filled_m[touch.post], floor_m + (land_m - floor_m) * std::max(0.0, touch.part));
  }
  for (const Touch& touch : touches_) {
    if (heights_m[touch.post] <= 0.0) continue;
    const double floor_m = touch.water_m + (touch.part < 0.0 ? 0.0 : kFloorAboveWater_m);
    const double cut_m = floor_m + (filled_m[touch.post] - floor_m) * std::max(0.0, touch.part);
    double& height_m = heights_m[touch.post];
    // The first touch of a post starts from the filled ground.
    if (valley[touch.post] > 1.5F) height_m = filled_m[touch.post];
    valley[touch.post] = std::min(valley[touch.post], static_cast<float>(touch.part));
    height_m = std::min(height_m, cut_m);
  }
  for (float& part : valley) part = std::min(part, 1.0F);
}

}  // namespace yars::worldgen
