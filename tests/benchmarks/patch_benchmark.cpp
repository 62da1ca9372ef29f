// Benchmark of patch maps of a made-up town on terrain, for several numbers of triangles. It prints the thread CPU time
// [ms] of a map on one thread and of each stage: the best of fifteen rounds.
// With Embree 3, the run also computes the visibility by ray packets of Embree. `of_embree` is the time of Embree
// divided by that of the map, `visibility_of_embree` by that of the stages scene and profile, which compute visibility.
// With --threads: wall time of two threads for one map, compared with two maps of one thread each at the same time.
// With --database: for several numbers of towns in memory. The window is on the first town.
//  Usage: patch_benchmark DIRECTORY LAT LON [--threads] [TRIANGLES ...] | --database [TOWNS ...]
// DIRECTORY has DTED or HGT cells; LAT LON [deg] is a position in one of them.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string_view>
#include <thread>
#include <vector>

#include "lib/parallel/thread_pool.hpp"
#include "lib/radar/configuration.hpp"
#include "model/hrm/patch_formation.hpp"
#include "model/scene/index/scene_store.hpp"
#include "model/scene/openflight/reader.hpp"
#include "model/scene/placement/placed_scene.hpp"
#include "model/terrain/store/directory_store.hpp"
#include "tests/benchmarks/timing.hpp"
#include "tests/benchmarks/visibility.hpp"
#include "worldgen/scene/scene_builder.hpp"

namespace {

using namespace yars;
namespace hrm = model::hrm;

constexpr int kRounds = 15;
constexpr double kWindow_nm = 0.67;
constexpr double kRange_nm = 10.0;

// Scene with the same town at each position.
model::scene::SceneViewPointer towns_at(std::uint64_t triangles, const std::vector<geo::GeoPoint>& positions,
                                        const model::terrain::TerrainView& ground) {
  using namespace model::scene;
  const worldgen::GeneratedScene made =
      worldgen::generate_scene({worldgen::GeneratedKind::town, triangles, 1, positions.front()});
  const auto model = read_openflight(made.file, "town", {});
  if (!model) {
    std::fprintf(stderr, "patch_benchmark: %s\n", model.error().message().c_str());
    std::exit(1);
  }
  KindTable kinds;
  std::vector<std::shared_ptr<const PlacedScene>> scenes;
  std::vector<SceneObject> objects;
  for (const geo::GeoPoint position : positions) {
    auto placed = std::make_shared<PlacedScene>(place_model(*model, {position}, ground, 0, kinds));
    scenes.push_back(placed);
    objects.insert(objects.end(), placed->objects.begin(), placed->objects.end());
  }
  return std::make_shared<PlacedView>(1, std::move(scenes), kinds.kinds(), std::move(objects));
}

// `count` positions: `middle`, then the points of a grid of 3 km around it, ring by ring.
std::vector<geo::GeoPoint> positions_around(geo::GeoPoint middle, std::size_t count) {
  constexpr double kApart_m = 3000.0;
  std::vector<geo::GeoPoint> positions{middle};
  for (int ring = 1; positions.size() < count; ++ring)
    for (int north = -ring; north <= ring; ++north)
      for (int east = -ring; east <= ring && positions.size() < count; ++east) {
        if (std::max(std::abs(north), std::abs(east)) != ring) continue;
        const auto bearing = geo::Bearing::radians(std::atan2(east, north));
        positions.push_back(
            geo::geodesic_direct(middle, bearing, geo::Length::metres(kApart_m * std::hypot(north, east))));
      }
  return positions;
}

hrm::PatchOrder order_about(geo::GeoPoint position) {
  hrm::PatchOrder order;
  order.centre = position;
  order.apex = geo::geodesic_direct(position, geo::Bearing::degrees(200.0), geo::Length::nautical_miles(kRange_nm));
  order.altitude = geo::AltitudeMsl::feet(15000.0);
  order.ground_track = geo::Bearing::degrees(290.0);
  order.ground_speed = geo::Speed::knots(480.0);
  order.window = geo::Length::nautical_miles(kWindow_nm);
  order.map = 1;
  return order;
}

// Thread CPU time of the fastest round: one map, and each of its stages.
struct Times {
  double total_s = 1e9;
  std::array<double, hrm::kPatchStages.size()> stages_s{};
};

void time_one_map(hrm::PatchFormation& formation, const hrm::PatchOrder& order, const hrm::PatchEnvironment& database,
                  Times& times) {
  std::array<double, hrm::kPatchStages.size()> stages_s{};
  const double total_s = benchmarks::timed([&] {
    formation.begin(order);
    formation.set_environment(database);
    while (formation.state() != hrm::PatchState::done) {
      double& stage_s = stages_s[static_cast<std::size_t>(formation.stages_done())];
      const double begin_s = benchmarks::thread_seconds();
      formation.advance();
      stage_s += benchmarks::thread_seconds() - begin_s;
    }
  });
  if (total_s < times.total_s) times = {total_s, stages_s};
}

void measure(model::terrain::TerrainStore& store, geo::GeoPoint position, std::uint64_t triangles, int size) {
  radar::RadarConfiguration configuration;
  configuration.fidelity.map_size = size;
  hrm::PatchFormation formation(configuration, {});
  const hrm::PatchOrder order = order_about(position);
  formation.begin(order);
  const auto ground = store.prepare({position, geo::Length::nautical_miles(1.5 * kRange_nm).metres(), 0});
  const hrm::PatchEnvironment database{ground, ground, towns_at(triangles, {position}, *ground)};
  Times times;
  benchmarks::Visibility visibility;
  const double build_s = visibility.build(order, *database.scene, ground->elevation_m(position), size);
  double rays_s = 1e9;
  for (int round = 0; round < kRounds; ++round) {
    time_one_map(formation, order, database, times);
    if (build_s > 0.0) rays_s = std::min(rays_s, benchmarks::timed([&] { visibility.cast(); }));
  }
  std::printf("{\"size\":%d,\"triangles\":%zu,\"kernel_ms\":%.2f", size, formation.triangles(), 1e3 * times.total_s);
  for (std::size_t stage = 0; stage < times.stages_s.size(); ++stage)
    std::printf(",\"%s_ms\":%.2f", hrm::kPatchStages[stage].data(), 1e3 * times.stages_s[stage]);
  if (build_s > 0.0)
    std::printf(
        ",\"embree_ms\":%.2f,\"embree_build_ms\":%.1f,\"embree_lit\":%.3f,\"of_embree\":%.2f,"
        "\"visibility_of_embree\":%.2f",
        1e3 * rays_s, 1e3 * build_s, visibility.lit(), rays_s / times.total_s,
        rays_s / (times.stages_s[1] + times.stages_s[2]));
  std::printf("}\n");
  std::fflush(stdout);
}

void measure_database(model::terrain::TerrainStore& store, geo::GeoPoint position, std::size_t towns) {
  constexpr std::uint64_t kTriangles = 100'000;
  radar::RadarConfiguration configuration;
  hrm::PatchFormation formation(configuration, {});
  const hrm::PatchOrder order = order_about(position);
  const auto ground = store.prepare({position, geo::Length::nautical_miles(3.0 * kRange_nm).metres(), 0});
  const hrm::PatchEnvironment database{ground, ground,
                                       towns_at(kTriangles, positions_around(position, towns), *ground)};
  Times times;
  for (int round = 0; round < kRounds; ++round) time_one_map(formation, order, database, times);
  std::printf("{\"size\":%d,\"towns\":%zu,\"resident_mb\":%.0f,\"triangles_near\":%zu,\"kernel_ms\":%.2f}\n",
              configuration.fidelity.map_size, towns, 1e-6 * static_cast<double>(database.scene->resident_bytes()),
              formation.triangles(), 1e3 * times.total_s);
  std::fflush(stdout);
}

// Wall time [s] in which each of `formations` makes `maps` maps, all at the same time on threads of their own.
double wall_time_s(std::vector<hrm::PatchFormation>& formations, const hrm::PatchOrder& order,
                   const hrm::PatchEnvironment& database, int maps) {
  const auto begin = std::chrono::steady_clock::now();
  std::vector<std::thread> workers;
  for (hrm::PatchFormation& formation : formations)
    workers.emplace_back([&] {
      for (int map = 0; map < maps; ++map) {
        formation.begin(order);
        formation.set_environment(database);
        while (formation.state() != hrm::PatchState::done) formation.advance();
      }
    });
  for (std::thread& worker : workers) worker.join();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

void measure_threads(model::terrain::TerrainStore& store, geo::GeoPoint position, std::uint64_t triangles, int size) {
  constexpr int kMaps = 10;
  radar::RadarConfiguration configuration;
  configuration.fidelity.map_size = size;
  parallel::ThreadPool workers(2);
  std::vector<hrm::PatchFormation> together;
  together.emplace_back(configuration, parallel::Executor{2, [&](const auto& job) { workers.run(job); }});
  std::vector<hrm::PatchFormation> apart;
  for (int i = 0; i < 2; ++i) apart.emplace_back(configuration, parallel::Executor{});
  const hrm::PatchOrder order = order_about(position);
  const auto ground = store.prepare({position, geo::Length::nautical_miles(1.5 * kRange_nm).metres(), 0});
  const hrm::PatchEnvironment database{ground, ground, towns_at(triangles, {position}, *ground)};
  std::vector<double> shares;
  for (int round = 0; round < kRounds; ++round) {
    const double together_s = wall_time_s(together, order, database, kMaps);
    const double apart_s = wall_time_s(apart, order, database, kMaps);
    // Both times are for kMaps; `apart` makes two maps in its time. 1: two threads on one map lose nothing.
    shares.push_back(0.5 * apart_s / together_s);
  }
  std::printf("{\"size\":%d,\"triangles\":%zu,\"two_threads_of_two_alone\":%.3f}\n", size, together[0].triangles(),
              benchmarks::median(shares));
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    std::fprintf(stderr,
                 "usage: patch_benchmark DIRECTORY LAT LON [--threads] [TRIANGLES ...] | --database [TOWNS ...]\n");
    return 2;
  }
  radar::TerrainConfiguration terrain;
  terrain.directory = argv[1];
  const geo::GeoPoint position{std::strtod(argv[2], nullptr), std::strtod(argv[3], nullptr)};
  auto store = model::terrain::open_terrain(terrain);
  if (!store) {
    std::fprintf(stderr, "patch_benchmark: %s\n", store.error().message().c_str());
    return 1;
  }
  const std::string_view what = argc > 4 ? argv[4] : "";
  const bool threads = what == "--threads";
  const bool database = what == "--database";
  std::vector<std::uint64_t> counts{10'000, 100'000, 1'000'000, 4'000'000};
  if (database) counts = {1, 9, 49, 169};
  const int first = threads || database ? 5 : 4;
  if (argc > first) counts.clear();
  for (int i = first; i < argc; ++i) counts.push_back(std::strtoull(argv[i], nullptr, 10));
  if (database) {
    for (const std::uint64_t towns : counts) measure_database(**store, position, towns);
    return 0;
  }
  for (const std::uint64_t count : counts)
    for (const int size : {480, 1024}) (threads ? measure_threads : measure)(**store, position, count, size);
  return 0;
}
