// Any bytes from a terminal, in fragments at any times: the decoder reports only existing keys, and releases each
// pressed key. Input: fragments of (length, time since the last one [ms], bytes).
#include <array>
#include <cstdint>
#include <string_view>

#include "inputmonitor/keyboard_source.hpp"
#include "lib/error/error.hpp"

using namespace yars;

namespace {

class Keyboard {
 public:
  void take(const std::vector<inputmonitor::KeyChange>& changes) {
    for (const auto& change : changes) {
      YARS_REQUIRE(change.key != databuffer::Key::none, ==, true);
      // Presses and releases of a key alternate.
      bool& down = down_[static_cast<std::size_t>(change.key) % down_.size()];
      YARS_REQUIRE(down, !=, change.pressed);
      down = change.pressed;
    }
  }
  bool any_down() const {
    for (const bool down : down_)
      if (down) return true;
    return false;
  }

 private:
  std::array<bool, 1024> down_{};
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  inputmonitor::TerminalDecoder decoder;
  Keyboard keyboard;
  std::int64_t now_ns = 0;
  while (size >= 2) {
    const std::size_t length = std::min<std::size_t>(data[0] % 16U, size - 2);
    now_ns += data[1] * std::int64_t{1'000'000};
    keyboard.take(decoder.feed({reinterpret_cast<const char*>(data + 2), length}, now_ns));
    if (const auto due_ns = decoder.deadline_ns()) YARS_REQUIRE(*due_ns, <=, now_ns + inputmonitor::kArrowPulse_ns);
    data += 2 + length;
    size -= 2 + length;
  }
  keyboard.take(decoder.advance(now_ns + 1'000'000'000));
  YARS_REQUIRE(keyboard.any_down(), ==, false);
  return 0;
}
