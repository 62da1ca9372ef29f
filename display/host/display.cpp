#include "display/host/display.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "config/schema/load.hpp"
#include "databuffer/session/session.hpp"
#include "display/gl/context.hpp"
#include "display/gl/damage.hpp"
#include "display/gl/display.hpp"
#include "display/gl/gpu_objects.hpp"
#include "display/gl/host_state_guard.hpp"
#include "display/gl/passes.hpp"
#include "display/host/session_link_shell.hpp"
#include "display/symbology/bezel.hpp"
#include "display/symbology/overlay_texts.hpp"
#include "lib/file/text_file.hpp"
#include "lib/log/log.hpp"

namespace yars::display::host {

namespace {

constexpr int kInitialSize = 480;  // [pixels] edge of the display until the first paint()
constexpr int kMinOpengl = 33;     // 10 * major + minor: OpenGL 3.3, which has GLSL 3.30 and sampler objects
constexpr int kButtons = 20;

}  // namespace

struct Display::State {
  State(std::optional<databuffer::Session> own_session, databuffer::Session* joined,
        const radar::RadarConfiguration& configuration, bool lockstep)
      : own(std::move(own_session)),
        session(own ? &*own : joined),
        colors(color_scheme(configuration.view.colors)),
        renderer(configuration, kInitialSize),
        feed(
            *session, lockstep, [this](const databuffer::Sweep& sweep) { renderer.add(sweep); },
            [this](const databuffer::PatchMap& map, std::span<const std::uint8_t> pixels) {
              const gl::HostStateGuard guard;
              renderer.add(map, pixels);
            }) {
    renderer.keep_video(!lockstep);
  }

  error::Expected<PilotInput*> pilot_of_session() {
    if (!pilot) {
      auto created = PilotInput::create(*session, name);
      if (!created) return tl::unexpected(created.error());
      pilot.emplace(std::move(*created));
    }
    return &*pilot;
  }

  std::optional<databuffer::Session> own;  // session opened by attach(); nullopt: the host's session is used
  databuffer::Session* session;
  std::string name = "glass";
  ColorScheme colors;
  gl::Display renderer;
  gl::PanelPass panel_pass;
  DrawList panel, painted_panel;                 // surround to draw, and surround of the last paint_panel()
  gl::Damage unshown;                            // parts of the picture that have changed since shown_at was drawn
  std::optional<Viewport> shown_at;              // of the last draw_panel() or refresh_panel()
  DrawList shown_panel;                          // its surround
  std::optional<gl::Framebuffer> panel_picture;  // made by the first read_panel()
  bool help = false, hints = false;
  gl::Readback readback;
  SessionFeed feed;
  // Created at the first press or click, because it occupies one of the session's 16 input lanes.
  std::optional<PilotInput> pilot;
  std::int64_t sim_time_ns = 0;  // sim time of the last update()
  std::int64_t painted_tick = 0, painted_sim_time_ns = 0;
};

Display::Display(std::unique_ptr<State> state) : state_(std::move(state)) {}
Display::Display(Display&&) noexcept = default;
Display& Display::operator=(Display&&) noexcept = default;
Display::~Display() = default;

Display::Display(databuffer::Session& session, const radar::RadarConfiguration& configuration, bool lockstep) {
  const gl::HostStateGuard guard;
  state_ = std::make_unique<State>(std::nullopt, &session, configuration, lockstep);
}

error::Expected<Display> Display::attach(const AttachOptions& options) {
  if (const int version = gl::opengl_version(); version < kMinOpengl)
    return error::fail("display", "a current context of OpenGL 3.3 or later",
                       version == 0 ? "none" : std::to_string(version / 10) + "." + std::to_string(version % 10),
                       "make one current on this thread first");
  auto configuration = config::load_configuration(file::installed_file(options.configuration));
  if (!configuration) return tl::unexpected(configuration.error());
  for (const std::string& warning : configuration->warnings) log::warning(warning);
  auto session = databuffer::Session::open(options.session, options.name);
  if (!session) return tl::unexpected(session.error());
  const gl::HostStateGuard guard;
  auto state = std::make_unique<State>(std::move(*session), nullptr, configuration->radar, false);
  state->name = options.name;
  return Display(std::move(state));
}

void Display::update() {
  update(state_->session->sim_time_ns());
}

void Display::update(std::int64_t sim_time_ns) {
  state_->session->heartbeat();
  state_->sim_time_ns = sim_time_ns;
  state_->feed.refresh(sim_time_ns);
}

bool Display::paint(int size) {
  State& state = *state_;
  const gl::HostStateGuard guard;
  const int wanted = std::clamp(size, 1, kMaxPixels);
  if (wanted != state.renderer.size()) state.renderer.resize(wanted);
  DisplayInput input = state.feed.input();
  input.help = state.help;
  input.hints = state.hints;
  if (!state.renderer.draw(input)) return false;
  if (state.unshown.size() != wanted) {
    state.unshown.reset(wanted);
    state.unshown.mark_all();
  }
  state.unshown.add(state.renderer.damage());
  state.painted_tick = state.feed.input().state.tick;
  state.painted_sim_time_ns = state.sim_time_ns;
  return true;
}

bool Display::draw(const Viewport& viewport) {
  const int size = std::min({viewport.width, viewport.height, kMaxPixels});
  if (size <= 0) return false;
  // paint() has its own HostStateGuard, which binds the host's framebuffer again. show() draws into that framebuffer.
  const bool changed = paint(size);
  const gl::HostStateGuard guard;
  state_->renderer.show(viewport.left + (viewport.width - size) / 2, viewport.bottom + (viewport.height - size) / 2);
  return changed;
}

namespace {

PanelLayout layout_of(const PanelView& view) {
  return {view.bezel ? kBezelBorder : 0.0F};
}

// Edge of the picture within a panel [pixels].
int picture_edge(const PanelView& view, int panel_edge) {
  return static_cast<int>(std::lround(static_cast<float>(panel_edge) * kDisplayUnits / layout_of(view).edge()));
}

}  // namespace

bool Display::paint_panel(const PanelView& view, int edge) {
  State& state = *state_;
  const bool painted = paint(picture_edge(view, edge));
  const PanelLayout layout = layout_of(view);
  state.panel.clear();
  draw_bezel(layout, view.lit, state.panel);
  if (view.tooltip >= 1 && view.tooltip <= kButtons) draw_tooltip(layout, input(), view.tooltip, state.panel);
  if (!view.notice.empty()) draw_notice(layout, view.notice, state.panel);
  if (state.panel == state.painted_panel) return painted;
  state.painted_panel = state.panel;
  return true;
}

namespace {

// The largest square of a panel in the middle of the viewport.
gl::OverlayPass::Target square_in(const Viewport& viewport, const PanelView& view) {
  const auto max_edge = static_cast<int>(static_cast<float>(kMaxPixels) * layout_of(view).edge() / kDisplayUnits);
  const int edge = std::min({viewport.width, viewport.height, max_edge});
  return {.left = viewport.left + (viewport.width - edge) / 2,
          .bottom = viewport.bottom + (viewport.height - edge) / 2,
          .edge = edge,
          .units = layout_of(view).edge()};
}

}  // namespace

bool Display::draw_panel(const PanelView& view, const Viewport& viewport) {
  State& state = *state_;
  const gl::OverlayPass::Target square = square_in(viewport, view);
  if (square.edge <= 0) return false;
  const bool changed = paint_panel(view, square.edge);
  const int inner = picture_edge(view, square.edge);
  const gl::HostStateGuard guard;
  state.renderer.show(square.left + (square.edge - inner) / 2, square.bottom + (square.edge - inner) / 2);
  state.panel_pass.draw(state.panel, state.colors, square);
  state.unshown.clear();
  state.shown_at = viewport;
  state.shown_panel = state.panel;
  return changed;
}

Viewport Display::refresh_panel(const PanelView& view, const Viewport& viewport) {
  State& state = *state_;
  gl::OverlayPass::Target square = square_in(viewport, view);
  if (square.edge <= 0) return {};
  paint_panel(view, square.edge);
  if (state.shown_at != viewport || state.shown_panel != state.panel) {
    draw_panel(view, viewport);
    return {square.left, square.bottom, square.edge, square.edge};
  }
  if (state.unshown.empty()) return {};
  const int inner = picture_edge(view, square.edge), border = (square.edge - inner) / 2;
  const Rect changed = state.unshown.bounds();
  {
    const gl::HostStateGuard guard;
    state.renderer.show(square.left + border, square.bottom + border, state.unshown.rects());
    // Of the surround, only a tooltip or a notice lies over the picture.
    square.damage = &state.unshown;
    square.damage_left = border;
    square.damage_top = square.edge - inner - border;
    state.panel_pass.draw(state.panel, state.colors, square);
  }
  state.unshown.clear();
  const auto pixels = [](float length) { return static_cast<int>(length); };
  return {square.left + border + pixels(changed.left), square.bottom + border + inner - pixels(changed.bottom),
          pixels(changed.right - changed.left), pixels(changed.bottom - changed.top)};
}

imageio::Image Display::read_panel(const PanelView& view, int edge) {
  const gl::HostStateGuard guard;
  auto& picture = state_->panel_picture;
  if (!picture) picture.emplace(edge);
  if (picture->size() != edge) picture->resize(edge);
  picture->bind();
  draw_panel(view, {0, 0, edge, edge});
  state_->shown_at.reset();  // the host's framebuffer does not show it
  return picture->read();
}

void Display::keep_video(bool on) {
  state_->renderer.keep_video(on);
}

void Display::show_help(bool on) {
  state_->help = on;
}

void Display::show_hints(bool on) {
  state_->hints = on;
}

std::string Display::describe(int button) const {
  return button >= 1 && button <= kButtons ? words_of_button(input(), button) : std::string();
}

const DisplayInput& Display::input() const {
  return state_->feed.input();
}

void Display::note_shown() {
  state_->feed.note_shown();
}

imageio::Image Display::read() const {
  const gl::HostStateGuard guard;
  return state_->renderer.read();
}

bool Display::start_reading() {
  const gl::HostStateGuard guard;
  return state_->readback.start(state_->renderer.picture(), state_->painted_tick, state_->painted_sim_time_ns);
}

bool Display::take_read(Picture& picture) {
  const gl::HostStateGuard guard;
  return state_->readback.take_if_ready(picture);
}

bool Display::wait_for_read(Picture& picture) {
  const gl::HostStateGuard guard;
  return state_->readback.take_when_ready(picture);
}

error::Expected<void> Display::press(int button) {
  if (button < 1 || button > kButtons)
    return error::fail("display", "a button 1 to 20", std::to_string(button), "see docs/pilots_manual.md#buttons");
  auto pilot = state_->pilot_of_session();
  if (!pilot) return tl::unexpected(pilot.error());
  (*pilot)->press(button);
  return {};
}

error::Expected<bool> Display::click(double right, double down) {
  auto pilot = state_->pilot_of_session();
  if (!pilot) return tl::unexpected(pilot.error());
  return (*pilot)->click({static_cast<float>(right) * kDisplayUnits, static_cast<float>(down) * kDisplayUnits});
}

}  // namespace yars::display::host
