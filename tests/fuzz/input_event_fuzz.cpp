// Any bytes as an InputEvent: validation and conversion to text do not crash. If the text can be read as an event, that
// event has the same kind.
#include <cstdint>
#include <cstring>

#include "databuffer/messages/input_event.hpp"
#include "databuffer/messages/validation.hpp"
#include "lib/error/error.hpp"

using namespace yars::databuffer;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  InputEvent event{};
  if (size < sizeof(event)) return 0;
  std::memcpy(&event, data, sizeof(event));
  (void)validate(event);
  if (const auto again = event_from_text(text_of(event))) YARS_REQUIRE(again->kind, ==, event.kind);
  return 0;
}
