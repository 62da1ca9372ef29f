// Any text as a script of events: an error with the file's name, or valid events in the order of their times.
#include <cstdint>
#include <string>

#include "databuffer/messages/validation.hpp"
#include "inputmonitor/event_source.hpp"
#include "lib/error/error.hpp"

using namespace yars;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto script = inputmonitor::parse_script({reinterpret_cast<const char*>(data), size}, "fuzz");
  if (!script) {
    YARS_REQUIRE(script.error().message().find("fuzz:"), !=, std::string::npos);
    return 0;
  }
  std::int64_t before_ns = 0;
  for (const auto& event : script->events) {
    YARS_REQUIRE(event.time_ns, >=, before_ns);
    YARS_REQUIRE(databuffer::validate(event.event).value_or(""), ==, "");
    before_ns = event.time_ns;
  }
  if (script->end_ns) YARS_REQUIRE(*script->end_ns, >=, before_ns);
  return 0;
}
