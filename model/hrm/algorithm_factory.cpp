#include "model/hrm/algorithm_factory.hpp"

#include "model/hrm/reference.hpp"
#include "model/hrm/report_1996.hpp"
#include "model/hrm/standard.hpp"

namespace yars::model::hrm {

std::unique_ptr<Algorithm> make_algorithm(const radar::RadarConfiguration& configuration) {
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

}  // namespace yars::model::hrm
