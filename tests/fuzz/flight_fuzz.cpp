// Any text as a route and as a recorded track: an error, or a flight model whose samples all pass validation.
#include <cstdint>
#include <string>
#include <string_view>

#include "databuffer/flight/route_flight.hpp"
#include "databuffer/flight/track_flight.hpp"
#include "databuffer/messages/validation.hpp"
#include "lib/error/error.hpp"

using namespace yars::databuffer;

namespace {

constexpr double kSteps_s[] = {0.0, 0.02, 1.0, 20.0};

void fly(flight::FlightModel& model) {
  for (const double step_s : kSteps_s) {
    const auto sample = model.step(yars::geo::Duration::seconds(step_s));
    YARS_REQUIRE(validate(sample.ownship).value_or(""), ==, "");
    YARS_REQUIRE(validate(sample.nav).value_or(""), ==, "");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  if (const auto route = flight::parse_route(text, "fuzz")) {
    flight::RouteFlight model(*route);
    fly(model);
  }
  if (const auto track = flight::parse_track(text, "fuzz")) {
    flight::TrackFlight model(*track);
    fly(model);
  }
  return 0;
}
