// Any text as a configuration: a configuration, or an error with the name of the file.
#include <cstdint>
#include <string_view>

#include "config/schema/load.hpp"
#include "lib/error/error.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto loaded = yars::config::load_configuration_text({reinterpret_cast<const char*>(data), size}, "fuzz");
  if (loaded) return 0;
  YARS_REQUIRE(loaded.error().message().find("fuzz"), !=, std::string::npos);
  return 0;
}
