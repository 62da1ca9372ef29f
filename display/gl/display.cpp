#include "display/gl/display.hpp"

#include <epoxy/gl.h>

#include <array>
#include <optional>
#include <vector>

#include "display/gl/framebuffer.hpp"
#include "display/gl/passes.hpp"
#include "display/gl/shaders.hpp"
#include "display/symbology/draw_list.hpp"
#include "display/symbology/plan_view.hpp"
#include "display/symbology/radar_video.hpp"
#include "display/symbology/symbology.hpp"
#include "lib/radar/mission.hpp"
#include "lib/radar/view.hpp"

namespace yars::display::gl {

namespace {

// [display units] Minimum displacement of the video that causes a redraw: 0.2 pixel on a display of 480 pixels.
constexpr double kVisibleShift = 0.2;

}  // namespace

struct Display::State {
  // Inputs that a picture shows, for comparison with the next picture. Symbols are compared separately, as draw lists.
  struct Shown {
    std::uint64_t video_version = 0;
    bool video = false;     // stored sweeps are drawn
    std::uint64_t map = 0;  // id of the patch map drawn; 0: none
    ViewFrame frame;
    std::uint8_t brightness = 0, contrast = 0;
    int size = 0;
  };

  State(const SymbologyParameters& parameters, int size, const ColorScheme& colors_used)
      : view_section(parameters.view),
        blind_zone_deg(parameters.blind_zone_deg),
        route(parameters.route),
        colors(colors_used),
        view(parameters.view),
        framebuffer(size) {}

  // True if the framebuffer already shows these inputs and the symbols in `list`. The video may be displaced by less
  // than kVisibleShift.
  bool is_shown(const Shown& wanted) const {
    return shown && shown->size == wanted.size && shown->video == wanted.video && shown->map == wanted.map &&
           shown->brightness == wanted.brightness && shown->contrast == wanted.contrast &&
           (!wanted.video || (shown->video_version == wanted.video_version &&
                              displacement_units(view, shown->frame, wanted.frame) < kVisibleShift)) &&
           list == shown_list;
  }

  void render(const Shown& wanted) {
    const std::array<float, 256> light = video_light(wanted.brightness, wanted.contrast);
    framebuffer.bind();
    const std::array<float, 4> ground{colors.ground.red, colors.ground.green, colors.ground.blue, 1.0F};
    glClearBufferfv(GL_COLOR, 0, ground.data());
    // Antialiased edges of symbols have an alpha below 1. The color mask keeps the alpha of the picture at 1.
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_FALSE);
    light_texture.set(light);
    if (wanted.video) {
      place_wedges(store, view, wanted.frame, wedges);
      video_pass.draw(store, wedges, light_texture, colors.video);
    }
    if (wanted.map != 0) map_pass.draw(wanted.map, light_texture, colors.video, wanted.size);
    overlay_pass.draw(list, colors, light, {static_cast<float>(framebuffer.size()) / kDisplayUnits});
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  }

  radar::ViewConfiguration view_section;
  double blind_zone_deg;
  std::vector<radar::RoutePoint> route;
  ColorScheme colors;
  PlanView view;
  Framebuffer framebuffer;
  LightTexture light_texture;
  VideoPass video_pass;
  MapPass map_pass;
  OverlayPass overlay_pass;
  PicturePass picture_pass;
  PolarStore store;
  DrawList list, shown_list;  // symbols to draw, and symbols in the framebuffer
  LabelMemory labels;
  std::vector<Wedge> wedges;
  std::optional<Shown> shown;
};

Display::Display(const SymbologyParameters& parameters, int size)
    : Display(parameters, size, color_scheme(parameters.view.colors)) {}
Display::Display(const SymbologyParameters& parameters, int size, const ColorScheme& colors)
    : state_(std::make_unique<State>(parameters, size, colors)) {}
Display::~Display() = default;
Display::Display(Display&&) noexcept = default;
Display& Display::operator=(Display&&) noexcept = default;

void Display::add(const databuffer::Sweep& sweep) {
  state_->store.insert(sweep);
}

void Display::add(const databuffer::PatchMap& map, std::span<const std::uint8_t> pixels) {
  state_->map_pass.add(map.id, map.size, pixels);
}

void Display::resize(int size) {
  state_->framebuffer.resize(size);
}

int Display::size() const {
  return state_->framebuffer.size();
}

bool Display::draw(const DisplayInput& input) {
  State& state = *state_;
  // Sweeps stored in a mode other than the radar state's are not shown.
  const bool video = shows_video(input.state) && state.store.mode() == input.state.mode;
  State::Shown wanted;
  wanted.video_version = state.store.version();
  wanted.video = video;
  state.map_pass.keep(std::array{input.state.map_newest, input.state.map_old, input.state.map_stored});
  wanted.map = shows_map(input) && state.map_pass.has(input.map.id) ? input.map.id : 0;
  wanted.frame = present_frame(input, video ? state.store.newest() : nullptr);
  wanted.brightness = input.state.brightness;
  wanted.contrast = input.state.contrast;
  wanted.size = state.framebuffer.size();
  draw_symbology(input, {state.view_section, state.blind_zone_deg, state.route}, state.view, wanted.frame, state.labels,
                 state.list);
  if (state.is_shown(wanted)) return false;
  state.render(wanted);
  state.shown = wanted;
  std::swap(state.list, state.shown_list);
  return true;
}

imageio::Image Display::read() const {
  return state_->framebuffer.read();
}

const Framebuffer& Display::picture() const {
  return state_->framebuffer;
}

void Display::show(int left, int bottom) {
  state_->picture_pass.draw(state_->framebuffer, left, bottom);
}

}  // namespace yars::display::gl
