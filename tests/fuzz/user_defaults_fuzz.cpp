// Any text as the user's file of defaults: an error with the file's name and a line, or values that read the same
// again.
#include <cstdint>
#include <string>

#include "lib/error/error.hpp"
#include "runtime/user_defaults.hpp"

using namespace yars;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto defaults = runtime::parse_user_defaults({reinterpret_cast<const char*>(data), size}, "fuzz", "/users/x");
  if (!defaults) {
    YARS_REQUIRE(defaults.error().message().find("fuzz:"), ==, 0U);
    return 0;
  }
  std::string text;
  for (const auto& [name, value] : defaults->values) text += name + " = " + value.value + "\n";
  const auto again = runtime::parse_user_defaults(text, "again", "/users/x");
  YARS_REQUIRE(again.has_value(), ==, true);
  YARS_REQUIRE(again->values.size(), ==, defaults->values.size());
  for (const auto& [name, value] : defaults->values) YARS_REQUIRE(again->values.at(name).value, ==, value.value);
  return 0;
}
