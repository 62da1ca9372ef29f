// Program radar-display: the display in a window, as PNG files in a folder, or as frames in the segment.

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
  std::optional<std::uint64_t> keep;  // frames to keep; nullopt: all
  double every_s = 1.0;
  std::optional<int> size;  // [pixels] nullopt: as configured
};

constexpr std::int64_t kRedrawInterval_ns = 1'000'000'000 / 60;  // minimum interval: at most 60 redraws per second
// Interval of updates without a window. If sim time runs at the rate of real time, a frame follows the begin of its
// step (FrameSteps) by about 10 ms at most. No sweep is lost, because the session's ring keeps sweeps for 5 s.
constexpr std::chrono::milliseconds kHeadlessInterval{10};

// Display without a window: paints when a picture is due for the folder or the segment.
class HeadlessDisplay {
 public:
  HeadlessDisplay(databuffer::Session& session, Display& mpd, int size, const DisplayOptions& options,
                  std::optional<display::FrameWriter> frames, std::optional<display::FramePublisher> publisher)
      : session_(session),
        mpd_(mpd),
        size_(size),
        steps_(options.every_s),
        frames_(std::move(frames)),
        publisher_(std::move(publisher)) {}

  // One update without lockstep. A failed write loses only that frame.
  void step(std::int64_t sim_time_ns) {
    mpd_.update(sim_time_ns);
    const bool due_in_folder = frames_ && steps_.is_due(sim_time_ns);
    const bool painted = (due_in_folder || is_due_in_segment()) && paint();
    if (publisher_) publisher_->work(mpd_, size_);
    if (due_in_folder)
      report(write(steps_.number()));
    else if (painted)
      mpd_.note_shown();
  }

  // One update in lockstep. Each picture shows exactly the tick of its step, both as file and in the segment.
  error::Expected<void> step_in_lockstep(std::int64_t sim_time_ns) {
    mpd_.update(sim_time_ns);
    if (!steps_.is_due(sim_time_ns)) return {};
    if (paint() && publisher_) publisher_->publish_at_once(mpd_);
    return write(steps_.number());
  }

  // Paints and writes the final picture. Error: the final frame could not be written.
  error::Expected<void> end(std::int64_t sim_time_ns) {
    mpd_.update(sim_time_ns);
    if (paint() && publisher_) publisher_->publish_at_once(mpd_);
    return write(steps_.last_number(sim_time_ns));
  }

 private:
  bool paint() {
    if (!mpd_.paint(size_)) return false;
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
      if (auto written = frames_->write(mpd_.read(), number); !written) return written;
    }
    mpd_.note_shown();
    return {};
  }

  // Reports the first failed write, and the first success after it, in the log and the flight recorder.
  void report(const error::Expected<void>& written) {
    const bool failing = !written;
    session_.layout().counters.frames_failing.store(failing ? 1 : 0);
    if (failing == std::exchange(failing_, failing)) return;
    const std::string line = failing ? "frames are not written: " + written.error().found : "frames are written again";
    session_.note(databuffer::NoteKind::loss, line);
    failing ? log::warning(written.error().message() + "; each frame tries again") : log::info(line);
  }

  databuffer::Session& session_;
  Display& mpd_;
  int size_;
  bool failing_ = false;
  display::FrameSteps steps_;
  std::optional<display::FrameWriter> frames_;
  std::optional<display::FramePublisher> publisher_;
  std::int64_t next_frame_ns_ = 0;  // CLOCK_MONOTONIC
};

error::Expected<void> run_headless_live(databuffer::Session& session, HeadlessDisplay& headless) {
  while (!databuffer::stop_requested()) {
    headless.step(session.sim_time_ns());
    std::this_thread::sleep_for(kHeadlessInterval);
  }
  return headless.end(session.sim_time_ns());
}

error::Expected<void> run_headless_lockstep(databuffer::TickLoop& loop, HeadlessDisplay& headless) {
  std::int64_t last_ns = 0;
  while (const auto due = loop.wait()) {
    last_ns = due->sim_time_ns;
    if (auto stepped = headless.step_in_lockstep(last_ns); !stepped) return stepped;
    loop.done(*due);
  }
  if (auto outcome = loop.outcome(); !outcome) return outcome;
  return headless.end(last_ns);
}

error::Expected<void> run_headless(databuffer::Session& session, const radar::RadarConfiguration& configuration,
                                   const databuffer::ProgramOptions& options, const DisplayOptions& display_options,
                                   int size, std::optional<display::FramePublisher> publisher) {
  std::optional<display::FrameWriter> frames;
  if (!display_options.frames.empty()) {
    auto created = display::FrameWriter::create(display_options.frames,
                                                static_cast<std::size_t>(display_options.keep.value_or(0)));
    if (!created) return tl::unexpected(created.error());
    frames = std::move(*created);
  }
  auto context = display::gl::open_headless();
  if (!context) return tl::unexpected(context.error());
  log::info("renderer " + display::gl::renderer_name() + "; frames go to " +
            (frames ? display_options.frames : "the segment"));
  Display mpd(session, configuration, !options.lockstep.empty());
  HeadlessDisplay headless(session, mpd, size, display_options, std::move(frames), std::move(publisher));
  if (options.lockstep.empty()) return run_headless_live(session, headless);
  auto loop = databuffer::TickLoop::create(session, databuffer::LockstepRole::radar_display, options.lockstep);
  if (!loop) return tl::unexpected(loop.error());
  return run_headless_lockstep(*loop, headless);
}

// Display in a window: redraws on change, at most 60 times per second. Sends keys and clicks when they arrive.
class WindowDisplay {
 public:
  WindowDisplay(display::gl::Window& window, Display& mpd, display::PilotInput& pilot,
                std::optional<display::FramePublisher> publisher)
      : window_(window), mpd_(mpd), pilot_(pilot), publisher_(std::move(publisher)) {}

  // Waits for input until the next redraw is allowed, at most `max_wait_ns`.
  void take_input(std::int64_t max_wait_ns) {
    const std::int64_t wait_ns = std::min(next_redraw_ns_ - monotonic_ns(), max_wait_ns);
    const display::gl::WindowInput input =
        window_.take_input(1e-9 * static_cast<double>(std::max<std::int64_t>(wait_ns, 0)));
    pilot_.send(input);
    stale_ = stale_ || input.redraw_needed;
    if (window_.should_close()) databuffer::request_stop();
  }

  // Updates the display to this time. Redraws the window at most once per kRedrawInterval_ns.
  void step(std::int64_t sim_time_ns) {
    mpd_.update(sim_time_ns);
    const auto pixels = window_.pixels();
    const int size = std::min(pixels.width, pixels.height);
    if (redraw(pixels, size)) mpd_.note_shown();
    if (publisher_) publisher_->work(mpd_, size);
  }

 private:
  // Returns true if the window shows the result of the last update.
  bool redraw(const display::gl::Window::Pixels& pixels, int size) {
    const std::int64_t now_ns = monotonic_ns();
    if (now_ns < next_redraw_ns_) return false;
    next_redraw_ns_ = now_ns + kRedrawInterval_ns;
    if (size <= 0) return false;  // minimized
    const bool painted = mpd_.paint(size);
    if (painted && publisher_) publisher_->note_painted();
    if (!painted && !stale_) return true;
    window_.clear();
    mpd_.draw({0, 0, pixels.width, pixels.height});
    window_.present();
    stale_ = false;
    return true;
  }

  display::gl::Window& window_;
  Display& mpd_;
  display::PilotInput& pilot_;
  std::optional<display::FramePublisher> publisher_;
  std::int64_t next_redraw_ns_ = 0;  // CLOCK_MONOTONIC
  bool stale_ = true;                // true: the window does not show the current picture
};

error::Expected<void> run_window(databuffer::Session& session, const radar::RadarConfiguration& configuration,
                                 const databuffer::ProgramOptions& options, int size,
                                 std::optional<display::FramePublisher> publisher) {
  auto window = display::gl::open_window("YARS " + configuration.name + " - " + options.session, size);
  if (!window) return tl::unexpected(window.error());
  log::info("renderer " + display::gl::renderer_name());
  auto pilot = display::PilotInput::create(session, "radar-display");
  if (!pilot) return tl::unexpected(pilot.error());
  Display mpd(session, configuration, !options.lockstep.empty());
  WindowDisplay shown(**window, mpd, *pilot, std::move(publisher));
  if (options.lockstep.empty()) {
    while (!databuffer::stop_requested()) {
      shown.take_input(kRedrawInterval_ns);
      shown.step(session.sim_time_ns());
    }
    pilot->release_all();
    return {};
  }
  auto loop = databuffer::TickLoop::create(session, databuffer::LockstepRole::radar_display, options.lockstep);
  if (!loop) return tl::unexpected(loop.error());
  while (const auto due = loop->wait()) {
    shown.take_input(0);
    shown.step(due->sim_time_ns);
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
  const int size = display_options.size.value_or(configuration->view.size_pixels);
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
  databuffer::CommandLine app("YARS radar display", "radar-display");
  databuffer::ProgramOptions options;
  databuffer::add_common_options(app, options, true);
  DisplayOptions display_options;
  const databuffer::Option headless =
      app.flag("--headless", display_options.headless, "no window; pictures go to a folder or the session");
  app.option("--frames", display_options.frames, "folder for frame_NNNNNN.png")
      .value_name("DIR")
      .needs(headless)
      .otherwise("no files");
  app.option("--keep", display_options.keep, "number of newest frames that stay in the folder")
      .needs(headless)
      .range(1, 100'000'000)
      .otherwise("all");
  app.option("--every", display_options.every_s, "[s] sim time between frames").needs(headless).range(0.005, 1e6);
  app.flag("--publish", display_options.publish,
           "also publish pictures in the session for other programs, with edges of at most 1024 pixels");
  app.option("--size", display_options.size, "[pixels] edge of the display")
      .range(120, 4096)
      .otherwise("the configuration's")
      .in_user_file();
  return databuffer::run_program(argc, argv, app, options, [&] { return run(options, display_options); });
}
