// Any text as a route and as a recorded track: an error, or a flight model whose samples all pass validation.
#include <cstdint>
#include <string>
#include <string_view>

#include "databuffer/messages/validation.hpp"
#include "flightmodel/route_flight.hpp"
#include "flightmodel/source_reader.hpp"
#include "lib/error/error.hpp"

using namespace yars;

namespace {

constexpr double kSteps_s[] = {0.0, 0.02, 1.0, 20.0};

void fly(flightmodel::FlightModel& model) {
  for (const double step_s : kSteps_s) {
    const auto sample = model.step(yars::geo::Duration::seconds(step_s));
    YARS_REQUIRE(validate(sample.ownship).value_or(""), ==, "");
    YARS_REQUIRE(validate(sample.nav).value_or(""), ==, "");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  if (const auto route = flightmodel::parse_route(text, "fuzz")) {
    flightmodel::RouteFlight model(*route);
    fly(model);
  }
  if (const auto track = flightmodel::parse_track(text, "fuzz")) {
    flightmodel::TrackFlight model(*track);
    fly(model);
  }
  return 0;
}
