#include "model/hrm/reference.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "model/physics/ray.hpp"
#include "model/physics/reflectivity.hpp"

namespace yars::model::hrm {

namespace {
// GroundWalk is physics::GroundWalk (ray.hpp), which samples the ground along a ray at a fraction of the post spacing.
// The path is the ground from the aircraft to row 0 of the polar grid.

constexpr double kPathSpacing_m = 15.0;  // [m] spacing of samples on the path if its terrain has no posts
constexpr double kSeaSpacing_m = 100.0;  // [m] spacing of samples on ground without posts (sea), which GroundWalk omits
// Steps of GroundWalk per post spacing on the path, if rows are closer than kFineSpacing [post spacings]: the edges of
// shadows that the path casts must be exact to a row.
constexpr double kFineSpacing = 0.1;
constexpr double kFineSteps = 40.0;
constexpr double kNoTangent = -std::numeric_limits<double>::infinity();
constexpr double kFacetPixels = 1.0 / 3.0;  // [pixels] maximum side of a facet, a piece of ground or of a face
constexpr int kMaxFacets = 512;             // maximum facets per edge; limits the work for a large face
constexpr double kBuried_m = 0.05;          // [m] points more than this below the ground are not visible
constexpr double kFoot_m = 0.3;             // [m] from a wall towards the radar, to the ground point of its bounce
}  // namespace

// A point and the ground below it. Heights are above the map plane.
struct Reference::Ground {
  double distance_m, point_height_m;  // of the point: distance over ground, height
  double height_m, horizon;           // height of the ground; greatest tangent of elevation angle of nearer ground
};

Reference::Reference(const physics::RadarParameters& parameters)
    : fidelity_(parameters.fidelity),
      surface_(parameters),
      gas_(parameters),
      bounce_(fidelity_.map_double_bounce ? physics::ratio(parameters.high_resolution.double_bounce_db) : 0.0),
      power_picture_(parameters) {}

void Reference::begin(const PatchData& data) {
  geometry_ = &*data.geometry;
  grid_ = &data.grid;
  height_m_.assign(grid_->size(), 0.0);
  top_m_.assign(grid_->size(), 0.0);
  horizon_.assign(grid_->size(), 0.0);
  faces_.clear();
  occluders_ = Occluders();
}

// Position in the radar's frame: y horizontal towards the map's centre, x to the right of y, z up (occluders.hpp).
// `turn_rad`: bearing minus the bearing of the map's centre. `height_m`: above the map plane.
Point3 Reference::position(double distance_m, double turn_rad, double height_m) const {
  const physics::Sight sight =
      geometry_->earth_above_plane().sight(geometry_->altitude_m() - geometry_->plane_msl_m(), distance_m, height_m);
  const double out_m = sight.slant_range_m * std::cos(sight.elevation_rad);
  return {out_m * std::sin(turn_rad), out_m * std::cos(turn_rad), sight.slant_range_m * std::sin(sight.elevation_rad)};
}

void Reference::read_terrain(const PatchInputs& inputs, PatchData& /*data*/) {
  for (int column = 0; column < grid_->columns; ++column) read_column(inputs.environment, column);
}

void Reference::read_column(const PatchEnvironment& terrain, int column) {
  const PolarGrid& grid = *grid_;
  const physics::EffectiveEarth& earth = geometry_->earth();
  physics::SweepGeometry sweep;
  sweep.apex = geometry_->apex();
  sweep.altitude = geo::AltitudeMsl::metres(geometry_->altitude_m());
  sweep.azimuth = geometry_->up() + geo::Angle::radians(std::atan(grid.tangent(column)));
  const geo::GeodesicRay ray(sweep.apex, sweep.azimuth);
  double horizon = kNoTangent;
  const auto height_m = [&](const terrain::TerrainView& view, double distance_m) {
    const terrain::Surface found =
        view.surface_at(ray.position(geo::Length::metres(distance_m)), fidelity_.interpolation);
    return found.elevation_m - geometry_->plane_msl_m();
  };
  // Raises the horizon to a greater tangent. The comparison is false for NaN, which marks a void.
  const auto raise = [&](double candidate) {
    if (candidate > horizon) horizon = candidate;
  };
  // Samples ground without posts, which GroundWalk omits. The sea, for example, hides what is below the radar horizon.
  const auto raise_between = [&](const terrain::TerrainView& view, double from_m, double to_m, double step_m) {
    const auto steps = static_cast<int>(std::ceil((to_m - from_m) / step_m));
    for (int step = 1; step < steps; ++step) {
      const double distance_m = from_m + step * step_m;
      raise(tangent(distance_m, height_m(view, distance_m)));
    }
  };
  const bool posts = terrain.path->post_spacing_m() > 0.0;
  raise_between(*terrain.path, 0.0, grid.first_distance_m, posts ? kSeaSpacing_m : kPathSpacing_m);
  const double posts_m = terrain.window->post_spacing_m();
  const double steps = grid.spacing_m > kFineSpacing * posts_m ? physics::GroundWalk::kStepsPerPost : kFineSteps;
  raise(physics::GroundWalk(sweep, earth, *terrain.path, fidelity_.interpolation, steps)
            .highest_tangent(0.0, grid.first_distance_m));
  const physics::GroundWalk ground_walk(sweep, earth, *terrain.window, fidelity_.interpolation, kFineSteps);
  for (int row = 0; row < grid.rows; ++row) {
    const std::size_t at = grid.at(column, row);
    const double distance_m = grid.distance_m(row);
    top_m_[at] = height_m_[at] = height_m(*terrain.window, distance_m);
    if (row > 0) {
      const double crest = ground_walk.highest_tangent(grid.distance_m(row - 1.0), distance_m);
      raise(crest);
      if (!(crest > kNoTangent)) raise_between(*terrain.window, grid.distance_m(row - 1.0), distance_m, kSeaSpacing_m);
      if (crest > tangent(distance_m, height_m_[at])) top_m_[at] = geometry_->height_on_sight_m(distance_m, crest);
    }
    horizon_[at] = horizon;
    raise(tangent(distance_m, height_m_[at]));
  }
}

// Tangent of the elevation angle at the aircraft, positive above the horizontal. It is computed with heights above mean
// sea level as in GroundWalk. `height_m`: above the map plane.
double Reference::tangent(double distance_m, double height_m) const {
  return geometry_->earth().sight(geometry_->altitude_m(), distance_m, height_m + geometry_->plane_msl_m()).tangent;
}

bool Reference::lit(int column, int row) const {
  const std::size_t at = grid_->at(column, row);
  return tangent(grid_->distance_m(row), height_m_[at]) > horizon_[at];
}

// Reads the scene's triangles. A triangle on the ground sets the gamma of the ground. The others become faces.
void Reference::draw_scene(const PatchInputs& inputs, PatchData& data) {
  if (data.tiles.empty()) return;
  for (const scene::Tile* tile : data.tiles) read_tile(*inputs.environment.scene, *tile, data.surface.data());
  std::vector<Occluders::Corners> triangles;
  for (const Face& face : faces_) triangles.push_back(face.corners);
  occluders_ = Occluders(std::move(triangles));
}

void Reference::read_tile(const scene::SceneView& scene, const scene::Tile& tile, SurfacePoint* surface) {
  const double lift_m = tile.zero_msl_m - geometry_->plane_msl_m();
  const geo::AzimuthalEquidistant plane(tile.origin);
  const auto map_point = [&](double east_m, double north_m) {
    return geometry_->point_of(plane.geodetic_from_plane({east_m, north_m}));
  };
  const auto radar_frame = [&](MapPoint point, double up_m) {
    const double ahead_m = point.up_m + geometry_->distance_m();
    return position(std::hypot(point.right_m, ahead_m), std::atan2(point.right_m, ahead_m), up_m + lift_m);
  };
  // The tile's axes in the radar's frame.
  const Point3 origin = radar_frame(map_point(0.0, 0.0), 0.0);
  const Point3 east = radar_frame(map_point(1.0, 0.0), 0.0) - origin;
  const Point3 north = radar_frame(map_point(0.0, 1.0), 0.0) - origin;
  const Point3 up = radar_frame(map_point(0.0, 0.0), 1.0) - origin;
  std::vector<MapPoint> points;
  for (std::size_t i = 0; i < tile.east_m.size(); ++i)
    points.push_back(map_point(static_cast<double>(tile.east_m[i]), static_cast<double>(tile.north_m[i])));
  for (std::size_t t = 0; t < tile.triangles(); ++t) {
    Face face;
    face.code = scene.kinds()[tile.kind[t]].material;
    const std::array<std::uint16_t, 3> corners = tile.corners(t);
    for (std::size_t k = 0; k < corners.size(); ++k)
      face.corners[k] = radar_frame(points[corners[k]], static_cast<double>(tile.up_m[corners[k]]));
    face.normals.fill(face.normal());
    for (std::size_t k = 0; k < corners.size() && corners[k] >= tile.first_with_normal; ++k) {
      const std::size_t i = corners[k] - tile.first_with_normal;
      face.normals[k] = static_cast<double>(tile.normal_east[i]) * east +
                        static_cast<double>(tile.normal_north[i]) * north + static_cast<double>(tile.normal_up[i]) * up;
    }
    if (t < tile.on_ground) {
      lay_flat({points[corners[0]], points[corners[1]], points[corners[2]]}, surface_.gamma(face.code), surface);
    } else {
      faces_.push_back(face);
    }
  }
}

// Sets the gamma (SurfacePoint::gamma) of every grid point within the triangle as seen from above. Ignores a triangle
// that faces down or has a corner at most 1 m ahead of the aircraft.
void Reference::lay_flat(const std::array<MapPoint, 3>& corners, double gamma, SurfacePoint* surface) const {
  std::array<double, 3> column{}, row{};
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const double ahead_m = corners[k].up_m + geometry_->distance_m();
    if (!(ahead_m > 1.0)) return;
    column[k] = (corners[k].right_m / ahead_m - grid_->first_tangent) / grid_->tangent_step;
    row[k] = (std::hypot(corners[k].right_m, ahead_m) - grid_->first_distance_m) / grid_->spacing_m;
  }
  const auto side = [&](std::size_t k, double x, double y) {
    const std::size_t next = (k + 1) % corners.size();
    return (column[next] - column[k]) * (y - row[k]) - (row[next] - row[k]) * (x - column[k]);
  };
  const auto [left, right] = std::minmax_element(column.begin(), column.end());
  const auto [near, far] = std::minmax_element(row.begin(), row.end());
  const int last_column = static_cast<int>(std::min(std::floor(*right), grid_->columns - 1.0));
  const int last_row = static_cast<int>(std::min(std::floor(*far), grid_->rows - 1.0));
  for (int x = static_cast<int>(std::max(std::ceil(*left), 0.0)); x <= last_column; ++x)
    for (int y = static_cast<int>(std::max(std::ceil(*near), 0.0)); y <= last_row; ++y)
      if (side(0, x, y) >= 0.0 && side(1, x, y) >= 0.0 && side(2, x, y) >= 0.0)
        surface[grid_->at(x, y)].gamma = static_cast<float>(gamma);
}

// Sets the image to the power of all visible facets of ground and scene.
void Reference::cast_profiles(const PatchInputs& /*inputs*/, PatchData& data) {
  MapImage& image = data.image;
  size_ = image.size;
  power_.assign(image.power.size(), 0.0);
  for (int column = 0; column < grid_->columns; ++column) add_column(column, data.surface.data());
  for (const Face& face : faces_) add_face(face);
  const double unit_m2 = unit_return_m2(*geometry_, size_);
  for (std::size_t i = 0; i < power_.size(); ++i) image.power[i] = static_cast<float>(power_[i] / unit_m2);
}

// The pixels are those of cast_profiles().
void Reference::draw_pixels(const PatchInputs& inputs, PatchData& data) {
  power_picture_.find_hidden_points(inputs, data);
}

void Reference::complete_map(const PatchInputs& inputs, PatchData& data) {
  power_picture_.add_response_and_movers(inputs, data);
}

void Reference::draw_video(const PatchInputs& inputs, PatchData& data) {
  power_picture_.draw_video(inputs, data);
}

// Adds the power of the ground along a column. Ground between two rows is cut into facets, at most kMaxFacets, that
// climb or fall at most a third of a pixel.
void Reference::add_column(int column, const SurfacePoint* surface) {
  const PolarGrid& grid = *grid_;
  const double off = grid.tangent(column);
  const double turn_rad = std::atan(off);
  const double angle_rad = grid.tangent_step / (1.0 + off * off);
  const double longest_m = kFacetPixels * geometry_->window_m() / size_;
  for (int row = 1; row < grid.rows; ++row) {
    const std::size_t far = grid.at(column, row);
    const std::size_t near = grid.at(column, row - 1);
    if (std::isnan(height_m_[near]) || std::isnan(height_m_[far])) continue;
    const double gamma = 0.5 * (static_cast<double>(surface[near].gamma) + static_cast<double>(surface[far].gamma));
    const double climb_m = top_m_[far] - height_m_[near];
    const int facets = std::min(1 + static_cast<int>(std::abs(climb_m) / longest_m), kMaxFacets);
    Point3 begin = position(grid.distance_m(row - 1), turn_rad, height_m_[near]);
    double horizon = std::max(horizon_[near], tangent(grid.distance_m(row - 1), height_m_[near]));
    for (int index = 1; index <= facets; ++index) {
      const double fraction = static_cast<double>(index) / facets;
      const Point3 end =
          position(grid.distance_m(row - 1.0 + fraction), turn_rad, height_m_[near] + fraction * climb_m);
      const Point3 middle = 0.5 * (begin + end);
      const double out_begin = std::hypot(begin.x, begin.y);
      const double out_end = std::hypot(end.x, end.y);
      const double out_middle = 0.5 * (out_begin + out_end);
      // Twice the area of the vertical triangle radar, begin, end; proportional to the angle that the facet subtends.
      const double facing = out_begin * end.z - begin.z * out_end;
      const double middle_fraction = fraction - 0.5 / facets;
      const double seen_at =
          tangent(grid.distance_m(row - 1.0 + middle_fraction), height_m_[near] + middle_fraction * climb_m);
      if (facing > 0.0 && seen_at >= horizon && !occluders_.hide(middle))
        add(middle, gamma * angle_rad * out_middle * facing / std::hypot(out_middle, middle.z));
      horizon = std::max(horizon, tangent(grid.distance_m(row - 1.0 + fraction), height_m_[near] + fraction * climb_m));
      begin = end;
    }
  }
}

void Reference::add_face(const Face& face) {
  const Point3 first_edge = face.corners[1] - face.corners[0];
  const Point3 second_edge = face.corners[2] - face.corners[0];
  const Point3 third_edge = second_edge - first_edge;
  if (!(dot(cross(first_edge, second_edge), face.corners[0]) < 0.0)) return;  // back face
  const double longest_m =
      std::sqrt(std::max({dot(first_edge, first_edge), dot(second_edge, second_edge), dot(third_edge, third_edge)}));
  const double facet_m = kFacetPixels * geometry_->window_m() / size_;
  const int facets = std::clamp(static_cast<int>(std::ceil(longest_m / facet_m)), 1, kMaxFacets);
  const Point3 normal = cross(first_edge, second_edge);
  const double area_m2 = 0.5 * std::sqrt(dot(normal, normal)) / facets / facets;
  const auto facet = [&](double u, double v) {
    add_facet(face, face.corners[0] + u * first_edge + v * second_edge, {1.0 - u - v, u, v}, area_m2);
  };
  // The face is cut into similar triangles. Each row has upright triangles, with inverted triangles between them.
  for (int i = 0; i < facets; ++i) {
    for (int j = 0; i + j < facets; ++j) {
      facet((i + 1.0 / 3.0) / facets, (j + 1.0 / 3.0) / facets);
      if (i + j + 1 < facets) facet((i + 2.0 / 3.0) / facets, (j + 2.0 / 3.0) / facets);
    }
  }
}

// Adds the power of a facet. `point`: middle of the facet. `weights`: weights of the face's corners at that point
// (barycentric coordinates).
void Reference::add_facet(const Face& face, Point3 point, Point3 weights, double area_m2) {
  if (!seen(point)) return;
  const Point3 to_radar = -1.0 / std::sqrt(dot(point, point)) * point;
  const Point3 normal = face.normal();
  const double facing = dot(normal, to_radar);
  const Point3 smooth = weights.x * face.normals[0] + weights.y * face.normals[1] + weights.z * face.normals[2];
  const double shaded = std::clamp(dot(smooth, to_radar), 0.0, physics::kMaxShading * facing);
  const double out_m = std::hypot(point.x, point.y);
  const double out_right = point.x / out_m;
  const double out_ahead = point.y / out_m;
  const double towards = -(normal.x * out_right + normal.y * out_ahead);
  const double level2 = normal.x * normal.x + normal.y * normal.y;
  if (normal.z * normal.z >= scene::kWallNormal2 * level2) {
    add(point, surface_.gamma(face.code) * area_m2 * shaded);
    return;
  }
  const double across = normal.x * out_ahead - normal.y * out_right;
  const double gamma = surface_.wall_gamma(face.code, across, towards);
  add(point, gamma * area_m2 * facing);
  const double bounced = bounce_ * (gamma - surface_.gamma(face.code)) * area_m2 * facing;
  if (!(bounced > 0.0)) return;
  // The double bounce path over wall and ground is as long as the path to the wall's foot and back. It has the aspect
  // of the cardinal effect.
  const Ground below = ground_at(point);
  const Point3 foot = position(below.distance_m - kFoot_m, std::atan2(point.x, point.y), below.height_m);
  if (seen(foot)) add(foot, bounced);
}

// Returns the point with its distance over ground and height. The ground gets height 0 (the map plane) and a
// horizon below every tangent.
Reference::Ground Reference::below(Point3 point) const {
  const double radius_m = geometry_->earth().radius_m();
  const double altitude_m = geometry_->altitude_m() - geometry_->plane_msl_m();
  const double seen_out_m = std::hypot(point.x, point.y);
  Ground ground{seen_out_m, point.z + altitude_m, 0.0, std::numeric_limits<double>::lowest()};
  if (std::isfinite(radius_m)) {
    const double slant_m = std::hypot(seen_out_m, point.z);
    double out_m = seen_out_m, up_m = point.z;
    // The lift changes slowly with the position that it depends on.
    for (int i = 0; i < 4; ++i) {
      const double down_m = radius_m + altitude_m + up_m;
      ground.distance_m = radius_m * std::atan2(out_m, down_m);
      ground.point_height_m = std::hypot(out_m, down_m) - radius_m;
      const double lift_m =
          geometry_->earth_above_plane().elevation_lift_m(altitude_m, ground.distance_m, ground.point_height_m);
      if (lift_m == 0.0) break;
      const double straight_rad = std::atan2(point.z * out_m / seen_out_m - lift_m, out_m);
      out_m = slant_m * std::cos(straight_rad);
      up_m = slant_m * std::sin(straight_rad);
    }
  }
  return ground;
}

// As below(), with height and horizon of the ground if the point is within the polar grid. Over a void the height
// remains 0.
Reference::Ground Reference::ground_at(Point3 point) const {
  const PolarGrid& grid = *grid_;
  Ground ground = below(point);
  const double column = std::round((point.x / point.y - grid.first_tangent) / grid.tangent_step);
  const double row = std::floor((ground.distance_m - grid.first_distance_m) / grid.spacing_m);
  if (!(column >= 0.0 && column < grid.columns && row >= 0.0 && row + 1.0 < grid.rows)) return ground;
  const std::size_t near = grid.at(static_cast<int>(column), static_cast<int>(row));
  const std::size_t far = grid.at(static_cast<int>(column), static_cast<int>(row) + 1);
  const double fraction = (ground.distance_m - grid.distance_m(row)) / grid.spacing_m;
  const double height_m = height_m_[near] + fraction * (height_m_[far] - height_m_[near]);
  if (!std::isnan(height_m)) ground.height_m = height_m;
  ground.horizon = horizon_[near];
  return ground;
}

// True if the point is ahead of the radar and neither ground nor scene hides it.
bool Reference::seen(Point3 point) const {
  if (!(point.y > 0.0)) return false;
  const Ground ground = ground_at(point);
  if (ground.point_height_m < ground.height_m - kBuried_m) return false;
  return tangent(ground.distance_m, ground.point_height_m) >= ground.horizon && !occluders_.hide(point);
}

// Distributes a cross section, after gas attenuation, over the four pixels around the place where the point appears.
// This is the place on the map plane with the point's bearing and slant range, or with its bearing and distance over
// ground if map_layover is off.
void Reference::add(Point3 point, double cross_section_m2) {
  if (!gas_.none()) {
    const Ground here = below(point);
    cross_section_m2 *= gas_.two_way_transmission(geometry_->earth(), geometry_->altitude_m(), here.distance_m,
                                                  here.point_height_m + geometry_->plane_msl_m());
  }
  double distance_m = std::hypot(point.x, point.y);
  const double sine = point.x / distance_m;
  const double cosine = point.y / distance_m;
  if (fidelity_.map_layover) {
    distance_m = geometry_->earth().distance_at_slant_range(geometry_->altitude_m() - geometry_->plane_msl_m(), 0.0,
                                                            std::sqrt(dot(point, point)));
    if (std::isnan(distance_m)) return;  // nearer than every point of the map plane
  } else {
    distance_m = ground_at(point).distance_m;
  }
  const double pixel_m = geometry_->window_m() / size_;
  const double x = distance_m * sine / pixel_m + 0.5 * size_ - 0.5;
  const double y = 0.5 * size_ - 0.5 - (distance_m * cosine - geometry_->distance_m()) / pixel_m;
  if (!(x > -1.0 && x < size_ && y > -1.0 && y < size_)) return;
  const int column = static_cast<int>(std::floor(x));
  const int row = static_cast<int>(std::floor(y));
  const double a = x - column;
  const double b = y - row;
  const auto add_to_pixel = [&](int i, int j, double weight) {
    if (i < 0 || i >= size_ || j < 0 || j >= size_) return;
    power_[static_cast<std::size_t>(j) * static_cast<std::size_t>(size_) + static_cast<std::size_t>(i)] +=
        weight * cross_section_m2;
  };
  add_to_pixel(column, row, (1.0 - a) * (1.0 - b));
  add_to_pixel(column + 1, row, a * (1.0 - b));
  add_to_pixel(column, row + 1, (1.0 - a) * b);
  add_to_pixel(column + 1, row + 1, a * b);
}

}  // namespace yars::model::hrm
