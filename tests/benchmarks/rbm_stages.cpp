#include "tests/benchmarks/rbm_stages.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "lib/radar/configuration.hpp"
#include "model/physics/clutter_simd.hpp"
#include "model/physics/ground_return.hpp"
#include "model/physics/ray.hpp"
#include "model/physics/receiver.hpp"
#include "model/physics/sweep_geometry.hpp"
#include "model/rbm/sweep_simd.hpp"
#include "tests/benchmarks/timing.hpp"

namespace yars::benchmarks {

namespace {

using namespace model;
using namespace model::rbm;

constexpr int kRounds = 15;
constexpr int kSweeps = 200;  // half a degree apart: a scan of 100 deg

// Runs the stages of a sweep one by one, as rbm::Standard does, on arrays that stay in memory between the stages. The
// constants of the sweep are typical values: only the times are used.
class Stages {
 public:
  Stages(const model::terrain::TerrainView& terrain, const model::kernel::ScanRequest& request, int samples)
      : terrain_(&terrain),
        request_(request),
        count_(static_cast<std::size_t>(samples)),
        video_(count_),
        positions_(count_),
        ground_(configuration_, count_) {
    for (auto& array : arrays_) array.assign(count_ + 2 * rbm::simd::kPad, 0.0F);
    for (const int padded : {kTangent, kBefore, kHorizon, kCrest, kNearTangent})
      arrays_[padded].assign(arrays_[padded].size(), rbm::simd::kNoHorizon);
    receiver_ = physics::Receivers(configuration_).at(request.range);
    const double spacing_m = spacing_m_ = request.range.metres() / samples;
    for (std::size_t i = 0; i < count_; ++i) {
      at(kDistance)[i] = static_cast<float>((static_cast<double>(i) + 0.5) * spacing_m);
      at(kMidwayWeight)[i] = 0.5F;
      at(kCellInverse)[i] = static_cast<float>(1.0 / spacing_m);
    }
    constants_.altitude_m = static_cast<float>(request.pose.altitude.metres());
    constants_.curvature = 1.0F / 8.5e6F;
    constants_.land_gamma = static_cast<float>(receiver_.land_gamma);
    constants_.pulse_inverse = static_cast<float>(1.0 / receiver_.pulse_length_m);
    constants_.beam_inverse = static_cast<float>(1.0 / receiver_.elevation_beamwidth_rad);
    constants_.scale = 1e-3F;
    constants_.sin_elevation = -0.05F;
    constants_.sin_centre = 0.05F;
    constants_.gaussian = 4000.0F;
    smear_ = physics::make_pulse_smear(receiver_.pulse_length_m / spacing_m);
  }

  void print() {
    stage("places", {kDistance}, {kNorth, kEast, kNorth, kEast}, [&](int sweep) {
      sampler_.sample(request_.pose.position, azimuth(sweep), request_.range, 5, at(kDistance), positions_);
    });
    stage("terrain", {kNorth, kEast, kNorth, kEast}, {kElevation, kWater, kNear, kNearBack},
          [&](int) { terrain_->surfaces(positions_.run(), radar::Interpolation::bilinear, surfaces({})); });
    if (terrain_->has_materials()) print_ground();
    rbm::simd::SweepInputs inputs{};
    inputs.distance_m = at(kDistance);
    inputs.elevation_m = at(kElevation);
    inputs.near_m = at(kNear);
    inputs.near_back_m = at(kNearBack);
    inputs.crest = at(kCrest);
    inputs.midway_weight = at(kMidwayWeight);
    inputs.cell_inverse = at(kCellInverse);
    const rbm::simd::SweepOutputs outputs{.near = at(kNearTangent),
                                          .tangent = at(kTangent),
                                          .before = at(kBefore),
                                          .horizon = at(kHorizon),
                                          .power = at(kPower),
                                          .power_per_gamma = nullptr};
    stage("profile", {kDistance, kElevation, kNear, kNearBack}, {kTangent, kHorizon, kNearTangent},
          [&](int) { rbm::simd::profile(count_, constants_, inputs, outputs); });
    stage("crests", {kDistance, kNorth, kEast, kNorth, kEast, kHorizon}, {kCrest}, [&](int) {
      terrain_->crests(positions_.run(),
                       {.altitude_m = request_.pose.altitude.metres(),
                        .curvature = static_cast<double>(constants_.curvature),
                        .distance_m = {at(kDistance), count_},
                        .horizon = {at(kHorizon), count_}},
                       {at(kCrest), count_});
    });
    stage("sweep", {kDistance, kElevation, kTangent, kNearTangent, kCrest, kMidwayWeight, kCellInverse},
          {kBefore, kHorizon, kPower},
          [&](int) { rbm::simd::sweep(count_, constants_, radar::BeamPattern::cosecant_squared, inputs, outputs); });
    std::array<float, 2 * physics::PulseSmear::kMaxRadius + 1> weights{};
    for (std::size_t i = 0; i < weights.size(); ++i) weights[i] = static_cast<float>(smear_.weights[i]);
    stage("smear", {kPower}, {kSmeared},
          [&](int) { rbm::simd::smear(count_, at(kPower), weights.data(), smear_.reach, at(kSmeared)); });
    stage("speckle", {}, {kVariate}, [&](int sweep) {
      const physics::NoiseState state = physics::make_noise_state({1, 1, static_cast<std::uint32_t>(sweep)});
      physics::simd::speckle(count_, state, 4, physics::speckle_cells(spacing_m_, receiver_.pulse_length_m, state),
                             at(kVariate));
    });
    const std::array<float, 3> join{0.25F, 0.5F, 0.25F};
    const physics::simd::VideoInputs video{at(kSmeared), at(kSmeared), at(kSmeared), join.data(),
                                           1e-4F,        at(kVariate), 0.0F,         45.0F};
    stage("video", {kSmeared, kVariate}, {kSpare},
          [&](int) { physics::simd::form_video(count_, video, video_.data()); });
    std::printf("{\"stages_ns\":{%s},\"floors_ns\":{%s}}\n", stages_.c_str(), floors_.c_str());
  }

 private:
  // Stages that culture adds: terrain together with material codes, and the reflectivity of each material. Without
  // culture the stage `sweep` computes the reflectivity.
  void print_ground() {
    memory::CacheAlignedVector<std::int32_t>& codes = ground_.materials();
    ground_.use_texture(
        {receiver_.pulse_length_m, spacing_m_, request_.pose.altitude.metres(), receiver_.azimuth_cell_rad});
    std::fill_n(at(kSpare), count_, 0.1F);
    stage("terrain+codes", {kNorth, kEast, kNorth, kEast}, {kElevation, kWater, kNear, kNearBack, kSpare}, [&](int) {
      terrain_->surfaces(positions_.run(), radar::Interpolation::bilinear, surfaces({codes.data(), count_}));
    });
    stage("ground", {kWater, kSpare}, {kPower, kSmeared}, [&](int sweep) {
      ground_.reflect({request_.pose.position, request_.pose.altitude, azimuth(sweep), {}, request_.range},
                      positions_.run(), at(kWater), at(kSpare), true);
    });
  }

  model::terrain::SurfaceRun surfaces(std::span<std::int32_t> codes) {
    const auto step_m = static_cast<float>(request_.range.metres() / static_cast<double>(count_));
    return {.elevation_m = {at(kElevation), count_},
            .water = {at(kWater), count_},
            .peak_m = {},
            .material = codes,
            .near = {step_m, {at(kNear), count_}, {at(kNearBack), count_}}};
  }

  enum Array : int {
    kDistance,
    kNorth,
    kEast,
    kElevation,
    kWater,
    kNear,
    kNearBack,
    kNearTangent,
    kTangent,
    kBefore,  // maximum tangent of all ground nearer than the sample
    kCrest,
    kSpare,  // scratch
    kHorizon,
    kMidwayWeight,
    kCellInverse,
    kPower,
    kSmeared,
    kVariate,
    kArrays
  };

  float* at(int array) { return arrays_[static_cast<std::size_t>(array)].data() + rbm::simd::kPad; }
  geo::Bearing azimuth(int sweep) const {
    return request_.pose.platform.heading + geo::Angle::degrees(-50.0 + 0.5 * sweep);
  }

  // Measures `work` on each sweep, and its floor: the time to read and write as many arrays. Adds both to the JSON.
  void stage(const char* name, const std::vector<int>& reads, const std::vector<int>& writes,
             const std::function<void(int)>& work) {
    std::vector<double> times, floors;
    for (int round = 0; round < kRounds; ++round) {
      times.push_back(timed([&] {
        for (int sweep = 0; sweep < kSweeps; ++sweep) work(sweep);
      }));
      floors.push_back(timed([&] {
        for (int sweep = 0; sweep < kSweeps; ++sweep) touch(reads, writes);
      }));
    }
    const double samples = static_cast<double>(count_) * kSweeps;
    char text[64];
    std::snprintf(text, sizeof text, "%s\"%s\":%.3f", stages_.empty() ? "" : ",", name, 1e9 * median(times) / samples);
    stages_ += text;
    std::snprintf(text, sizeof text, "%s\"%s\":%.3f", floors_.empty() ? "" : ",", name, 1e9 * median(floors) / samples);
    floors_ += text;
  }

  // Reads the arrays `reads`, and writes as many arrays as `writes` names.
  void touch(const std::vector<int>& reads, const std::vector<int>& writes) {
    float sum = 0.0F;
    for (const int array : reads) {
      float* const from = at(array);
      std::array<float, 16> lanes{};
      for (std::size_t i = 0; i + 16 <= count_; i += 16)
        for (std::size_t lane = 0; lane < 16; ++lane) lanes[lane] += from[i + lane];
      sum += lanes[0];
    }
    for (std::size_t array = 0; array < writes.size(); ++array)
      std::fill_n(scratch_.begin(), count_, sum + static_cast<float>(array));
  }

  radar::RadarConfiguration configuration_;
  const model::terrain::TerrainView* terrain_;
  model::kernel::ScanRequest request_;
  std::size_t count_;
  std::array<memory::CacheAlignedVector<float>, kArrays> arrays_;
  std::vector<float> scratch_ = std::vector<float>(8192);
  std::vector<std::uint8_t> video_;
  double spacing_m_ = 0.0;
  physics::Receiver receiver_;
  rbm::simd::SweepConstants constants_;
  physics::PulseSmear smear_;
  physics::PositionSampler sampler_;
  physics::PositionArrays positions_;
  physics::Ground ground_;
  std::string stages_, floors_;
};

}  // namespace

void print_stages(const model::terrain::TerrainView& terrain, const model::kernel::ScanRequest& request, int samples) {
  Stages(terrain, request, samples).print();
}

}  // namespace yars::benchmarks
