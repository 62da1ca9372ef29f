#include "model/hrm/map_image.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "lib/radar/mission.hpp"
#include "lib/radar/sensor.hpp"
#include "model/hrm/map_image_simd.hpp"
#include "model/physics/clutter_simd.hpp"
#include "model/physics/reflectivity.hpp"

namespace yars::model::hrm {

namespace {
// Lower bound of the sine of the grazing angle in unit_return_m2(). Without it the result, a divisor, could be 0.
constexpr double kMinGrazingSine = 1.0e-3;
}  // namespace

double unit_return_m2(const PatchGeometry& geometry, int pixels) {
  const double pixel_m = geometry.window_m() / pixels;
  return pixel_m * pixel_m * std::max(geometry.sin_grazing(), kMinGrazingSine);
}

namespace {
// Pixels of a row between which the sector draws. Up to 16 more at each end serve rounding and vectors.
void set_pixels(const PolarGrid& grid, int size, simd::MapRow& row) {
  constexpr double kReserve = 2.0;  // [pixels] above the rounding errors of float positions
  constexpr int kStep = 16;
  row.begin = 0;
  row.end = size;
  const auto pixel_at = [&](int column) {
    const double right_m = grid.tangent(column) * static_cast<double>(row.ahead_m);
    return (right_m - static_cast<double>(row.first_right_m)) / static_cast<double>(row.pixel_m);
  };
  const auto limited = [&](double pixel) { return static_cast<int>(std::clamp(pixel, 0.0, size + 0.0)); };
  if (grid.first_drawn_column() > 0)
    row.begin = limited(std::floor(pixel_at(grid.first_drawn_column()) - kReserve)) / kStep * kStep;
  if (grid.end_drawn_column() < grid.columns)
    row.end = limited(std::ceil(pixel_at(grid.end_drawn_column()) + kReserve));
}
}  // namespace

void draw_polar_grid(const PatchGeometry& geometry, const PolarGrid& grid, const float* cross_section_m2, int first,
                     int last, MapImage& image) {
  const double pixel_m = geometry.window_m() / image.size;
  const double edge_m = 0.5 * geometry.window_m();
  simd::MapRow row;
  row.first_right_m = static_cast<float>(0.5 * pixel_m - edge_m);
  row.pixel_m = static_cast<float>(pixel_m);
  row.scale = static_cast<float>(pixel_m * pixel_m / unit_return_m2(geometry, image.size));
  for (int line = first; line < last; ++line) {
    row.ahead_m = static_cast<float>(geometry.distance_m() + edge_m - (line + 0.5) * pixel_m);
    set_pixels(grid, image.size, row);
    simd::draw_row(grid, cross_section_m2, row, &image.power[image.at(0, line)]);
  }
}

namespace {
constexpr float kBlindPower = -1.0F;
// [rad] upper bound of the rounding errors of a pixel's angle and of an edge's. Both are below 1e-14 rad. With a
// smaller bound, pixels at an edge might differ from radar::in_blind_zone().
constexpr double kAngleError_rad = 1.0e-12;
constexpr double kMinCosine = 1.0e-18;  // keeps the column of an edge along a row finite
}  // namespace

BlindZone::BlindZone(const PatchGeometry& geometry, geo::Bearing ground_track, double half_width_deg, int size)
    : half_width_deg_(half_width_deg),
      squint_(geometry.squint(ground_track)),
      size_(size),
      distance_m_(geometry.distance_m()),
      edge_m_(0.5 * geometry.window_m()),
      pixel_m_(geometry.window_m() / size) {
  // At 90 degrees the two sectors meet.
  const double half_width_rad = std::clamp(half_width_deg, 0.0, 90.0) * geo::kRadiansPerDegree;
  const double doubt_columns = kAngleError_rad * (distance_m_ + 2.0 * edge_m_) / pixel_m_;
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    const double angle_rad = squint_.radians() + (i == 0 ? -half_width_rad : half_width_rad);
    const double sine = std::sin(angle_rad);
    const double cosine = std::cos(angle_rad);
    const double divisor = std::copysign(std::max(std::abs(cosine), kMinCosine), cosine);
    edges_[i] = {sine, cosine, -sine / divisor / pixel_m_, doubt_columns / std::abs(divisor)};
  }
}

bool BlindZone::may_reach_map() const {
  if (distance_m_ <= edge_m_) return true;
  // Half the angle that the map subtends at the aircraft, against the angle from the map's centre to the zone.
  const double half_view_deg = std::atan2(edge_m_, distance_m_ - edge_m_) / geo::kRadiansPerDegree;
  const double off_deg = std::abs(squint_.degrees());
  return std::min(off_deg, 180.0 - off_deg) - half_width_deg_ <= half_view_deg;
}

bool BlindZone::blank(int first, int last, MapImage& image) const {
  bool any = false;
  for (int row = first; row < last; ++row)
    if (blank_row(ahead_m(row), &image.power[image.at(0, row)])) any = true;
  return any;
}

bool BlindZone::blank_row(double ahead_m, float* power) const {
  std::array<Run, 2> crossings{doubtful(edges_[0], ahead_m), doubtful(edges_[1], ahead_m)};
  if (crossings[1].first < crossings[0].first) std::swap(crossings[0], crossings[1]);
  bool any = false;
  int done = 0;
  for (const Run& crossing : crossings) {
    if (blank_run({done, crossing.first}, ahead_m, power)) any = true;
    if (blank_by_angle({std::max(done, crossing.first), crossing.last}, ahead_m, power)) any = true;
    done = std::max(done, crossing.last);
  }
  return blank_run({done, size_}, ahead_m, power) || any;
}

// Blanks the run if its first pixel is blind. No edge crosses the run.
bool BlindZone::blank_run(Run run, double ahead_m, float* power) const {
  if (run.first >= run.last) return false;
  const auto cross = [&](const Edge& edge) { return right_m(run.first) * edge.cosine + ahead_m * edge.sine; };
  if (cross(edges_[0]) * cross(edges_[1]) >= 0.0) return false;
  std::fill(power + run.first, power + run.last, kBlindPower);
  return true;
}

bool BlindZone::blank_by_angle(Run run, double ahead_m, float* power) const {
  bool any = false;
  for (int column = run.first; column < run.last; ++column) {
    const geo::Angle off_centre = geo::Angle::radians(std::atan2(right_m(column), ahead_m));
    if (!radar::in_blind_zone(squint_ + off_centre, half_width_deg_)) continue;
    power[column] = kBlindPower;
    any = true;
  }
  return any;
}

// Pixels of a row within rounding of an edge.
BlindZone::Run BlindZone::doubtful(const Edge& edge, double ahead_m) const {
  const double crossing = edge_m_ / pixel_m_ - 0.5 + edge.columns_per_m * ahead_m;
  const auto column = [this](double wanted) { return static_cast<int>(std::clamp(wanted, 0.0, size_ + 0.0)); };
  return {column(std::ceil(crossing - edge.doubt_columns)), column(std::floor(crossing + edge.doubt_columns) + 1.0)};
}

namespace {
constexpr std::size_t kSlack = 16;  // entries that vectors may access beyond a row
// Length of a row of cells: kMapCells, and one more cell at each end, because the outermost pixels lie beyond the
// centres of the outermost cells.
constexpr int kCellsPerRow = radar::kMapCells + 2;

std::size_t padded(std::size_t count) {
  return (count + kSlack - 1) / kSlack * kSlack;
}
}  // namespace

Speckle::Speckle(int size, int looks, std::uint64_t seed, std::uint32_t map)
    : size_(size),
      looks_(looks),
      seed_(seed),
      map_(map),
      finer_(size > radar::kMapCells),
      pitch_(padded(static_cast<std::size_t>(size))),
      intensity_(pitch_ + kSlack) {
  if (!finer_) return;
  cell_.assign(pitch_, 0);
  first_.assign(pitch_, 0.0F);
  second_.assign(pitch_, 0.0F);
  for (int pixel = 0; pixel < size_; ++pixel) {
    const auto i = static_cast<std::size_t>(pixel);
    const CellWeights weights = cell_weights(pixel);
    cell_[i] = weights.cell;
    first_[i] = weights.first;
    second_[i] = weights.second;
  }
  std::fill(cell_.begin() + size_, cell_.end(), cell_[static_cast<std::size_t>(size_) - 1]);
  cells_.assign(2 * padded(kCellsPerRow) + 2 * kSlack, 0.0F);
  near_.assign(2 * static_cast<std::size_t>(looks_) * pitch_, 0.0F);
  far_ = near_;
}

Speckle::CellWeights Speckle::cell_weights(int pixel) const {
  const double cell_position = (pixel + 0.5) * radar::kMapCells / size_ - 0.5;
  const double cell = std::floor(cell_position);
  const double second = cell_position - cell;
  const double first = 1.0 - second;
  const double scale = 1.0 / std::sqrt(first * first + second * second);
  return {static_cast<std::int32_t>(cell) + 1, static_cast<float>(first * scale), static_cast<float>(second * scale)};
}

void Speckle::draw_cells(int cell_row, std::vector<float>& field) {
  const std::size_t half = padded(kCellsPerRow);
  for (int look = 0; look < looks_; ++look) {
    const auto name = static_cast<std::uint32_t>(cell_row * looks_ + look);
    simd::draw_gaussian(half, physics::make_noise_state({seed_, map_, name}), cells_.data(), &cells_[half]);
    float* real = &field[2 * static_cast<std::size_t>(look) * pitch_];
    simd::interpolate(pitch_, {cell_.data(), first_.data(), second_.data()}, cells_.data(), real);
    simd::interpolate(pitch_, {cell_.data(), first_.data(), second_.data()}, &cells_[half], real + pitch_);
  }
}

const float* Speckle::row(int row) {
  if (!finer_) {
    const auto name = static_cast<std::uint32_t>(row);
    physics::simd::speckle(static_cast<std::size_t>(size_), physics::make_noise_state({seed_, map_, name}), looks_, {},
                           intensity_.data());
    return intensity_.data();
  }
  const CellWeights weights = cell_weights(row);
  while (drawn_row_ < weights.cell + 1) {
    near_.swap(far_);
    drawn_row_ = drawn_row_ < weights.cell ? weights.cell : drawn_row_ + 1;
    draw_cells(drawn_row_, far_);
  }
  simd::intensity(pitch_, looks_, {near_.data(), weights.first}, {far_.data(), weights.second}, intensity_.data());
  return intensity_.data();
}

namespace {
// Slant range and window at which the configured noise_gamma_db applies.
constexpr double kNoiseRange_m = 20.0 * geo::kMetresPerNauticalMile;
constexpr double kNoiseWindow_m = 0.67 * geo::kMetresPerNauticalMile;
}  // namespace

double noise_gamma(const radar::HighResolutionConfiguration& configuration, geo::Length slant_range,
                   geo::Length window) {
  return physics::ratio(configuration.noise_gamma_db) * std::pow(slant_range.metres() / kNoiseRange_m, 3.0) *
         kNoiseWindow_m / window.metres();
}

namespace {
// Speckle of a row with weaker speckle in the pixels with point targets: `variates`, or a copy in `held`.
const float* hold_steady(const MapImage& image, std::size_t row, float thermal, const float* variates,
                         std::vector<float>& held) {
  const auto size = static_cast<std::size_t>(image.size);
  const auto before = [](const physics::SteadyPower& part, std::size_t pixel) { return part.at < pixel; };
  auto part = std::lower_bound(image.steady.begin(), image.steady.end(), row * size, before);
  const auto end = std::lower_bound(part, image.steady.end(), (row + 1) * size, before);
  if (part == end) return variates;
  held.assign(variates, variates + size + kSlack);
  while (part != end) {
    const std::uint32_t pixel = part->at;
    float steady = 0.0F;
    for (; part != end && part->at == pixel; ++part) steady += part->power;
    float& variate = held[pixel - row * size];
    variate = physics::with_steady(variate, static_cast<double>(steady / (image.power[pixel] + thermal)));
  }
  return held.data();
}
}  // namespace

void form_video(const radar::HighResolutionConfiguration& hrm, const MapImage& image, const MapNoise& noise, int first,
                int last, std::vector<std::uint8_t>& picture) {
  const auto size = static_cast<std::size_t>(image.size);
  Speckle speckle(image.size, noise.looks, noise.seed, noise.map);
  constexpr std::array<float, 3> kNoSmear{0.0F, 1.0F, 0.0F};
  const auto thermal = static_cast<float>(noise.thermal);
  std::vector<float> held;
  for (auto row = static_cast<std::size_t>(first); row < static_cast<std::size_t>(last); ++row) {
    const float* power = &image.power[row * size];
    const float* variates = noise.with_speckle ? speckle.row(static_cast<int>(row)) : nullptr;
    if (variates != nullptr) variates = hold_steady(image, row, thermal, variates, held);
    const physics::simd::VideoInputs inputs{power,
                                            power,
                                            power,
                                            kNoSmear.data(),
                                            thermal,
                                            variates,
                                            static_cast<float>(-hrm.brightest_gamma_db),
                                            static_cast<float>(hrm.dynamic_range_db),
                                            nullptr};
    physics::simd::form_video(size, inputs, &picture[row * size]);
    if (!image.blind) continue;
    // Without a branch, so that the compiler uses vectors.
    std::uint8_t* video = &picture[row * size];
    for (std::size_t i = 0; i < size; ++i) video[i] = power[i] < 0.0F ? std::uint8_t{0} : video[i];
  }
}

namespace {
constexpr float kNoNumber = std::numeric_limits<float>::quiet_NaN();

}  // namespace

void MapLabels::begin(const PatchGeometry& geometry, const PolarGrid& grid, std::size_t points) {
  if (!wanted()) return;
  above_plane_m_.clear();
  if (use_ == LabelUse::heights)
    for (int row = 0; row < grid.rows; ++row) above_plane_m_.push_back(geometry.above_plane_m(grid.distance_m(row)));
  if (surface_.size() < points) {
    surface_ = memory::CacheAlignedVector<std::uint32_t>(points);
    shown_row_ = memory::CacheAlignedVector<std::int32_t>(points);
    layers_ = memory::CacheAlignedVector<std::int32_t>(points);
    strength_ = memory::CacheAlignedVector<float>(points);
  }
  const std::size_t pixels = static_cast<std::size_t>(size_) * static_cast<std::size_t>(size_);
  pixels_.shadow.resize(pixels);
  pixels_.layover.resize(pixels);
  pixels_.object.resize(pixels);
  pixels_.material.resize(pixels);
  const std::size_t heights = use_ == LabelUse::heights ? pixels : 0;
  pixels_.height_m.resize(heights);
  pixels_.sin_grazing.resize(heights);
}

namespace {

// Nearest grid cells of the pixels of one row.
struct Cells {
  explicit Cells(int size) : left(static_cast<std::size_t>(size)), column(left.size()), row(left.size()) {}
  std::vector<std::int32_t> left;         // column to the left of the pixel, which decides the sector that draws it
  std::vector<std::int32_t> column, row;  // nearest ones
};

// Steps from pixels to the grid.
struct PixelGrid {
  PixelGrid(const PatchGeometry& map, const PolarGrid& polar, int pixels) : geometry(map), grid(polar), size(pixels) {}

  void find(int line, Cells& cells) const {
    const double ahead_m = geometry.distance_m() + (0.5 - (line + 0.5) / size) * geometry.window_m();
    const auto ahead = static_cast<float>(ahead_m);
    const auto columns_per_m = static_cast<float>(1.0 / (ahead_m * grid.tangent_step));
    const auto first_column = static_cast<float>(-grid.first_tangent / grid.tangent_step);
    const auto rows_per_m = static_cast<float>(1.0 / grid.spacing_m);
    const auto middle_row = static_cast<float>((ahead_m - grid.first_distance_m) / grid.spacing_m);
    const auto pixel_m = static_cast<float>(geometry.window_m() / size);
    const auto edge_m = static_cast<float>(0.5 * geometry.window_m());
    const auto last_column = static_cast<float>(grid.end_strip * kStripColumns - 1);
    const auto last_row = static_cast<float>(grid.rows - 1);
    for (int i = 0; i < size; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const float right_m = (static_cast<float>(i) + 0.5F) * pixel_m - edge_m;
      const float column = std::max(first_column + right_m * columns_per_m, 0.0F);
      // Distance minus ahead_m, in a form that keeps the precision of float.
      const float longer_m = right_m * right_m / (ahead + std::sqrt(ahead * ahead + right_m * right_m));
      const float row = std::max(middle_row + longer_m * rows_per_m, 0.0F);
      cells.left[at] = static_cast<std::int32_t>(column);
      cells.column[at] = static_cast<std::int32_t>(std::min(column + 0.5F, last_column));
      cells.row[at] = static_cast<std::int32_t>(std::min(row + 0.5F, last_row));
    }
  }

  const PatchGeometry& geometry;
  const PolarGrid& grid;
  int size;
};

}  // namespace

void MapLabels::draw(const PatchGeometry& geometry, const PolarGrid& grid, const SurfacePoint* surface, int first,
                     int last) {
  const PixelGrid pixels(geometry, grid, size_);
  Cells cells(size_);
  const int begin = grid.first_drawn_column(), end = grid.end_drawn_column();
  for (int line = first; line < last; ++line) {
    pixels.find(line, cells);
    std::size_t pixel = static_cast<std::size_t>(line) * static_cast<std::size_t>(size_);
    for (std::size_t i = 0; i < cells.column.size(); ++i, ++pixel) {
      if (cells.left[i] < begin || cells.left[i] >= end) continue;
      const std::size_t top = grid.at(cells.column[i], 0);
      set_pixel(pixel, top, top + static_cast<std::size_t>(cells.row[i]) * kStripColumns);
      if (use_ == LabelUse::heights)
        set_heights(pixel, geometry, grid, surface + top,
                    shown_row_[top + static_cast<std::size_t>(cells.row[i]) * kStripColumns]);
    }
  }
}

// `top`: entry of the column's row 0; `cell`: of the pixel's cell.
void MapLabels::set_pixel(std::size_t pixel, std::size_t top, std::size_t cell) {
  const bool dark = !(strength_[cell] > 0.0F);
  const std::uint32_t label = dark ? 0U : surface_[top + static_cast<std::size_t>(shown_row_[cell]) * kStripColumns];
  pixels_.shadow[pixel] = dark ? 1 : 0;
  pixels_.layover[pixel] = layers_[cell] > 1 ? 1 : 0;
  pixels_.object[pixel] = object_of(label);
  pixels_.material[pixel] = material_of(label);
}

// `column`: surface of the pixel's column, row 0; `row`: the row that it shows, undefined in shadow.
void MapLabels::set_heights(std::size_t pixel, const PatchGeometry& geometry, const PolarGrid& grid,
                            const SurfacePoint* column, std::int32_t row) {
  pixels_.height_m[pixel] = pixels_.sin_grazing[pixel] = kNoNumber;
  if (pixels_.shadow[pixel] != 0) return;
  const auto height_m = [&](std::int32_t at) { return column[static_cast<std::size_t>(at) * kStripColumns].height_m; };
  pixels_.height_m[pixel] = height_m(row) + static_cast<float>(geometry.plane_msl_m());
  // Sine of the angle between the line of sight and the piece of the profile that ends at the shown point.
  const std::int32_t far_row = std::max(row, 1);
  const auto up_m = [&](std::int32_t at) {
    return static_cast<double>(height_m(at)) - above_plane_m_[static_cast<std::size_t>(at)];
  };
  const double near_up_m = up_m(far_row - 1);
  const double climb_m = up_m(far_row) - near_up_m;
  const double middle_up_m = near_up_m + 0.5 * climb_m;
  const double distance_m = grid.distance_m(far_row - 0.5);
  const double across = distance_m * climb_m - middle_up_m * grid.spacing_m;
  const double lengths2 =
      (distance_m * distance_m + middle_up_m * middle_up_m) * (grid.spacing_m * grid.spacing_m + climb_m * climb_m);
  pixels_.sin_grazing[pixel] = static_cast<float>(std::clamp(across / std::sqrt(lengths2), 0.0, 1.0));
}

void MapLabels::clear_blind(const MapImage& image) {
  if (!wanted() || !image.blind) return;
  for (std::size_t pixel = 0; pixel < image.power.size(); ++pixel) {
    if (image.power[pixel] >= 0.0F) continue;
    pixels_.shadow[pixel] = pixels_.layover[pixel] = pixels_.material[pixel] = 0;
    pixels_.object[pixel] = -1;
    if (use_ == LabelUse::heights) pixels_.height_m[pixel] = pixels_.sin_grazing[pixel] = kNoNumber;
  }
}

}  // namespace yars::model::hrm
