// radar-display: the glass, in a window or as pictures in a folder; with --publish also as frames in the segment.

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "config/schema/load.hpp"
#include "databuffer/runtime/process.hpp"
#include "databuffer/runtime/program.hpp"
#include "databuffer/runtime/tick_loop.hpp"
#include "display/app/frame_output_shell.hpp"
#include "display/gl/context.hpp"
#include "display/host/display.hpp"
#include "display/host/session_link_shell.hpp"
#include "lib/log/log.hpp"

namespace {

using namespace yars;
using databuffer::monotonic_ns;
using Display = display::host::Display;

struct DisplayOptions {
  bool headless = false;
  bool publish = false;
  std::string frames;
  std::size_t keep = 0;  // frames; 0: all
  double every_s = 1.0;
  int size = 0;  // 0: the configuration's
};

constexpr std::int64_t kRedrawInterval_ns = 1'000'000'000 / 60;  // [ns] at most 60 a second
// [ns] the ring of sweeps holds 5 s; this decides only how far off its sim time a live frame is.
constexpr std::chrono::milliseconds kHeadlessLook{10};

// A glass without a window: paints when a picture is due, for the folder, for the segment, or for both.
class HeadlessDisplay {
 public:
  HeadlessDisplay(databuffer::Session& session, Display& glass, int size, const DisplayOptions& options,
                  std::optional<display::FrameWriter> frames, std::optional<display::FramePublisher> publisher)
      : session_(session),
        glass_(glass),
        size_(size),
        steps_(options.every_s),
        frames_(std::move(frames)),
        publisher_(std::move(publisher)) {}

  // A disk that takes no more costs the frames alone; each frame that falls due tries again.
  void look(std::int64_t sim_time_ns) {
    glass_.update(sim_time_ns);
    const bool due_in_folder = frames_ && steps_.is_due(sim_time_ns);
    if (due_in_folder || is_due_in_segment()) paint();
    if (publisher_) publisher_->work(glass_, size_);
    if (due_in_folder) settle(write(steps_.number()));
  }

  // Every picture shows exactly the tick of its step, in the folder and in the segment.
  error::Expected<void> look_in_lockstep(std::int64_t sim_time_ns) {
    glass_.update(sim_time_ns);
    if (!steps_.is_due(sim_time_ns)) return {};
    if (paint() && publisher_) publisher_->publish_at_once(glass_);
    return write(steps_.number());
  }

  // An error: the last frame could not be written.
  error::Expected<void> end(std::int64_t sim_time_ns) {
    glass_.update(sim_time_ns);
    if (paint() && publisher_) publisher_->publish_at_once(glass_);
    return write(steps_.last_number(sim_time_ns));
  }

 private:
  bool paint() {
    if (!glass_.paint(size_)) return false;
    if (publisher_) publisher_->note_painted();
    return true;
  }

  bool is_due_in_segment() {
    const std::int64_t now_ns = monotonic_ns();
    if (!publisher_ || now_ns < next_frame_ns_) return false;
    next_frame_ns_ = now_ns + kRedrawInterval_ns;
    return true;
  }

  error::Expected<void> write(std::int64_t number) {
    if (frames_) {
      if (auto written = frames_->write(glass_.read(), number); !written) return written;
    }
    glass_.note_shown();
    return {};
  }

  // Told once in log and flight recorder, and in the status while it lasts.
  void settle(const error::Expected<void>& written) {
    const bool failing = !written;
    session_.layout().counters.frames_failing.store(failing ? 1 : 0);
    if (failing == std::exchange(failing_, failing)) return;
    const std::string line = failing ? "frames are not written: " + written.error().found : "frames are written again";
    session_.note(databuffer::NoteKind::loss, line);
    failing ? log::warning(written.error().message() + "; each frame tries again") : log::info(line);
  }

  databuffer::Session& session_;
  Display& glass_;
  int size_;
  bool failing_ = false;
  display::FrameSteps steps_;
  std::optional<display::FrameWriter> frames_;
  std::optional<display::FramePublisher> publisher_;
  std::int64_t next_frame_ns_ = 0;  // CLOCK_MONOTONIC
};

error::Expected<void> run_headless_live(databuffer::Session& session, HeadlessDisplay& glass) {
  while (!databuffer::stop_requested()) {
    glass.look(session.sim_time_ns());
    std::this_thread::sleep_for(kHeadlessLook);
  }
  return glass.end(session.sim_time_ns());
}

// Steps with the set.
error::Expected<void> run_headless_lockstep(databuffer::TickLoop& loop, HeadlessDisplay& glass) {
  std::int64_t last_ns = 0;
  while (const auto due = loop.wait()) {
    last_ns = due->sim_time_ns;
    if (auto looked = glass.look_in_lockstep(last_ns); !looked) return looked;
    loop.done(*due);
  }
  if (auto outcome = loop.outcome(); !outcome) return outcome;
  return glass.end(last_ns);
}

error::Expected<void> run_headless(databuffer::Session& session, const radar::RadarConfiguration& configuration,
                                   const databuffer::ProgramOptions& options, const DisplayOptions& display_options,
                                   int size, std::optional<display::FramePublisher> publisher) {
  std::optional<display::FrameWriter> frames;
  if (!display_options.frames.empty()) {
    auto created = display::FrameWriter::create(display_options.frames, display_options.keep);
    if (!created) return tl::unexpected(created.error());
    frames = std::move(*created);
  }
  auto context = display::gl::open_headless();
  if (!context) return tl::unexpected(context.error());
  log::info("draws by " + display::gl::renderer_name() + ", frames go to " +
            (frames ? display_options.frames : "the segment"));
  Display glass(session, configuration, !options.lockstep.empty());
  HeadlessDisplay headless(session, glass, size, display_options, std::move(frames), std::move(publisher));
  if (options.lockstep.empty()) return run_headless_live(session, headless);
  auto loop = databuffer::TickLoop::create(session, databuffer::LockstepRole::radar_display, options.lockstep);
  if (!loop) return tl::unexpected(loop.error());
  return run_headless_lockstep(*loop, headless);
}

// Shows the glass when it has changed, at most 60 times a second; a key or a click is sent on at once.
class WindowDisplay {
 public:
  WindowDisplay(display::gl::Window& window, Display& glass, display::PilotInput& pilot,
                std::optional<display::FramePublisher> publisher)
      : window_(window), glass_(glass), pilot_(pilot), publisher_(std::move(publisher)) {}

  // Waits for input until the next redraw may come, `longest_wait_ns` at most.
  void take_input(std::int64_t longest_wait_ns) {
    const std::int64_t wait_ns = std::min(next_redraw_ns_ - monotonic_ns(), longest_wait_ns);
    const display::gl::WindowInput input =
        window_.take_input(1e-9 * static_cast<double>(std::max<std::int64_t>(wait_ns, 0)));
    pilot_.send(input);
    stale_ = stale_ || input.redraw_needed;
    if (window_.should_close()) databuffer::request_stop();
  }

  // As of this time.
  void look(std::int64_t sim_time_ns) {
    glass_.update(sim_time_ns);
    const auto pixels = window_.pixels();
    const int size = std::min(pixels.width, pixels.height);
    if (redraw(pixels, size)) glass_.note_shown();
    if (publisher_) publisher_->work(glass_, size);
  }

 private:
  // True when what the last update brought is on the glass.
  bool redraw(const display::gl::Window::Pixels& pixels, int size) {
    const std::int64_t now_ns = monotonic_ns();
    if (now_ns < next_redraw_ns_) return false;
    next_redraw_ns_ = now_ns + kRedrawInterval_ns;
    if (size <= 0) return false;  // an icon
    const bool painted = glass_.paint(size);
    if (painted && publisher_) publisher_->note_painted();
    if (!painted && !stale_) return true;
    window_.clear();
    glass_.draw({0, 0, pixels.width, pixels.height});
    window_.present();
    stale_ = false;
    return true;
  }

  display::gl::Window& window_;
  Display& glass_;
  display::PilotInput& pilot_;
  std::optional<display::FramePublisher> publisher_;
  std::int64_t next_redraw_ns_ = 0;  // CLOCK_MONOTONIC
  bool stale_ = true;                // the window shows something else than the glass
};

error::Expected<void> run_window(databuffer::Session& session, const radar::RadarConfiguration& configuration,
                                 const databuffer::ProgramOptions& options, int size,
                                 std::optional<display::FramePublisher> publisher) {
  auto window = display::gl::open_window("YARS " + configuration.name + " - " + options.session, size);
  if (!window) return tl::unexpected(window.error());
  log::info("draws by " + display::gl::renderer_name());
  auto pilot = display::PilotInput::create(session, "radar-display");
  if (!pilot) return tl::unexpected(pilot.error());
  Display glass(session, configuration, !options.lockstep.empty());
  WindowDisplay shown(**window, glass, *pilot, std::move(publisher));
  if (options.lockstep.empty()) {
    while (!databuffer::stop_requested()) {
      shown.take_input(kRedrawInterval_ns);
      shown.look(session.sim_time_ns());
    }
    pilot->release_all();
    return {};
  }
  auto loop = databuffer::TickLoop::create(session, databuffer::LockstepRole::radar_display, options.lockstep);
  if (!loop) return tl::unexpected(loop.error());
  while (const auto due = loop->wait()) {
    shown.take_input(0);
    shown.look(due->sim_time_ns);
    loop->done(*due);
  }
  return loop->outcome();
}

error::Expected<void> run(const databuffer::ProgramOptions& options, const DisplayOptions& display_options) {
  if (display_options.headless && display_options.frames.empty() && !display_options.publish)
    return tl::unexpected(error::usage_error("--headless", "--frames DIR or --publish with it", "neither"));
  auto configuration = config::load_program_configuration(options.config);
  if (!configuration) return tl::unexpected(configuration.error());
  auto session = databuffer::Session::open(options.session, "radar-display");
  if (!session) return tl::unexpected(session.error());
  const int size = display_options.size != 0 ? display_options.size : configuration->view.size_pixels;
  std::optional<display::FramePublisher> publisher;
  if (display_options.publish) {
    auto created = display::FramePublisher::create(*session, size);
    if (!created) return tl::unexpected(created.error());
    publisher = std::move(*created);
  }
  if (display_options.headless)
    return run_headless(*session, *configuration, options, display_options, size, std::move(publisher));
  return run_window(*session, *configuration, options, size, std::move(publisher));
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("YARS radar display: the glass", "radar-display");
  databuffer::ProgramOptions options;
  databuffer::add_common_options(app, options, true);
  DisplayOptions display_options;
  auto* headless =
      app.add_flag("--headless", display_options.headless, "no window: pictures into a folder or the session");
  app.add_option("--frames", display_options.frames, "folder for frame_NNNNNN.png")->needs(headless);
  app.add_option("--keep", display_options.keep, "frames that stay in the folder, the newest (else all)")
      ->needs(headless)
      ->check(CLI::Range(1, 100'000'000));
  app.add_option("--every", display_options.every_s, "sim seconds between frames (else 1)")
      ->needs(headless)
      ->check(CLI::Range(0.005, 1e6));
  app.add_flag("--publish", display_options.publish,
               "pictures into the session as well, at most 1024 pixels large: other programs read the newest");
  app.add_option("--size", display_options.size, "pixels to the edge of the glass (else the configuration's)")
      ->check(CLI::Range(120, 4096));
  return databuffer::run_program(argc, argv, app, options, [&] { return run(options, display_options); });
}
