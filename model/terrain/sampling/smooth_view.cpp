#include "model/terrain/sampling/smooth_view.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "lib/geo/geodesy.hpp"
#include "lib/memory/line_vector.hpp"
#include "model/terrain/formats/cell.hpp"
#include "model/terrain/sampling/height_simd.hpp"
#include "model/terrain/sampling/smooth_simd.hpp"

namespace yars::model::terrain {

namespace {

constexpr double kMaxLatitude_deg = 88.0;    // beyond it four posts do not span a rectangle on the ground
constexpr int kMaxParts = 64;                // maximum number of parts of an interval between posts
constexpr std::size_t kMaxNodes = 1U << 23;  // 32 MiB; in a cell with more nodes, intervals get fewer parts
constexpr float kNoHeight = std::numeric_limits<float>::quiet_NaN();

// Part of a cell that becomes smooth: the posts around the map's box, first and last included. Each rectangle between
// four posts is divided into row_parts x column_parts smaller rectangles. Their corners are the nodes.
struct Part {
  int first_row = 0, last_row = 0, first_column = 0, last_column = 0;
  int row_parts = 1, column_parts = 1;

  int rows() const { return (last_row - first_row) * row_parts + 1; }
  int columns() const { return (last_column - first_column) * column_parts + 1; }
  std::size_t nodes() const { return static_cast<std::size_t>(rows()) * static_cast<std::size_t>(columns()); }
};

int parts_of(double interval_m, const SmoothParameters& parameters) {
  const double parts = std::ceil(interval_m / parameters.spacing_m);
  const int min_parts = std::clamp(parameters.min_parts, 1, kMaxParts);
  return std::clamp(static_cast<int>(std::min(parts, double{kMaxParts})), min_parts, kMaxParts);
}

// The part of a cell within the box; nullopt if there is none, or if rows or columns are at most posts_m apart.
std::optional<Part> part_of(const Cell& cell, const SmoothParameters& parameters) {
  const auto [south_deg, west] = cell.corner();
  // Longitudes of the box may exceed 180 degrees. Whole turns of 360 degrees are removed.
  const double turn_deg = 360.0 * std::ceil((parameters.box.west_deg - (west + 1.0)) / 360.0);
  const auto post = [](double degrees, int intervals) { return std::clamp(degrees, 0.0, 1.0) * intervals; };
  const int row_intervals = cell.rows() - 1, column_intervals = cell.columns() - 1;
  Part part;
  part.first_row = static_cast<int>(std::floor(post(parameters.box.south_deg - south_deg, row_intervals)));
  part.last_row = static_cast<int>(std::ceil(post(parameters.box.north_deg - south_deg, row_intervals)));
  part.first_column = static_cast<int>(std::floor(post(parameters.box.west_deg - west - turn_deg, column_intervals)));
  part.last_column = static_cast<int>(std::ceil(post(parameters.box.east_deg - west - turn_deg, column_intervals)));
  if (part.first_row >= part.last_row || part.first_column >= part.last_column) return std::nullopt;
  // All cells take the box's middle latitude: neighbours with equal posts have equal nodes on their common edge.
  const double cos_latitude =
      std::cos(0.5 * (parameters.box.south_deg + parameters.box.north_deg) * geo::kRadiansPerDegree);
  const double rows_m = geo::kMetresPerDegree / row_intervals,
               columns_m = geo::kMetresPerDegree * cos_latitude / column_intervals;
  if (std::min(rows_m, columns_m) <= parameters.posts_m) return std::nullopt;
  part.row_parts = parts_of(rows_m, parameters);
  part.column_parts = parts_of(columns_m, parameters);
  while (part.nodes() > kMaxNodes && std::max(part.row_parts, part.column_parts) > 1) {
    part.row_parts = std::max(1, part.row_parts / 2);
    part.column_parts = std::max(1, part.column_parts / 2);
  }
  return part;
}

// Heights [m MSL] of the posts of a part and of one more post on each side, possibly of a neighbouring cell. NaN: void.
class Posts {
 public:
  Posts(const TerrainView& view, const Cell& cell, const Part& part)
      : part_(part),
        pitch_(static_cast<std::size_t>(part.last_column - part.first_column) + 3 + kRunSlack),
        height_m_(pitch_ * (static_cast<std::size_t>(part.last_row - part.first_row) + 3), 0.0F) {
    for (int row = part.first_row - 1; row <= part.last_row + 1; ++row)
      for (int column = part.first_column - 1; column <= part.last_column + 1; ++column)
        *at(row, column) = height_of(view, cell, row, column);
  }
  float* at(int row, int column) {
    return &height_m_[static_cast<std::size_t>(row - part_.first_row + 1) * pitch_ +
                      static_cast<std::size_t>(column - part_.first_column + 1)];
  }

 private:
  static float height_of(const TerrainView& view, const Cell& cell, int row, int column) {
    if (row >= 0 && row < cell.rows() && column >= 0 && column < cell.columns()) {
      const std::int16_t post = cell.post(row, column);
      return post == kVoidPost ? kNoHeight : static_cast<float>(post * cell.unit_m());
    }
    const double north_deg = static_cast<double>(row) / (cell.rows() - 1);
    const double east_deg = static_cast<double>(column) / (cell.columns() - 1);
    return static_cast<float>(view.elevation_m(
        {cell.corner().south_deg + north_deg, geo::wrapped_degrees(cell.corner().west_deg + east_deg)}));
  }

  Part part_;
  std::size_t pitch_;
  memory::CacheAlignedVector<float> height_m_;
};

// Grid of nodes of a part of one cell.
class Grid {
 public:
  Grid(const TerrainView& view, const Cell& cell, const Part& part)
      : corner_(cell.corner()), part_(part), height_m_(part.nodes() + kRunSlack) {
    nodes_.height_m = height_m_.data();
    nodes_.rows = part.rows();
    nodes_.columns = part.columns();
    nodes_.rows_per_degree = static_cast<float>((cell.rows() - 1) * part.row_parts);
    nodes_.first_row = static_cast<float>(part.first_row * part.row_parts);
    nodes_.columns_per_degree = static_cast<float>((cell.columns() - 1) * part.column_parts);
    nodes_.first_column = static_cast<float>(part.first_column * part.column_parts);
    Posts posts(view, cell, part);
    for (int row = part.first_row; row <= part.last_row; ++row)
      for (int column = part.first_column; column <= part.last_column; ++column)
        dry_ = dry_ && *posts.at(row, column) != 0.0F;
    along_columns(along_rows(posts));
  }

  Grid(Grid&&) noexcept = default;
  Grid& operator=(Grid&&) noexcept = default;

  CellCorner corner() const { return corner_; }
  bool dry() const { return dry_; }  // true if no post is at exactly 0 m, the height of water
  // Heights [m MSL] at positions [deg from the cell's south-west corner]. A height outside the grid of nodes is not
  // written. True if all positions lie inside.
  bool sample(const float* north_deg, const float* east_deg, std::size_t count, float* elevation_m) const {
    return smooth::heights(nodes_, north_deg, east_deg, count, elevation_m);
  }
  // Bilinear between nodes, in double precision; nullopt outside the grid.
  std::optional<double> height_m(double north_deg, double east_deg) const;
  // Makes the ground in the boxes bilinear between posts again. Around a box, smooth and bilinear ground are blended
  // over one post interval.
  void flatten(const std::vector<GeoBox>& boxes);

 private:
  using Rows = std::vector<memory::CacheAlignedVector<float>>;

  Rows along_rows(Posts& posts) const;
  void along_columns(const Rows& rows);
  float* row_at(int row) {
    return &height_m_[static_cast<std::size_t>(row) * static_cast<std::size_t>(nodes_.columns)];
  }
  void mark_plain(const GeoBox& box, std::vector<float>& weights) const;
  void blend(int row, int column, const std::vector<float>& weights, const memory::CacheAlignedVector<float>& smooth_m);

  CellCorner corner_;
  Part part_;
  bool dry_ = true;
  smooth::Nodes nodes_;
  memory::CacheAlignedVector<float> height_m_;
};

// First pass: interpolates every row of posts, and one more row on each side, to the columns of nodes.
Grid::Rows Grid::along_rows(Posts& posts) const {
  const auto columns = static_cast<std::size_t>(nodes_.columns);
  const auto parts = static_cast<std::size_t>(part_.column_parts);
  const auto count = static_cast<std::size_t>(part_.last_column - part_.first_column) + 1;
  memory::CacheAlignedVector<float> slope(count + kRunSlack), heights(count + kRunSlack);
  Rows rows;
  for (int row = part_.first_row - 1; row <= part_.last_row + 1; ++row) {
    const float* const here = posts.at(row, part_.first_column);
    memory::CacheAlignedVector<float>& nodes = rows.emplace_back(columns + kRunSlack, 0.0F);
    smooth::limited_slopes(count, {here - 1, here, here + 1}, slope.data());
    for (std::size_t i = 0; i < count; ++i) nodes[i * parts] = here[i];
    for (std::size_t k = 1; k < parts; ++k) {
      const float fraction = static_cast<float>(k) / static_cast<float>(parts);
      smooth::between(count - 1, {here, here + 1, slope.data(), slope.data() + 1}, fraction, heights.data());
      for (std::size_t i = 0; i + 1 < count; ++i) nodes[i * parts + k] = heights[i];
    }
  }
  return rows;
}

// Second pass: interpolates between the rows of the first pass to the rows of nodes.
void Grid::along_columns(const Rows& rows) {
  const auto columns = static_cast<std::size_t>(nodes_.columns);
  memory::CacheAlignedVector<float> near_slope(columns + kRunSlack), far_slope(columns + kRunSlack);
  smooth::limited_slopes(columns, {rows[0].data(), rows[1].data(), rows[2].data()}, far_slope.data());
  // SIMD code writes past the end of a row. Rows are computed in ascending order: the next row overwrites the excess.
  int at = 0;
  for (std::size_t post = 1; post + 2 < rows.size(); ++post) {
    std::swap(near_slope, far_slope);
    smooth::limited_slopes(columns, {rows[post].data(), rows[post + 1].data(), rows[post + 2].data()},
                           far_slope.data());
    std::copy_n(rows[post].begin(), columns, row_at(at++));
    for (int k = 1; k < part_.row_parts; ++k) {
      const float fraction = static_cast<float>(k) / static_cast<float>(part_.row_parts);
      smooth::between(columns, {rows[post].data(), rows[post + 1].data(), near_slope.data(), far_slope.data()},
                      fraction, row_at(at++));
    }
  }
  std::copy_n(rows[rows.size() - 2].begin(), columns, row_at(at));
}

std::optional<double> Grid::height_m(double north_deg, double east_deg) const {
  const double row = north_deg * static_cast<double>(nodes_.rows_per_degree) - static_cast<double>(nodes_.first_row);
  const double column =
      east_deg * static_cast<double>(nodes_.columns_per_degree) - static_cast<double>(nodes_.first_column);
  if (!(row >= 0.0 && row <= nodes_.rows - 1 && column >= 0.0 && column <= nodes_.columns - 1)) return std::nullopt;
  const int south = std::min(static_cast<int>(row), nodes_.rows - 2);
  const int west = std::min(static_cast<int>(column), nodes_.columns - 2);
  double weights = 0.0, sum = 0.0;
  for (const int up : {0, 1})
    for (const int right : {0, 1}) {
      const float node = height_m_[static_cast<std::size_t>(south + up) * static_cast<std::size_t>(nodes_.columns) +
                                   static_cast<std::size_t>(west + right)];
      if (std::isnan(node)) continue;
      const double weight =
          (up == 1 ? row - south : 1.0 - row + south) * (right == 1 ? column - west : 1.0 - column + west);
      weights += weight;
      sum += weight * static_cast<double>(node);
    }
  return weights > 0.0 ? sum / weights : std::numeric_limits<double>::quiet_NaN();
}

// Sets the blending weight of the smooth ground to 0 at the posts in a box and at the next posts around it. `weights`
// has one weight for each post of the part.
void Grid::mark_plain(const GeoBox& box, std::vector<float>& weights) const {
  const double rows_per_degree = static_cast<double>(nodes_.rows_per_degree) / part_.row_parts;
  const double columns_per_degree = static_cast<double>(nodes_.columns_per_degree) / part_.column_parts;
  const double turn_deg = 360.0 * std::round((box.west_deg - corner_.west_deg) / 360.0);
  const double west_deg = box.west_deg - corner_.west_deg - turn_deg;
  const int rows = part_.last_row - part_.first_row, columns = part_.last_column - part_.first_column;
  const auto post = [](double coordinate, int first, int last) {
    return static_cast<int>(std::clamp(coordinate - first, -1.0, last + 1.0));
  };
  const int south = post(std::floor((box.south_deg - corner_.south_deg) * rows_per_degree), part_.first_row, rows);
  const int north = post(std::ceil((box.north_deg - corner_.south_deg) * rows_per_degree), part_.first_row, rows);
  const int west = post(std::floor(west_deg * columns_per_degree), part_.first_column, columns);
  const int east =
      post(std::ceil((west_deg + box.east_deg - box.west_deg) * columns_per_degree), part_.first_column, columns);
  for (int row = std::max(south, 0); row <= std::min(north, rows); ++row)
    for (int column = std::max(west, 0); column <= std::min(east, columns); ++column)
      weights[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns + 1) +
              static_cast<std::size_t>(column)] = 0.0F;
}

void Grid::flatten(const std::vector<GeoBox>& boxes) {
  if (boxes.empty()) return;
  const int rows = part_.last_row - part_.first_row, columns = part_.last_column - part_.first_column;
  std::vector<float> weights(static_cast<std::size_t>(rows + 1) * static_cast<std::size_t>(columns + 1), 1.0F);
  for (const GeoBox& box : boxes) mark_plain(box, weights);
  // Smooth heights from one row of posts to the next. The blending of a row changes nodes that the next row has, too.
  const auto pitch = static_cast<std::size_t>(nodes_.columns);
  const std::size_t strip = static_cast<std::size_t>(part_.row_parts) * pitch;
  memory::CacheAlignedVector<float> smooth_m(strip + pitch);
  std::copy_n(row_at(0), pitch, smooth_m.begin());
  for (int row = 0; row < rows; ++row) {
    std::copy_n(row_at(row * part_.row_parts + 1), strip, smooth_m.begin() + nodes_.columns);
    for (int column = 0; column < columns; ++column) blend(row, column, weights, smooth_m);
    std::copy_n(smooth_m.end() - nodes_.columns, pitch, smooth_m.begin());
  }
}

// Blends smooth and bilinear heights in the rectangle between four posts, including its edges. Adjacent rectangles give
// equal heights on their common edge. A rectangle with a void corner stays smooth. `smooth_m`: heights of the nodes
// from the rectangle's southern row of posts to its northern one.
void Grid::blend(int row, int column, const std::vector<float>& weights,
                 const memory::CacheAlignedVector<float>& smooth_m) {
  const std::size_t pitch = static_cast<std::size_t>(part_.last_column - part_.first_column) + 1;
  const std::size_t at = static_cast<std::size_t>(row) * pitch + static_cast<std::size_t>(column);
  const std::array<float, 4> smoothness{weights[at], weights[at + 1], weights[at + pitch], weights[at + pitch + 1]};
  if (smoothness == std::array{1.0F, 1.0F, 1.0F, 1.0F}) return;
  const int first_row = row * part_.row_parts, first_column = column * part_.column_parts;
  const int last_row = first_row + part_.row_parts, last_column = first_column + part_.column_parts;
  const auto smooth_at = [&](int i, int j) {
    return smooth_m[static_cast<std::size_t>(i - first_row) * static_cast<std::size_t>(nodes_.columns) +
                    static_cast<std::size_t>(j)];
  };
  const std::array<float, 4> corner{smooth_at(first_row, first_column), smooth_at(first_row, last_column),
                                    smooth_at(last_row, first_column), smooth_at(last_row, last_column)};
  if (std::isnan(corner[0] + corner[1] + corner[2] + corner[3])) return;
  const auto between = [](const std::array<float, 4>& corners, float up, float right) {
    const float south = corners[0] + right * (corners[1] - corners[0]),
                north = corners[2] + right * (corners[3] - corners[2]);
    return south + up * (north - south);
  };
  const bool plain = smoothness == std::array{0.0F, 0.0F, 0.0F, 0.0F};
  for (int i = first_row; i <= last_row; ++i)
    for (int j = first_column; j <= last_column; ++j) {
      const float up = static_cast<float>(i - first_row) / static_cast<float>(part_.row_parts);
      const float right = static_cast<float>(j - first_column) / static_cast<float>(part_.column_parts);
      const float bilinear_m = between(corner, up, right);
      row_at(i)[j] = plain ? bilinear_m : bilinear_m + between(smoothness, up, right) * (smooth_at(i, j) - bilinear_m);
    }
}

// View that samples the grids of nodes where a cell has nodes, and the original view elsewhere.
class SmoothView final : public TerrainView {
 public:
  SmoothView(TerrainViewPointer view, std::vector<Grid> grids) : view_(std::move(view)), grids_(std::move(grids)) {}

  std::uint64_t generation() const override { return view_->generation(); }
  std::uint64_t resident_bytes() const override { return view_->resident_bytes(); }
  Surface surface_at(geo::GeoPoint position, Interpolation interpolation) const override;
  bool has_detail(int detail) const override { return view_->has_detail(detail); }
  bool has_peaks() const override { return view_->has_peaks(); }
  double post_spacing_m() const override { return view_->post_spacing_m(); }
  PostSpacing post_spacing_at(geo::GeoPoint position) const override { return view_->post_spacing_at(position); }
  std::vector<std::shared_ptr<const Cell>> cells_within(const GeoBox& box) const override {
    return view_->cells_within(box);
  }
  bool has_materials() const override { return view_->has_materials(); }
  std::size_t surfaces(const PositionRun& positions, Interpolation interpolation,
                       const SurfaceRun& found) const override;
  bool crests(const PositionRun& positions, const RaySight& sight, std::span<float> tangent) const override;

 private:
  const Grid* grid_of(CellCorner corner) const {
    const auto found =
        std::find_if(grids_.begin(), grids_.end(), [&](const Grid& grid) { return grid.corner() == corner; });
    return found == grids_.end() ? nullptr : &*found;
  }

  const Grid* grid_at(const PositionRun& positions, std::size_t first) const;
  // Writes the heights of positions inside grids of nodes. True if all are inside, and no grid used has water posts.
  bool sample(const PositionRun& positions, std::span<float> elevation_m) const;

  TerrainViewPointer view_;
  std::vector<Grid> grids_;
};

Surface SmoothView::surface_at(geo::GeoPoint position, Interpolation interpolation) const {
  Surface surface = view_->surface_at(position, interpolation);
  if (interpolation != Interpolation::bilinear || std::isnan(surface.elevation_m)) return surface;
  const CellCorner corner = cell_containing(position);
  const Grid* const grid = grid_of(corner);
  if (grid == nullptr) return surface;
  const double east_deg = geo::wrapped_degrees(position.longitude_deg) - corner.west_deg;
  if (const auto height_m = grid->height_m(position.latitude_deg - corner.south_deg, east_deg)) {
    // A reduced cell has separate maximum heights (peaks), which stay unchanged.
    if (surface.peak_m == surface.elevation_m) surface.peak_m = *height_m;
    surface.elevation_m = *height_m;
  }
  return surface;
}

// Grid of nodes of the cell that contains position `first`; null if the cell has no nodes.
const Grid* SmoothView::grid_at(const PositionRun& positions, std::size_t first) const {
  const geo::GeoPoint middle{positions.corner.south_deg + 0.5 + static_cast<double>(positions.cells_north[first]),
                             positions.corner.west_deg + 0.5 + static_cast<double>(positions.cells_east[first])};
  // No grid lies near a pole.
  return std::abs(middle.latitude_deg) < kMaxLatitude_deg + 1.0 ? grid_of(cell_containing(middle)) : nullptr;
}

// The original view's crests() samples a ray where it crosses the straight lines between posts. Smooth ground has no
// such lines. The tangents of positions in cells with nodes therefore become kNoTangent.
bool SmoothView::crests(const PositionRun& positions, const RaySight& sight, std::span<float> tangent) const {
  if (!view_->crests(positions, sight, tangent)) return false;
  for (std::size_t first = 0; first < tangent.size();) {
    const std::size_t run_length =
        sampling::same_cell_count(&positions.cells_north[first], &positions.cells_east[first], tangent.size() - first);
    if (grid_at(positions, first) != nullptr)
      std::fill_n(tangent.begin() + static_cast<std::ptrdiff_t>(first), run_length, kNoTangent);
    first += run_length;
  }
  return true;
}

bool SmoothView::sample(const PositionRun& positions, std::span<float> elevation_m) const {
  const std::size_t count = positions.north_deg.size();
  bool all = true;
  for (std::size_t first = 0; first < count;) {
    const std::size_t run_length =
        sampling::same_cell_count(&positions.cells_north[first], &positions.cells_east[first], count - first);
    const Grid* const grid = grid_at(positions, first);
    const bool within = grid != nullptr && grid->sample(&positions.north_deg[first], &positions.east_deg[first],
                                                        run_length, &elevation_m[first]);
    all = all && within && grid->dry();
    first += run_length;
  }
  return all;
}

std::size_t SmoothView::surfaces(const PositionRun& positions, Interpolation interpolation,
                                 const SurfaceRun& found) const {
  if (interpolation != Interpolation::bilinear) return view_->surfaces(positions, interpolation, found);
  if (found.material.empty() && found.peak_m.empty() && sample(positions, found.elevation_m)) {
    std::fill(found.water.begin(), found.water.end(), 0.0F);
    return 0;
  }
  const std::size_t pending = view_->surfaces(positions, interpolation, found);
  sample(positions, found.elevation_m);
  if (!has_peaks() && !found.peak_m.empty())
    std::copy(found.elevation_m.begin(), found.elevation_m.end(), found.peak_m.begin());
  return pending;
}

}  // namespace

TerrainViewPointer smooth_between_posts(const TerrainViewPointer& view, const SmoothParameters& parameters) {
  const auto& box = parameters.box;
  const bool near_pole = std::max(std::abs(box.south_deg), std::abs(box.north_deg)) > kMaxLatitude_deg;
  if (near_pole || !(parameters.spacing_m > 0.0)) return view;
  std::vector<Grid> grids;
  for (const std::shared_ptr<const Cell>& cell : view->cells_within(box))
    if (const std::optional<Part> part = part_of(*cell, parameters)) {
      grids.emplace_back(*view, *cell, *part);
      grids.back().flatten(parameters.bilinear_boxes);
    }
  if (grids.empty()) return view;
  return std::make_shared<SmoothView>(view, std::move(grids));
}

}  // namespace yars::model::terrain
