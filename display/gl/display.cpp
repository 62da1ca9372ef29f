#include "display/gl/display.hpp"

#include <epoxy/gl.h>

#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "display/gl/damage.hpp"
#include "display/gl/gpu_objects.hpp"
#include "display/gl/passes.hpp"
#include "display/symbology/draw_list.hpp"
#include "display/symbology/plan_view.hpp"
#include "display/symbology/radar_video.hpp"
#include "display/symbology/symbology.hpp"
#include "lib/radar/mission.hpp"
#include "lib/radar/view.hpp"

namespace yars::display::gl {

namespace {

// [pixels] Displacement across the direction of flight from which kept video is drawn again. Along the direction of
// flight kept video is scrolled by whole pixels, so its displacement is at most half a pixel, too.
constexpr double kKeptShift = 0.5;
constexpr int kScrollRows = 64;  // [pixels] way that kept video is scrolled before it is drawn again
// [display units] The same for video without new sweeps in a display that keeps no video: 0.2 pixel of 480.
constexpr double kVisibleShift = 0.2;
// Pictures, one second, after which sweeps that newer sweeps have replaced vanish from kept video; they vanish at the
// end of the scan if that is earlier. Until then they show where the newer sweeps leave gaps, which is near the
// aircraft and at the edges of the scan. Sweeps that none has replaced vanish at once.
constexpr int kMaxStalePictures = 60;

}  // namespace

// What a picture shows below its symbols: stored sweeps or a patch map, kept in a framebuffer of its own. The picture
// is this base with the symbols over it. Only the damaged parts of the picture are drawn again.
struct Display::State {
  struct Base {
    bool video = false;     // stored sweeps are drawn
    std::uint64_t map = 0;  // id of the patch map drawn; 0: none
    ViewFrame frame;
    std::uint8_t brightness = 0, contrast = 0;

    bool has_same_settings(const Base& other) const {
      return video == other.video && map == other.map && brightness == other.brightness && contrast == other.contrast;
    }
  };
  // State of the store when the video was drawn.
  struct DrawnStore {
    std::uint64_t version = 0, erasures = 0, losses = 0;
    std::uint32_t scan = 0;    // of the newest sweep when all sweeps were drawn
    std::uint64_t newest = 0;  // greatest serial
  };

  State(const SymbologyParameters& parameters, int size, const ColorScheme& colors_used)
      : view_section(parameters.view),
        blind_zone_deg(parameters.blind_zone_deg),
        colors(colors_used),
        view(parameters.view),
        picture(size),
        base_picture(size, kScrollRows),
        damage(size) {}

  double pixels_per_unit() const { return picture.size() / static_cast<double>(kDisplayUnits); }

  // True if the video in the base differs from the stored sweeps by more than new sweeps and its movement.
  bool needs_all_sweeps() {
    if (!keeps_video) return store.version() != drawn.version;
    if (store.losses() != drawn.losses) return true;
    if (store.erasures() == drawn.erasures) return false;
    return store.newest()->scan != drawn.scan || ++stale_pictures >= kMaxStalePictures;
  }

  // Rows by which to scroll the base so that it shows this frame; nullopt: it must be drawn again.
  std::optional<int> scroll_to(const ViewFrame& frame) const {
    if (!keeps_video)
      return displacement_units(view, base->frame, frame) < kVisibleShift ? std::optional(0) : std::nullopt;
    const std::optional<Movement> moved = movement_units(view, base->frame, frame);
    if (!moved || moved->across * pixels_per_unit() >= kKeptShift) return std::nullopt;
    const double rows = std::round(moved->along * pixels_per_unit());
    return rows >= 0.0 && rows <= kScrollRows ? std::optional(static_cast<int>(rows)) : std::nullopt;
  }

  void update_base(const Base& wanted) {
    if (!base || !base->has_same_settings(wanted)) return draw_base(wanted);
    if (!wanted.video) return;
    const std::optional<int> rows = scroll_to(wanted.frame);
    if (!rows || needs_all_sweeps()) return draw_base(wanted);
    if (*rows != scrolled) damage.mark_all();
    scrolled = *rows;
    if (store.version() != drawn.version) draw_new_sweeps();
  }

  void draw_base(const Base& wanted) {
    light = video_light(wanted.brightness, wanted.contrast);
    light_texture.set(light);
    base_picture.bind();
    const std::array<float, 4> ground{colors.ground.red, colors.ground.green, colors.ground.blue, 1.0F};
    glClearBufferfv(GL_COLOR, 0, ground.data());
    base = wanted;
    drawn = {store.version(), store.erasures(), store.losses(), wanted.video ? store.newest()->scan : 0, 0};
    stale_pictures = scrolled = 0;
    if (wanted.map != 0) map_pass.draw(wanted.map, light_texture, colors.video, base_picture.size());
    if (wanted.video) draw_sweeps();
    damage.mark_all();
  }

  // Draws the sweeps that the base does not show yet, in the frame of the base.
  void draw_sweeps() {
    place_wedges(store, view, base->frame, wedges, drawn.newest);
    const auto size = static_cast<float>(base_picture.size());
    if (keeps_video) base_picture.bind_with_rows_above();
    video_pass.draw(store, wedges, light_texture, colors.video, keeps_video ? size / (size + kScrollRows) : 1.0F);
    if (!wedges.empty()) drawn.newest = wedges.back().serial;
    drawn.version = store.version();
  }

  void draw_new_sweeps() {
    draw_sweeps();
    const auto scale = static_cast<float>(pixels_per_unit());
    const float margin = VideoPass::kMargin * scale + 1.0F;
    for (const Wedge& wedge : wedges) {
      const float reach = wedge.range / std::cos(wedge.half_width);
      const auto corner = [&](Point edge, float length) {
        return Point{(wedge.apex.x + edge.x * length) * scale,
                     (wedge.apex.y + edge.y * length) * scale + static_cast<float>(scrolled)};
      };
      damage.mark_polygon(std::array{corner({}, 0.0F), corner(wedge.left, reach), corner(wedge.right, reach)}, margin);
    }
  }

  void mark_changed_symbols() {
    const auto scale = static_cast<float>(pixels_per_unit());
    constexpr float kFadingEdge = 1.5F;  // [pixels]
    visit_changes(shown_list, list, [&](const Rect& box) {
      damage.mark(grown({box.left * scale, box.top * scale, box.right * scale, box.bottom * scale}, kFadingEdge));
    });
  }

  // Draws the damaged parts of the picture.
  void compose() {
    picture.bind();
    if (damage.is_all())
      picture.copy_from(base_picture, scrolled);
    else
      picture_pass.draw(base_picture, 0, 0, damage.rects(), scrolled);
    // Antialiased edges of symbols have an alpha below 1. The color mask keeps the alpha of the picture at 1.
    picture.bind();
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_FALSE);
    overlay_pass.draw(list, colors, light, {.edge = picture.size(), .damage = &damage});
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  }

  radar::ViewConfiguration view_section;
  double blind_zone_deg;
  ColorScheme colors;
  PlanView view;
  Framebuffer picture, base_picture;
  LightTexture light_texture;
  VideoPass video_pass;
  MapPass map_pass;
  OverlayPass overlay_pass;
  PicturePass picture_pass;
  PolarStore store;
  DrawList list, shown_list;  // symbols to draw, and symbols in the picture
  LabelMemory labels;
  std::vector<Wedge> wedges;
  std::array<float, 256> light{};
  bool keeps_video = true;
  std::optional<Base> base;  // nullopt: neither base nor picture have been drawn in this size
  DrawnStore drawn;
  int stale_pictures = 0;  // pictures since replaced sweeps in the video were erased from the store
  int scrolled = 0;        // lowest row of the base that the picture shows
  Damage damage;           // by the last draw()
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
  state_->picture.resize(size);
  state_->base_picture.resize(size);
  state_->base.reset();
}

int Display::size() const {
  return state_->picture.size();
}

void Display::keep_video(bool on) {
  // Kept video has rows above the picture, which other video does not draw.
  if (std::exchange(state_->keeps_video, on) != on) state_->base.reset();
}

bool Display::draw(const DisplayInput& input) {
  State& state = *state_;
  // Sweeps stored in a mode other than the radar state's are not shown.
  const bool video = shows_video(input.state) && state.store.mode() == input.state.mode;
  State::Base wanted;
  wanted.video = video;
  state.map_pass.keep(std::array{input.state.map_newest, input.state.map_old, input.state.map_stored});
  wanted.map = shows_map(input) && state.map_pass.has(input.map.id) ? input.map.id : 0;
  wanted.frame = present_frame(input, video ? state.store.newest() : nullptr);
  wanted.brightness = input.state.brightness;
  wanted.contrast = input.state.contrast;
  draw_symbology(input, {state.view_section, state.blind_zone_deg}, state.view, wanted.frame, state.labels, state.list);
  state.damage.reset(state.picture.size());
  state.update_base(wanted);
  state.mark_changed_symbols();
  if (state.damage.empty()) return false;
  state.compose();
  std::swap(state.list, state.shown_list);
  return true;
}

const Damage& Display::damage() const {
  return state_->damage;
}

imageio::Image Display::read() const {
  return state_->picture.read();
}

const Framebuffer& Display::picture() const {
  return state_->picture;
}

void Display::show(int left, int bottom) {
  const auto edge = static_cast<float>(size());
  show(left, bottom, std::array{Rect{0.0F, 0.0F, edge, edge}});
}

void Display::show(int left, int bottom, std::span<const Rect> parts) {
  state_->picture_pass.draw(state_->picture, left, bottom, parts);
}

}  // namespace yars::display::gl
