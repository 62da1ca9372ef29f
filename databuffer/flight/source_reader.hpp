// From `--source KIND:...` to the flight model that it names; reads the file of a route or track.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "databuffer/flight/flight_model.hpp"
#include "lib/failure/error.hpp"

namespace yars::databuffer::flight {

struct FlightSource {
  std::unique_ptr<FlightModel> model;
  std::string description;  // for the log: what flies, from which file
};

// route:FILE, fixed:LAT,LON,ALT_FT,HDG,KT, csv:FILE (programs outside: databuffer/bridges). An error about the text
// itself counts as bad usage.
failure::Expected<FlightSource> open_source(std::string_view text);

}  // namespace yars::databuffer::flight
