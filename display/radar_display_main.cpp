// radar-display: the glass, in a window or as pictures in a folder.
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <span>
#include <thread>

#include "databuffer/log.hpp"
#include "databuffer/program.hpp"
#include "databuffer/tick_loop.hpp"
#include "display/frame_writer_shell.hpp"
#include "display/gl/glass.hpp"
#include "display/gl/headless_egl.hpp"
#include "display/gl/window_glfw.hpp"
#include "display/glass_feed_shell.hpp"
#include "display/pilot_input_shell.hpp"

namespace {

using namespace yars;
using databuffer::monotonic_ns;

struct DisplayOptions {
  bool headless = false;
  std::string frames;
  double every_s = 1.0;
  int size = 0;  // 0: the configuration's
};

constexpr std::int64_t kRedrawInterval_ns = 1'000'000'000 / 60;  // [ns] design "The glass": at most 60 a second
// [ns] the ring of sweeps holds 5 s; this decides only how far off its sim time a live frame is.
constexpr std::chrono::milliseconds kHeadlessLook{10};

display::GlassFeed feed_for(display::gl::Glass& glass, databuffer::Session& session,
                            const databuffer::ProgramOptions& options) {
  return {session, !options.lockstep.empty(), [&glass](const databuffer::Sweep& sweep) { glass.add(sweep); },
          [&glass](const databuffer::PatchMap& map, std::span<const std::uint8_t> pixels) { glass.add(map, pixels); }};
}

// A glass without a window: draws when a picture is due.
failure::Expected<void> run_headless_live(databuffer::Session& session, display::GlassFeed& feed,
                                          display::gl::Glass& glass, display::FrameWriter& frames) {
  while (!databuffer::stop_requested()) {
    session.heartbeat();
    const std::int64_t sim_time_ns = session.sim_time_ns();
    feed.refresh(sim_time_ns);
    if (frames.is_due(sim_time_ns)) {
      glass.draw(feed.input());
      if (auto written = frames.write(glass.read()); !written) return written;
      feed.note_shown();
    }
    std::this_thread::sleep_for(kHeadlessLook);
  }
  const std::int64_t sim_time_ns = session.sim_time_ns();
  feed.refresh(sim_time_ns);
  glass.draw(feed.input());
  return frames.write_last(glass.read(), sim_time_ns);
}

// Steps with the set; a picture shows exactly the tick of its time.
failure::Expected<void> run_headless_lockstep(databuffer::TickLoop& loop, display::GlassFeed& feed,
                                              display::gl::Glass& glass, display::FrameWriter& frames) {
  std::int64_t last_ns = 0;
  while (const auto due = loop.wait()) {
    last_ns = due->sim_time_ns;
    feed.refresh(last_ns);
    if (frames.is_due(last_ns)) {
      glass.draw(feed.input());
      if (auto written = frames.write(glass.read()); !written) return written;
      feed.note_shown();
    }
    loop.done(*due);
  }
  if (auto outcome = loop.outcome(); !outcome) return outcome;
  glass.draw(feed.input());
  return frames.write_last(glass.read(), last_ns);
}

failure::Expected<void> run_headless(databuffer::Session& session, const radar::RadarConfiguration& configuration,
                                     const databuffer::ProgramOptions& options, const DisplayOptions& display_options,
                                     int size) {
  auto frames = display::FrameWriter::create(display_options.frames, display_options.every_s);
  if (!frames) return tl::unexpected(frames.error());
  auto context = display::gl::open_headless();
  if (!context) return tl::unexpected(context.error());
  databuffer::log_info("draws by " + display::gl::renderer_name() + ", frames go to " + display_options.frames);
  display::gl::Glass glass(configuration, size);
  display::GlassFeed feed = feed_for(glass, session, options);
  if (options.lockstep.empty()) return run_headless_live(session, feed, glass, *frames);
  auto loop = databuffer::TickLoop::create(session, databuffer::LockstepRole::radar_display, options.lockstep);
  if (!loop) return tl::unexpected(loop.error());
  return run_headless_lockstep(*loop, feed, glass, *frames);
}

// Shows the glass when it has changed, at most 60 times a second; a key or a click is sent on at once.
class WindowGlass {
 public:
  WindowGlass(display::gl::Window& window, display::gl::Glass& glass, display::PilotInput& pilot)
      : window_(window), glass_(glass), pilot_(pilot) {}

  // Waits for input until the next redraw may come, `longest_wait_ns` at most.
  void take_input(std::int64_t longest_wait_ns) {
    const std::int64_t wait_ns = std::min(next_redraw_ns_ - monotonic_ns(), longest_wait_ns);
    const display::gl::WindowInput input =
        window_.take_input(1e-9 * static_cast<double>(std::max<std::int64_t>(wait_ns, 0)));
    pilot_.send(input);
    stale_ = stale_ || input.redraw_needed;
    if (window_.should_close()) databuffer::request_stop();
  }

  // True when what the input says is on the glass.
  bool redraw(const display::GlassInput& input) {
    const std::int64_t now_ns = monotonic_ns();
    if (now_ns < next_redraw_ns_) return false;
    next_redraw_ns_ = now_ns + kRedrawInterval_ns;
    const auto pixels = window_.pixels();
    const int size = std::min(pixels.width, pixels.height);
    if (size <= 0) return false;  // an icon
    if (size != glass_.size()) glass_.resize(size);
    if (!glass_.draw(input) && !stale_) return true;
    glass_.show(pixels.width, pixels.height);
    window_.present();
    stale_ = false;
    return true;
  }

 private:
  display::gl::Window& window_;
  display::gl::Glass& glass_;
  display::PilotInput& pilot_;
  std::int64_t next_redraw_ns_ = 0;  // CLOCK_MONOTONIC
  bool stale_ = true;                // the window shows something else than the glass
};

failure::Expected<void> run_window(databuffer::Session& session, const radar::RadarConfiguration& configuration,
                                   const databuffer::ProgramOptions& options, int size) {
  auto window = display::gl::open_window("YARS " + configuration.name + " - " + options.session, size);
  if (!window) return tl::unexpected(window.error());
  databuffer::log_info("draws by " + display::gl::renderer_name());
  auto pilot = display::PilotInput::create(session);
  if (!pilot) return tl::unexpected(pilot.error());
  display::gl::Glass glass(configuration, size);
  display::GlassFeed feed = feed_for(glass, session, options);
  WindowGlass shown(**window, glass, *pilot);
  if (options.lockstep.empty()) {
    while (!databuffer::stop_requested()) {
      session.heartbeat();
      shown.take_input(kRedrawInterval_ns);
      feed.refresh(session.sim_time_ns());
      if (shown.redraw(feed.input())) feed.note_shown();
    }
    pilot->release_all();
    return {};
  }
  auto loop = databuffer::TickLoop::create(session, databuffer::LockstepRole::radar_display, options.lockstep);
  if (!loop) return tl::unexpected(loop.error());
  while (const auto due = loop->wait()) {
    shown.take_input(0);
    feed.refresh(due->sim_time_ns);
    if (shown.redraw(feed.input())) feed.note_shown();
    loop->done(*due);
  }
  return loop->outcome();
}

failure::Expected<void> run(const databuffer::ProgramOptions& options, const DisplayOptions& display_options) {
  if (display_options.headless && display_options.frames.empty())
    return tl::unexpected(databuffer::usage_error("--headless", "--frames DIR with it", "none"));
  auto configuration = databuffer::load_program_configuration(options);
  if (!configuration) return tl::unexpected(configuration.error());
  auto session = databuffer::Session::open(options.session, "radar-display");
  if (!session) return tl::unexpected(session.error());
  const int size = display_options.size != 0 ? display_options.size : configuration->view.size_pixels;
  if (display_options.headless) return run_headless(*session, *configuration, options, display_options, size);
  return run_window(*session, *configuration, options, size);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("YARS radar display: the glass", "radar-display");
  databuffer::ProgramOptions options;
  databuffer::add_common_options(app, options, true);
  DisplayOptions display_options;
  auto* headless = app.add_flag("--headless", display_options.headless, "no window: pictures into a folder");
  app.add_option("--frames", display_options.frames, "folder for frame_NNNNNN.png")->needs(headless);
  app.add_option("--every", display_options.every_s, "sim seconds between frames (else 1)")
      ->needs(headless)
      ->check(CLI::Range(0.005, 1e6));
  app.add_option("--size", display_options.size, "pixels to the edge of the glass (else the configuration's)")
      ->check(CLI::Range(120, 4096));
  return databuffer::run_program(argc, argv, app, options, [&] { return run(options, display_options); });
}
