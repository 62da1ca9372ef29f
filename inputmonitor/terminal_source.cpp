#include "inputmonitor/terminal_source.hpp"

#include <poll.h>
#include <unistd.h>

#include <array>

#include "inputmonitor/keyboard.hpp"
#include "inputmonitor/terminal_decoder.hpp"
#include "inputmonitor/terminal_mode.hpp"

namespace yars::inputmonitor {

namespace {

// True when the descriptor has bytes or has come to its end.
bool readable_within(int descriptor, int milliseconds) {
  pollfd wanted{descriptor, POLLIN, 0};
  return poll(&wanted, 1, milliseconds) > 0;
}

class TerminalSource final : public EventSource {
 public:
  explicit TerminalSource(std::unique_ptr<TerminalMode> mode) : mode_(std::move(mode)) {}

  bool add_descriptors(std::vector<pollfd>& wanted) const override {
    wanted.push_back({STDIN_FILENO, POLLIN, 0});
    return true;
  }
  std::optional<std::int64_t> deadline_ns() const override { return decoder_.deadline_ns(); }

  std::vector<databuffer::InputEvent> take(const Moment& moment) override {
    apply(decoder_.advance(moment.monotonic_ns));
    while (!keyboard_.ended() && readable_within(STDIN_FILENO, 0)) {
      std::array<char, 256> bytes;
      const ssize_t count = read(STDIN_FILENO, bytes.data(), bytes.size());
      // The terminal is gone.
      if (count <= 0) keyboard_.end();
      if (count > 0) apply(decoder_.feed({bytes.data(), static_cast<std::size_t>(count)}, moment.monotonic_ns));
    }
    return keyboard_.take();
  }

  std::vector<databuffer::InputEvent> release() override {
    keyboard_.let_go();
    return keyboard_.take();
  }

  bool ended() const override { return keyboard_.ended(); }
  bool follows_sim_time() const override { return false; }
  std::string description() const override { return std::string("this terminal; ") + kKeyHelp; }

 private:
  void apply(const std::vector<KeyChange>& changes) {
    for (const KeyChange& change : changes) keyboard_.change(change.key, change.pressed);
  }

  std::unique_ptr<TerminalMode> mode_;
  TerminalDecoder decoder_;
  Keyboard keyboard_;
};

}  // namespace

failure::Expected<std::unique_ptr<EventSource>> open_terminal_source() {
  auto mode = TerminalMode::enter(STDIN_FILENO);
  if (!mode) return tl::unexpected(mode.error());
  return std::make_unique<TerminalSource>(std::move(*mode));
}

}  // namespace yars::inputmonitor
