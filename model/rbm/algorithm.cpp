#include "model/rbm/algorithm.hpp"

#include <algorithm>
#include <utility>

#include "lib/radar/modes.hpp"
#include "model/rbm/reference.hpp"
#include "model/rbm/report_1996.hpp"
#include "model/rbm/standard.hpp"
#include "model/rbm/sub_beams.hpp"

namespace yars::model::rbm {

namespace {
std::unique_ptr<Algorithm> make_ray(const radar::RadarConfiguration& configuration) {
  switch (configuration.fidelity.algorithm) {
    case radar::Algorithm::reference:
      return std::make_unique<Reference>(configuration);
    case radar::Algorithm::report_1996:
      return std::make_unique<Report1996>(configuration);
    case radar::Algorithm::standard:
      break;
  }
  return std::make_unique<Standard>(configuration);
}
}  // namespace

std::unique_ptr<Algorithm> make_algorithm(const radar::RadarConfiguration& configuration) {
  std::unique_ptr<Algorithm> ray = make_ray(configuration);
  if (configuration.fidelity.sub_beams <= 1) return ray;
  return std::make_unique<SubBeams>(std::move(ray), configuration);
}

std::size_t sample_count(const radar::RadarConfiguration& configuration) {
  return static_cast<std::size_t>(std::clamp(configuration.fidelity.samples, 1, radar::kMaxSamples));
}

}  // namespace yars::model::rbm
