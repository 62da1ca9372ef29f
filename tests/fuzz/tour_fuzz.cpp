// Any text as a tour: an error with the file's name, or a tour that plays to its end by itself and with a pilot who
// goes on at each step. Its captions and events are valid.
#include <cstdint>
#include <string>

#include "databuffer/messages/validation.hpp"
#include "inputmonitor/tour.hpp"
#include "lib/error/error.hpp"

using namespace yars;

namespace {

void play(const inputmonitor::Tour& tour, bool for_pilot) {
  constexpr int kSteps = 200;
  inputmonitor::TourSource source(tour, "fuzz", for_pilot);
  databuffer::InputEvent next{};
  next.kind = static_cast<std::uint16_t>(databuffer::EventKind::next);
  for (int step = 0; step <= kSteps; ++step) {
    source.observe({{next, true, false}});
    for (const auto& event : source.take({0, tour.end_ns / kSteps * step}))
      YARS_REQUIRE(databuffer::validate(event).value_or(""), ==, "");
    if (const auto* caption = source.caption()) YARS_REQUIRE(databuffer::validate(*caption).value_or(""), ==, "");
  }
  source.release();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto tour = inputmonitor::parse_tour({reinterpret_cast<const char*>(data), size}, "fuzz");
  if (!tour) {
    YARS_REQUIRE(tour.error().message().find("fuzz"), !=, std::string::npos);
    return 0;
  }
  std::int64_t before_ns = 0;
  for (const auto& item : tour->items) {
    YARS_REQUIRE(item.time_ns, >=, before_ns);
    before_ns = item.time_ns;
  }
  YARS_REQUIRE(tour->end_ns, >=, before_ns);
  play(*tour, false);
  play(*tour, true);
  return 0;
}
