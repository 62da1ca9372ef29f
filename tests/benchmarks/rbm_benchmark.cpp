// Benchmark of the real beam map at several ranges: samples per second of `standard` and of `reference`. For comparison
// it measures the gather limit (gather_limit.hpp) on a grid of posts of the same extent. Medians of interleaved rounds.
// `standard` is measured with and without noise, from cold caches (cold_M), and without the video (kernel_M: power
// only).
//  Usage: rbm_benchmark DIRECTORY [LAT LON HEADING]; DIRECTORY has DTED or HGT cells of one spacing; angles in degrees
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "lib/radar/configuration.hpp"
#include "model/kernel/offline_scan.hpp"
#include "model/terrain/formats/cell.hpp"
#include "model/terrain/store/directory_store.hpp"
#include "tests/benchmarks/gather_limit.hpp"
#include "tests/benchmarks/rbm_stages.hpp"
#include "tests/benchmarks/timing.hpp"

namespace {

using namespace yars;
using benchmarks::median;
using benchmarks::timed;

constexpr int kRounds = 15;
constexpr int kSamples = 1024;
constexpr std::size_t kCacheBytes = std::size_t{256} << 20;  // overwritten to evict terrain and buffers from the caches

radar::RadarConfiguration configured(radar::Algorithm algorithm, bool noise) {
  radar::RadarConfiguration configuration;
  configuration.fidelity.algorithm = algorithm;
  configuration.fidelity.samples = kSamples;
  configuration.fidelity.noise = noise;
  return configuration;
}

// Grid of made-up posts about the aircraft, twice: row by row as in a file, and as PostBlocks as in the terrain store.
// A gather is fastest on PostBlocks, because the four posts around any position share a cache line.
struct Mosaic {
  int south_deg, west_deg, posts_per_degree, columns;
  std::vector<std::int16_t> rows;
  model::terrain::PostBlocks blocks;
};

Mosaic mosaic_about(geo::GeoPoint position, double radius_m, int posts_per_degree) {
  const double reach_deg = radius_m / 111000.0;
  const double wide_deg = reach_deg / std::cos(position.latitude_deg * geo::kRadiansPerDegree);
  const int south = static_cast<int>(std::floor(position.latitude_deg - reach_deg));
  const int west = static_cast<int>(std::floor(position.longitude_deg - wide_deg));
  const int rows = (static_cast<int>(std::ceil(position.latitude_deg + reach_deg)) - south) * posts_per_degree + 1;
  const int columns = (static_cast<int>(std::ceil(position.longitude_deg + wide_deg)) - west) * posts_per_degree + 1;
  std::vector<std::int16_t> posts;
  posts.reserve(static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns));
  // The heights themselves do not affect the time.
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) posts.push_back(static_cast<std::int16_t>((row ^ column) & 0xff));
  model::terrain::PostBlocks blocks(rows, columns, posts);
  return {south, west, posts_per_degree, columns, std::move(posts), std::move(blocks)};
}

// Indices of the post south-west of each sample of the scan: in PostBlocks, and row by row.
struct Entries {
  std::vector<std::int32_t> blocks, rows;
};
Entries ray_entries(const Mosaic& mosaic, const model::kernel::OfflineScan& scan, geo::Length range) {
  Entries entries;
  for (const databuffer::Sweep& sweep : scan.sweeps()) {
    const double middle_deg =
        sweep.azimuth_left_deg + 0.5 * geo::wrapped_degrees(sweep.azimuth_right_deg - sweep.azimuth_left_deg);
    const geo::GeodesicRay ray({sweep.apex_latitude_deg, sweep.apex_longitude_deg}, geo::Bearing::degrees(middle_deg));
    for (int i = 0; i < kSamples; ++i) {
      const geo::GeoPoint position = ray.position((i + 0.5) / kSamples * range);
      const int row = static_cast<int>((position.latitude_deg - mosaic.south_deg) * mosaic.posts_per_degree);
      const int column = static_cast<int>((position.longitude_deg - mosaic.west_deg) * mosaic.posts_per_degree);
      using Blocks = model::terrain::PostBlocks;
      const int block = row / Blocks::kRowStep * mosaic.blocks.block_columns() + column / Blocks::kColumnStep;
      entries.rows.push_back(row * mosaic.columns + column);
      entries.blocks.push_back(block * static_cast<int>(Blocks::kPosts) + row % Blocks::kRowStep * Blocks::kColumns +
                               column % Blocks::kColumnStep);
    }
  }
  return entries;
}

// One value per round: samples per second, and for *share the time of the gather divided by the time of a scan.
struct Rates {
  std::vector<double> gather, rows, rows_share, full, quiet, kernel, cold, reference, share, quiet_share;
};

void measure_range(const model::terrain::TerrainView& terrain, model::kernel::ScanRequest request, double range_nm,
                   std::vector<char>& trash) {
  request.range = geo::Length::nautical_miles(range_nm);
  model::kernel::OfflineScan noisy(configured(radar::Algorithm::standard, true), request, 1);
  model::kernel::OfflineScan quiet(configured(radar::Algorithm::standard, false), request, 1);
  model::kernel::OfflineScan reference(configured(radar::Algorithm::reference, true), request, 1);
  const auto scan = [&terrain](model::kernel::OfflineScan& which) { which.run(terrain); };
  scan(noisy);
  scan(quiet);
  scan(reference);
  const double samples = static_cast<double>(noisy.sweeps().size()) * kSamples;
  constexpr int kPostsPerDegree = 1200;
  const Mosaic mosaic = mosaic_about(request.pose.position, request.range.metres(), kPostsPerDegree);
  const Entries entries = ray_entries(mosaic, noisy, request.range);
  std::uint32_t sink = 0;
  Rates rates;
  for (int round = 0; round < kRounds; ++round) {
    const auto gather = [&] {
      sink += benchmarks::gather_pairs(mosaic.blocks.data(), entries.blocks, model::terrain::PostBlocks::kColumns);
    };
    const auto gather_rows = [&] {
      sink += benchmarks::gather_pairs(mosaic.rows.data(), entries.rows, mosaic.columns);
    };
    gather_rows();
    const double rows_s = timed(gather_rows);
    gather();
    const double gather_s = timed(gather);
    noisy.measure(terrain);
    const double kernel_s = timed([&] { noisy.measure(terrain); });
    const double full_s = timed([&] { scan(noisy); });
    scan(quiet);
    const double quiet_s = timed([&] { scan(quiet); });
    std::fill(trash.begin(), trash.end(), static_cast<char>(round));
    const double cold_s = timed([&] { scan(noisy); });
    const double reference_s = timed([&] { scan(reference); });
    rates.gather.push_back(samples / gather_s);
    rates.rows.push_back(samples / rows_s);
    rates.rows_share.push_back(rows_s / full_s);
    rates.kernel.push_back(samples / kernel_s);
    rates.full.push_back(samples / full_s);
    rates.quiet.push_back(samples / quiet_s);
    rates.cold.push_back(samples / cold_s);
    rates.reference.push_back(samples / reference_s);
    rates.share.push_back(gather_s / full_s);
    rates.quiet_share.push_back(gather_s / quiet_s);
  }
  const auto mega = [](const std::vector<double>& values) { return median(values) * 1e-6; };
  std::printf(
      "{\"range_nm\":%.4g,\"sweeps\":%zu,\"samples\":%d,\"gather\":\"%s\",\"rows_limit_M\":%.1f,\"of_rows_limit\":%.3f,"
      "\"blocks_limit_M\":%.1f,\"standard_M\":%.1f,"
      "\"without_noise_M\":%.1f,\"kernel_M\":%.1f,\"cold_M\":%.1f,\"reference_M\":%.2f,\"of_blocks_limit\":%.3f,"
      "\"without_noise_of_blocks_limit\":%.3f,\"of_reference\":%.1f,\"check\":%u}\n",
      range_nm, noisy.sweeps().size(), kSamples, benchmarks::gather_width().data(), mega(rates.rows),
      median(rates.rows_share), mega(rates.gather), mega(rates.full), mega(rates.quiet), mega(rates.kernel),
      mega(rates.cold), mega(rates.reference), median(rates.share), median(rates.quiet_share),
      median(rates.full) / median(rates.reference), sink);
  benchmarks::print_stages(terrain, request, kSamples);
  std::fflush(stdout);
}

int run(const std::string& directory, geo::GeoPoint position, geo::Bearing heading) {
  radar::TerrainConfiguration configuration;
  configuration.directory = directory;
  auto store = model::terrain::open_terrain(configuration);
  if (!store) {
    std::fprintf(stderr, "rbm_benchmark: %s\n", store.error().message().c_str());
    return 1;
  }
  model::kernel::ScanRequest request;
  request.pose = {position, geo::AltitudeMsl::feet(15000.0), {heading, geo::Angle(), geo::Angle(), heading}};
  request.width = geo::Angle::degrees(110.0);  // 200 sweeps
  request.elevation = geo::Angle::degrees(-3.0);
  std::vector<char> trash(kCacheBytes);
  for (const double range_nm : {10.0, 40.0, 80.0, 160.0}) {
    const auto terrain = (*store)->prepare({position, geo::Length::nautical_miles(range_nm).metres()});
    measure_range(*terrain, request, range_nm, trash);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2 && argc != 5) {
    std::fprintf(stderr, "usage: rbm_benchmark DIRECTORY [LAT LON HEADING]\n");
    return 2;
  }
  yars::geo::GeoPoint position{37.6, -122.9};
  double heading_deg = 60.0;
  if (argc == 5) {
    position = {std::strtod(argv[2], nullptr), std::strtod(argv[3], nullptr)};
    heading_deg = std::strtod(argv[4], nullptr);
  }
  return run(argv[1], position, yars::geo::Bearing::degrees(heading_deg));
}
