#include "tests/benchmarks/visibility.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include "lib/radar/fidelity.hpp"
#include "tests/benchmarks/timing.hpp"

#ifdef YARS_EMBREE
#include <embree3/rtcore.h>
#endif

namespace yars::benchmarks {

#ifdef YARS_EMBREE
namespace {
constexpr unsigned kPacket = 16;     // rays
constexpr float kAbove_m = 2000.0F;  // height above the map plane at which the downward rays begin
constexpr float kLift_m = 0.05F;     // height above the surface at which the rays to the radar begin
}  // namespace

// Scene of Embree. Coordinates [m]: x right, y up on the map, z height above the map plane; origin at the map's centre.
struct Visibility::Rays {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  int size = 0;  // [pixels] side of the map
  // Pixel; half the side of the map; position of the radar: over ground to the centre, above the map plane.
  float pixel_m = 0.0F, edge_m = 0.0F, distance_m = 0.0F, above_m = 0.0F;
  std::size_t lit = 0;

  ~Rays() {
    if (scene != nullptr) rtcReleaseScene(scene);
    if (device != nullptr) rtcReleaseDevice(device);
  }
  void add(const std::vector<float>& positions, const std::vector<std::uint32_t>& corners) const;
  // Number of lit pixels among the sixteen from (row, column) to the right.
  unsigned cast_packet(int row, int column) const;
};

// Adds triangles: x, y, z of each vertex, and three vertex indices per triangle.
void Visibility::Rays::add(const std::vector<float>& positions, const std::vector<std::uint32_t>& corners) const {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                           positions.size() / 3);
  std::copy(positions.begin(), positions.end(), static_cast<float*>(vertices));
  void* indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                          3 * sizeof(std::uint32_t), corners.size() / 3);
  std::copy(corners.begin(), corners.end(), static_cast<std::uint32_t*>(indices));
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
}

unsigned Visibility::Rays::cast_packet(int row, int column) const {
  alignas(64) std::array<int, kPacket> valid{};
  alignas(64) RTCRayHit16 down{};
  for (unsigned i = 0; i < kPacket; ++i) {
    valid[i] = column + static_cast<int>(i) < size ? -1 : 0;
    down.ray.org_x[i] = (static_cast<float>(column) + static_cast<float>(i) + 0.5F) * pixel_m - edge_m;
    down.ray.org_y[i] = edge_m - (static_cast<float>(row) + 0.5F) * pixel_m;
    down.ray.org_z[i] = kAbove_m;
    down.ray.dir_z[i] = -1.0F;
    down.ray.tfar[i] = std::numeric_limits<float>::infinity();
    down.ray.mask[i] = ~0U;
    down.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    down.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect16(valid.data(), scene, &context, &down);
  alignas(64) RTCRay16 to_radar{};
  for (unsigned i = 0; i < kPacket; ++i) {
    to_radar.org_x[i] = down.ray.org_x[i];
    to_radar.org_y[i] = down.ray.org_y[i];
    to_radar.org_z[i] = kAbove_m - down.ray.tfar[i] + kLift_m;
    to_radar.dir_x[i] = -to_radar.org_x[i];
    to_radar.dir_y[i] = -distance_m - to_radar.org_y[i];
    to_radar.dir_z[i] = above_m - to_radar.org_z[i];
    to_radar.tfar[i] = 1.0F;
    to_radar.mask[i] = ~0U;
    if (down.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) valid[i] = 0;
  }
  rtcOccluded16(valid.data(), scene, &context, &to_radar);
  unsigned lit_pixels = 0;
  for (unsigned i = 0; i < kPacket; ++i) lit_pixels += valid[i] != 0 && to_radar.tfar[i] > 0.0F ? 1U : 0U;
  return lit_pixels;
}

double Visibility::build(const model::hrm::PatchOrder& order, const model::scene::SceneView& scene, double elevation_m,
                         int size) {
  rays_ = std::make_unique<Rays>();
  const model::hrm::PatchGeometry geometry(order, radar::RadarConfiguration(), elevation_m);
  rays_->size = size;
  rays_->pixel_m = static_cast<float>(geometry.window_m() / size);
  rays_->edge_m = static_cast<float>(0.5 * geometry.window_m());
  rays_->distance_m = static_cast<float>(geometry.distance_m());
  rays_->above_m = static_cast<float>(geometry.above_plane_m(geometry.distance_m()));
  rays_->device = rtcNewDevice("threads=1,set_affinity=0");
  rays_->scene = rtcNewScene(rays_->device);
  rtcSetSceneBuildQuality(rays_->scene, RTC_BUILD_QUALITY_HIGH);
  std::vector<const model::scene::Tile*> tiles;
  scene.tiles_near(order.centre, 1.5 * geometry.window_m(), tiles);
  for (const model::scene::Tile* tile : tiles) {
    std::vector<float> positions;
    std::vector<std::uint32_t> corners;
    const model::hrm::MapPoint origin = geometry.point_of(tile->origin);
    const geo::Bearing up = geometry.up();
    const double sine = std::sin(up.degrees() * geo::kRadiansPerDegree);
    const double cosine = std::cos(up.degrees() * geo::kRadiansPerDegree);
    for (std::size_t i = 0; i < tile->east_m.size(); ++i) {
      const auto east = static_cast<double>(tile->east_m[i]);
      const auto north = static_cast<double>(tile->north_m[i]);
      positions.push_back(static_cast<float>(origin.right_m + east * cosine - north * sine));
      positions.push_back(static_cast<float>(origin.up_m + east * sine + north * cosine));
      positions.push_back(tile->up_m[i] + static_cast<float>(tile->zero_msl_m - geometry.plane_msl_m()));
    }
    for (std::size_t t = 0; t < tile->triangles(); ++t)
      for (const std::uint32_t corner : tile->corners(t)) corners.push_back(corner);
    rays_->add(positions, corners);
  }
  constexpr float kFar_m = 3000.0F;  // half the side of the level ground, a square of two triangles
  rays_->add({-kFar_m, -kFar_m, 0.0F, kFar_m, -kFar_m, 0.0F, kFar_m, kFar_m, 0.0F, -kFar_m, kFar_m, 0.0F},
             {0, 1, 2, 0, 2, 3});
  const double begin_s = thread_seconds();
  rtcCommitScene(rays_->scene);
  return thread_seconds() - begin_s;
}

void Visibility::cast() {
  std::size_t lit_pixels = 0;
  for (int row = 0; row < rays_->size; ++row)
    for (int column = 0; column < rays_->size; column += static_cast<int>(kPacket))
      lit_pixels += rays_->cast_packet(row, column);
  rays_->lit = lit_pixels;
}

double Visibility::lit() const {
  return static_cast<double>(rays_->lit) / (static_cast<double>(rays_->size) * rays_->size);
}
#else
struct Visibility::Rays {};
double Visibility::build(const model::hrm::PatchOrder& /*order*/, const model::scene::SceneView& /*scene*/,
                         double /*elevation_m*/, int /*size*/) {
  return 0.0;
}
void Visibility::cast() {}
double Visibility::lit() const {
  return 0.0;
}
#endif

Visibility::Visibility() = default;
Visibility::~Visibility() = default;

}  // namespace yars::benchmarks
