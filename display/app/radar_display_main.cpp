// Program radar-display: the display in a window, as PNG files in a folder, or as frames in the segment.

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "config/schema/load.hpp"
#include "display/app/frame_output_shell.hpp"
#include "display/app/window_display_shell.hpp"
#include "display/gl/context.hpp"
#include "display/host/display.hpp"
#include "display/host/session_link_shell.hpp"
#include "lib/log/log.hpp"
#include "lib/radar/modes.hpp"
#include "runtime/process.hpp"
#include "runtime/program.hpp"
#include "runtime/tick_loop.hpp"

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
  bool bezel = false, no_bezel = false;
  bool help = false;
  std::optional<int> tooltip;  // button

  bool shows_panel() const { return bezel || tooltip; }
};

// Interval of updates without a window. If sim time runs at the rate of real time, a frame follows the start of its
// step (FrameSteps) by about 10 ms at most. No sweep is lost, because the session's ring keeps sweeps for 5 s.
constexpr std::chrono::milliseconds kHeadlessInterval{10};

// [ns] Longest step of a display on time: below 5 pictures a second a pilot cannot fly by the display.
constexpr std::int64_t kMaxStep_ns = 200'000'000;

// Display without a window: paints when a picture is due for the folder or the segment.
class HeadlessDisplay {
 public:
  HeadlessDisplay(databuffer::Session& session, Display& mpd, int size, const DisplayOptions& options,
                  std::optional<display::FrameWriter> frames, std::optional<display::FramePublisher> publisher)
      : session_(session),
        mpd_(mpd),
        size_(size),
        steps_(options.every_s),
        every_ns_(static_cast<std::int64_t>(options.every_s * 1e9)),
        frames_(std::move(frames)),
        publisher_(std::move(publisher)),
        panel_edge_(options.shows_panel() ? display::panel_edge(size, options.bezel) : 0) {
    view_.bezel = options.bezel;
    view_.tooltip = view_.lit = options.tooltip.value_or(0);
    mpd_.show_hints(true);
    mpd_.show_help(options.help);
    if (frames_) mpd_.keep_video(false);  // a file shows its tick, whatever was painted before
  }

  // [ns] Longest step on time: of frames in a folder alone the interval between them.
  std::int64_t max_step_ns() const { return publisher_ ? kMaxStep_ns : std::max(kMaxStep_ns, every_ns_); }

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
    next_frame_ns_ = now_ns + display::kRedrawInterval_ns;
    return true;
  }

  error::Expected<void> write(std::int64_t number) {
    if (frames_) {
      if (auto written = frames_->write(panel_edge_ > 0 ? mpd_.read_panel(view_, panel_edge_) : mpd_.read(), number);
          !written)
        return written;
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
  std::int64_t every_ns_;
  std::optional<display::FrameWriter> frames_;
  std::optional<display::FramePublisher> publisher_;
  display::host::PanelView view_;
  int panel_edge_;                  // [pixels] edge of the frames with their surround; 0: the picture alone
  std::int64_t next_frame_ns_ = 0;  // CLOCK_MONOTONIC
};

// Runs step(). The ticks that pass during a step above `max_ns` count as skipped, for the health of the session.
template <class Function>
void timed(databuffer::Session& session, std::int64_t max_ns, const Function& step) {
  const std::int64_t began_ns = monotonic_ns();
  step();
  const std::int64_t now_ns = monotonic_ns();
  if (now_ns - began_ns <= max_ns) return;
  constexpr auto kRole = static_cast<std::size_t>(databuffer::LockstepRole::radar_display);
  session.layout().skipped_ticks[kRole].add(static_cast<std::uint64_t>((now_ns - began_ns) / radar::kTickNanoseconds),
                                            now_ns);
}

error::Expected<void> run_headless_live(databuffer::Session& session, HeadlessDisplay& headless) {
  while (!runtime::stop_requested()) {
    timed(session, headless.max_step_ns(), [&] { headless.step(session.sim_time_ns()); });
    std::this_thread::sleep_for(kHeadlessInterval);
  }
  return headless.end(session.sim_time_ns());
}

error::Expected<void> run_headless_lockstep(runtime::TickLoop& loop, HeadlessDisplay& headless) {
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
                                   const runtime::ProgramOptions& options, const DisplayOptions& display_options,
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
  auto loop = runtime::TickLoop::create(session, databuffer::LockstepRole::radar_display, options.lockstep);
  if (!loop) return tl::unexpected(loop.error());
  return run_headless_lockstep(*loop, headless);
}

constexpr int kMaxPicture = 4096;  // [pixels] edge

struct WindowSize {
  std::optional<int> picture;  // [pixels] edge; nullopt: by the screen's height
  bool bezel = true;
};

error::Expected<void> run_window(databuffer::Session& session, const radar::RadarConfiguration& configuration,
                                 const runtime::ProgramOptions& options, const WindowSize& size,
                                 std::optional<display::FramePublisher> publisher) {
  std::optional<int> edge;
  if (size.picture) edge = display::panel_edge(*size.picture, size.bezel);
  // A larger picture could not be published.
  const int max_picture = publisher ? static_cast<int>(databuffer::kMaxFramePixels) : kMaxPicture;
  auto window = display::gl::open_window("YARS " + configuration.name + " - " + options.session + "  (? for help)",
                                         edge, display::panel_edge(max_picture, size.bezel));
  if (!window) return tl::unexpected(window.error());
  log::info("renderer " + display::gl::renderer_name());
  auto pilot = display::PilotInput::create(session, "radar-display");
  if (!pilot) return tl::unexpected(pilot.error());
  Display mpd(session, configuration, !options.lockstep.empty());
  display::WindowDisplay shown(**window, mpd, *pilot, std::move(publisher), size.bezel);
  if (options.lockstep.empty()) {
    while (!runtime::stop_requested()) {
      shown.take_input(display::kRedrawInterval_ns);
      timed(session, kMaxStep_ns, [&] { shown.step(session.sim_time_ns()); });
    }
    pilot->release_all();
    return {};
  }
  auto loop = runtime::TickLoop::create(session, databuffer::LockstepRole::radar_display, options.lockstep);
  if (!loop) return tl::unexpected(loop.error());
  while (const auto due = loop->wait()) {
    shown.take_input(0);
    shown.step(due->sim_time_ns);
    loop->done(*due);
  }
  return loop->outcome();
}

error::Expected<void> run(const runtime::ProgramOptions& options, const DisplayOptions& display_options) {
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
  return run_window(*session, *configuration, options, {display_options.size, !display_options.no_bezel},
                    std::move(publisher));
}

}  // namespace

int main(int argc, char** argv) {
  runtime::CommandLine app("YARS radar display", "radar-display");
  runtime::ProgramOptions options;
  runtime::add_common_options(app, options, runtime::ProgramKind::role);
  DisplayOptions display_options;
  const runtime::Option headless =
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
  app.flag("--bezel", display_options.bezel, "frames with the bezel and its twenty buttons around the picture")
      .needs(headless);
  app.flag("--show-help", display_options.help, "frames with the help over the picture").needs(headless);
  app.option("--tooltip", display_options.tooltip, "frames with the tooltip of this button, 1 to 20")
      .needs(headless)
      .range(1, 20)
      .otherwise("no tooltip");
  app.flag("--no-bezel", display_options.no_bezel, "a window without the bezel; key F8 shows and hides it");
  app.flag("--publish", display_options.publish,
           "also publish pictures in the session for other programs, with edges of at most 1024 pixels");
  app.option("--size", display_options.size, "[pixels] edge of the picture, without the bezel")
      .range(120, kMaxPicture)
      .otherwise("the configuration's; a window opens at two thirds of the screen's height")
      .in_user_file();
  return runtime::run_program(argc, argv, app, options, [&] { return run(options, display_options); });
}
