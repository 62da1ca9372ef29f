// Real beam map: `reference` and `standard` in samples a second beside the gather limit, in one run. Medians over
// interleaved rounds, thread CPU time; a round in which the hypervisor stole more than 2 % is repeated.
// Usage: rbm_benchmark DIRECTORY [LAT LON HEADING] - a directory of DTED or HGT cells.
#include <time.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include "model/kernel/offline_scan.hpp"
#include "model/terrain/open_terrain.hpp"
#include "tests/benchmarks/gather_limit.hpp"

namespace {

using namespace yars;

constexpr int kRounds = 31;
constexpr int kMostRepeats = 10;  // of a round that was disturbed
constexpr double kMostSteal = 0.02;
constexpr int kGridSide = 2048;  // posts either way of the grid that the gathers read: 16 MiB of words
constexpr double kRangeNm = 80.0;
constexpr int kSamples = 1024;

double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Jiffies of all processors together, and of them what the hypervisor gave to others.
struct Processors {
  double all = 0.0, stolen = 0.0;
};
Processors processors() {
  std::ifstream file("/proc/stat");
  std::string word;
  file >> word;
  Processors result;
  double value = 0.0;
  for (int field = 0; field < 8 && file >> value; ++field) {
    result.all += value;
    if (field == 7) result.stolen = value;
  }
  return result;
}

template <class Work>
double timed(const Work& work) {
  double seconds = 0.0;
  for (int attempt = 0; attempt < kMostRepeats; ++attempt) {
    const Processors before = processors();
    const double begin_s = thread_seconds();
    work();
    seconds = thread_seconds() - begin_s;
    const Processors after = processors();
    if (after.stolen - before.stolen <= kMostSteal * (after.all - before.all)) break;
  }
  return seconds;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

radar::RadarConfiguration configured(radar::Algorithm algorithm) {
  radar::RadarConfiguration configuration;
  configuration.fidelity.algorithm = algorithm;
  configuration.fidelity.samples = kSamples;
  return configuration;
}

// Where the samples of the scan fall on a square grid about the aircraft: the same rays, the same order.
std::vector<std::int32_t> ray_offsets(std::size_t sweeps, geo::Bearing heading) {
  std::vector<std::int32_t> offsets;
  for (std::size_t sweep = 0; sweep < sweeps; ++sweep) {
    const double share = (static_cast<double>(sweep) + 0.5) / static_cast<double>(sweeps);
    const double azimuth_rad = heading.radians() + (share - 0.5) * 100.0 * geo::kRadiansPerDegree;
    for (int i = 0; i < kSamples; ++i) {
      const double way = 0.5 * (kGridSide - 4) * (i + 0.5) / kSamples;
      const int column = static_cast<int>(0.5 * kGridSide + way * std::sin(azimuth_rad));
      const int row = static_cast<int>(0.5 * kGridSide - way * std::cos(azimuth_rad));
      offsets.push_back(row * kGridSide + column);
    }
  }
  return offsets;
}

int run(const std::string& directory, geo::GeoPoint place, geo::Bearing heading) {
  auto store = model::terrain::open_terrain({directory, true});
  if (!store) {
    std::fprintf(stderr, "rbm_benchmark: %s\n", store.error().message().c_str());
    return 1;
  }
  model::kernel::ScanRequest request;
  request.pose = {place, geo::AltitudeMsl::feet(15000.0), {heading, geo::Angle(), geo::Angle(), heading}};
  request.range = geo::Length::nautical_miles(kRangeNm);
  request.width = geo::Angle::degrees(100.0);
  request.elevation = geo::Angle::degrees(-3.0);
  const auto terrain = (*store)->prepare({place, request.range.metres()});
  model::kernel::OfflineScan standard(configured(radar::Algorithm::standard), request, 1);
  model::kernel::OfflineScan reference(configured(radar::Algorithm::reference), request, 1);
  const std::size_t sweeps = standard.sweeps().size();
  const double samples = static_cast<double>(sweeps) * kSamples;

  const std::vector<std::uint32_t> words(static_cast<std::size_t>(kGridSide) * kGridSide, 0x00010001U);
  const std::vector<std::int32_t> offsets = ray_offsets(sweeps, heading);
  std::uint32_t sink = 0;
  std::vector<double> gather_rate, sweep_rate, standard_rate, reference_rate, share;
  for (int round = 0; round < kRounds; ++round) {
    const double gather_s = timed([&] { sink += benchmarks::gather_pairs(words, offsets, kGridSide); });
    const double sweep_s = timed([&] { standard.measure(*terrain); });
    const double develop_s = timed([&] { standard.develop(); });
    const double reference_s = timed([&] {
      reference.measure(*terrain);
      reference.develop();
    });
    gather_rate.push_back(samples / gather_s);
    sweep_rate.push_back(samples / sweep_s);
    standard_rate.push_back(samples / (sweep_s + develop_s));
    reference_rate.push_back(samples / reference_s);
    share.push_back(gather_s / (sweep_s + develop_s));
  }
  std::printf(
      "{\"samples\":%.0f,\"gather\":\"%s\",\"gather_limit\":%.4g,\"standard\":%.4g,\"standard_sweep\":%.4g,"
      "\"reference\":%.4g,\"standard_of_gather\":%.3f,\"check\":%u}\n",
      samples, benchmarks::gather_width().data(), median(gather_rate), median(standard_rate), median(sweep_rate),
      median(reference_rate), median(share), sink);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2 && argc != 5) {
    std::fprintf(stderr, "usage: rbm_benchmark DIRECTORY [LAT LON HEADING]\n");
    return 2;
  }
  yars::geo::GeoPoint place{37.6, -122.9};
  double heading_deg = 60.0;
  if (argc == 5) {
    place = {std::strtod(argv[2], nullptr), std::strtod(argv[3], nullptr)};
    heading_deg = std::strtod(argv[4], nullptr);
  }
  return run(argv[1], place, yars::geo::Bearing::degrees(heading_deg));
}
