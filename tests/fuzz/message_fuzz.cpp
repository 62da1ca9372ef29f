// Any text as messages, the configuration language of 1996: an error with the name of the file, or a configuration. The
// configuration converted to GUF gives the same configuration.
#include <cstdint>
#include <string>

#include "config/guf/messages.hpp"
#include "config/schema/load.hpp"
#include "config/schema/slot_text.hpp"
#include "lib/error/error.hpp"

using namespace yars;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string text(reinterpret_cast<const char*>(data), size);
  if (!config::is_in_messages(text)) text = "Radar: {" + text + "}";  // GUF is the subject of guf_fuzz.cpp
  const auto loaded = config::load_configuration_text(text, "fuzz");
  if (!loaded) {
    YARS_REQUIRE(loaded.error().message().find("fuzz"), !=, std::string::npos);
    return 0;
  }
  const auto converted = config::convert_configuration_text(text, "fuzz");
  if (!converted) return 0;  // too long for one GUF file
  const auto again = config::load_configuration_text(converted->text, "again");
  YARS_REQUIRE(again.has_value(), ==, true);
  const bool equal = config::print_configuration(again->radar) == config::print_configuration(loaded->radar);
  YARS_REQUIRE(equal, ==, true);
  return 0;
}
