#include "display/symbology/draw_list.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "lib/radar/view.hpp"

namespace yars::display {

namespace {

// Strokes of a glyph on a grid of 8 columns and 12 rows. A point is a digit 0-8 for x and a letter for y: a-m upwards
// from the base line, n-p one to three rows below it. A blank ends a polyline.
struct Glyph {
  char32_t code;
  std::string_view strokes;
  int width = 8;  // grid columns
};

constexpr std::array kGlyphs{
    Glyph{U' ', "", 6},
    Glyph{U'A', "0a4m8a 1d7d"},
    Glyph{U'B', "0a0m6m8k8i6g0g 6g8e8c6a0a"},
    Glyph{U'C', "8k6m2m0k0c2a6a8c"},
    Glyph{U'D', "0a0m5m8j8d5a0a"},
    Glyph{U'E', "8a0a0m8m 0g6g"},
    Glyph{U'F', "0a0m8m 0g6g"},
    Glyph{U'G', "8k6m2m0k0c2a6a8c8f5f"},
    Glyph{U'H', "0a0m 8a8m 0g8g"},
    Glyph{U'I', "4a4m 2a6a 2m6m"},
    Glyph{U'J', "0d0c2a6a8c8m"},
    Glyph{U'K', "0a0m 8m0f 3h8a"},
    Glyph{U'L', "0m0a8a"},
    Glyph{U'M', "0a0m4g8m8a"},
    Glyph{U'N', "0a0m8a8m"},
    Glyph{U'O', "2a0c0k2m6m8k8c6a2a"},
    Glyph{U'P', "0a0m6m8k8h6f0f"},
    Glyph{U'Q', "2a0c0k2m6m8k8c6a2a 5d8a"},
    Glyph{U'R', "0a0m6m8k8h6f0f 4f8a"},
    Glyph{U'S', "8k6m2m0k0i2g6g8e8c6a2a0c"},
    Glyph{U'T', "4a4m 0m8m"},
    Glyph{U'U', "0m0c2a6a8c8m"},
    Glyph{U'V', "0m4a8m"},
    Glyph{U'W', "0m2a4h6a8m"},
    Glyph{U'X', "0a8m 0m8a"},
    Glyph{U'Y', "0m4g8m 4g4a"},
    Glyph{U'Z', "0m8m0a8a"},
    Glyph{U'0', "2a0c0k2m5m7k7c5a2a", 7},
    Glyph{U'1', "1k4m4a 1a7a"},
    Glyph{U'2', "0k2m6m8k8i0a8a"},
    Glyph{U'3', "0k2m6m8k8i6g3g 6g8e8c6a2a0c"},
    Glyph{U'4', "6a6m0d8d"},
    Glyph{U'5', "8m0m0h6h8f8c6a2a0c"},
    Glyph{U'6', "8k6m2m0k0c2a6a8c8e6g2g0e"},
    Glyph{U'7', "0m8m3a"},
    Glyph{U'8', "2g0i0k2m6m8k8i6g2g0e0c2a6a8c8e6g"},
    Glyph{U'9', "0c2a6a8c8k6m2m0k0i2g6g8i"},
    Glyph{U'+', "4c4k 0g8g"},
    Glyph{U'-', "1g7g"},
    Glyph{U'.', "1a1b", 2},
    Glyph{U':', "1c1d 1i1j", 2},
    Glyph{U'/', "0a8m"},
    Glyph{U'<', "7l1g7b"},
    Glyph{U'>', "1l7g1b"},
    Glyph{U'(', "3m1j1d3a", 4},
    Glyph{U')', "1m3j3d1a", 4},
    Glyph{U',', "1b1n0p", 2},
    Glyph{U';', "1b1n0p 1i1j", 2},
    Glyph{U'\'', "1m1j", 2},
    Glyph{U'[', "3m0m0a3a", 4},
    Glyph{U']', "0m3m3a0a", 4},
    Glyph{U'_', "0a8a"},
    Glyph{U'?', "0k2m6m8k8i4g4e 4a4b"},
    Glyph{U'!', "1m1e 1a1b", 2},
    Glyph{U'=', "1e7e 1i7i"},
    Glyph{U'%', "0a8m 0k1m3m3k2j0k 5b6d8c7a5b"},
    Glyph{U'\u00b0', "1m3m4l4j3i1i0j0l1m", 4},
    Glyph{U'^', "4a4m 0h4m8h"},
    Glyph{U'v', "4m4a 0f4a8f"},
};
constexpr Glyph kUnknown{U'\ufffd', "0a0m8m8a0a"};

constexpr int kGap = 3;                  // grid columns between glyphs
constexpr float kColumn = 0.58F / 8.0F;  // [cap heights] width of a grid column; 8 columns are 0.58 wide
constexpr float kRow = 1.0F / 12.0F;     // [cap heights] height of a grid row
constexpr std::size_t kMaxPoints = 24;   // maximum per polyline; glyphs have at most 16; further points are dropped

const Glyph& glyph_of(char32_t code) {
  if (code >= U'a' && code <= U'z' && code != U'v') code -= U'a' - U'A';
  for (const Glyph& glyph : kGlyphs) {
    if (glyph.code == code) return glyph;
  }
  return kUnknown;
}

// Removes one character from the front and returns its code. Each byte of a UTF-8 sequence of 3 or 4 bytes gives
// kUnknown.
char32_t take(std::string_view& text) {
  const auto first = static_cast<unsigned char>(text.front());
  text.remove_prefix(1);
  if (first < 0x80U) return first;
  if ((first & 0xe0U) != 0xc0U || text.empty()) return kUnknown.code;
  const auto second = static_cast<unsigned char>(text.front());
  text.remove_prefix(1);
  return ((first & 0x1fU) << 6U) | (second & 0x3fU);
}

void stroke_glyph(const Glyph& glyph, float left, StrokeSink& sink) {
  std::array<Point, kMaxPoints> points;
  std::size_t count = 0;
  const auto lift_pen = [&] {
    if (count > 0) sink.polyline({points.data(), count});
    count = 0;
  };
  for (std::size_t i = 0; i < glyph.strokes.size();) {
    if (glyph.strokes[i] == ' ') {
      lift_pen();
      ++i;
      continue;
    }
    const float column = static_cast<float>(glyph.strokes[i] - '0');
    const char letter = glyph.strokes[i + 1];
    const float row = static_cast<float>(letter <= 'm' ? letter - 'a' : 'm' - letter);
    if (count < kMaxPoints) points[count++] = {left + column * kColumn, -row * kRow};
    i += 2;
  }
  lift_pen();
}

}  // namespace

void stroke_text(std::string_view text, StrokeSink& sink) {
  int column = 0;
  while (!text.empty()) {
    const Glyph& glyph = glyph_of(take(text));
    stroke_glyph(glyph, static_cast<float>(column) * kColumn, sink);
    column += glyph.width + kGap;
  }
}

std::string in_capitals(std::string_view text) {
  std::string capitals(text);
  for (char& letter : capitals)
    if (letter >= 'a' && letter <= 'z') letter = static_cast<char>(letter - 'a' + 'A');
  return capitals;
}

float text_width(std::string_view text) {
  int columns = 0;
  while (!text.empty()) columns += glyph_of(take(text)).width + kGap;
  return static_cast<float>(columns > 0 ? columns - kGap : 0) * kColumn;
}

namespace {

constexpr float kStroke = 1.35F;      // [units] thinner strokes are faint; thicker ones close the gaps in 10-unit text
constexpr float kThin = 1.0F;         // [units] arcs and leader lines; thin, so that they hide little video
constexpr float kHalo = 1.4F;         // [units] black margin of a stroke, for contrast on bright video
constexpr float kDash = 3.0F;         // [units] length of a dash and of a gap
constexpr float kBoxMargin = 3.0F;    // [units] distance from a text to its frame
constexpr float kPlateMargin = 2.0F;  // [units] black margin around a text
constexpr int kCircleSides = 24;

float rounded(float value) {
  return std::round(value * 8.0F) / 8.0F;
}
Point rounded(Point point) {
  return {rounded(point.x), rounded(point.y)};
}

// `degrees`: clockwise from up.
Point on_circle(Point center, float radius, float degrees) {
  const float angle = degrees * std::numbers::pi_v<float> / 180.0F;
  return {center.x + radius * std::sin(angle), center.y - radius * std::cos(angle)};
}

// Scales and moves the strokes of the font to display units and adds them to a list.
class PlacedText final : public StrokeSink {
 public:
  PlacedText(DrawList& list, Point base_left, float height, Ink ink)
      : list_(list), base_left_(base_left), height_(height), ink_(ink) {}
  void polyline(std::span<const Point> points) override {
    for (std::size_t i = 1; i < points.size(); ++i) list_.line(placed(points[i - 1]), placed(points[i]), ink_);
  }

 private:
  Point placed(Point point) const { return {base_left_.x + point.x * height_, base_left_.y + point.y * height_}; }
  DrawList& list_;
  Point base_left_;
  float height_;
  Ink ink_;
};

}  // namespace

void DrawList::clear() {
  for (LayerContent& layer : layers_) {
    layer.plates.clear();
    layer.strokes.clear();
  }
  layer_ = Layer::symbols;
  video_steps_.clear();
  panels_.clear();
  occupied_.clear();
}

void DrawList::line(Point from, Point to, Ink ink) {
  if (!std::isfinite(from.x + from.y + to.x + to.y)) return;
  const bool thin = ink == Ink::dim;
  current().strokes.push_back({rounded(from), rounded(to), thin ? kThin : kStroke, thin ? 0.0F : kHalo, ink});
}

void DrawList::leader(Point from, Point to) {
  current().strokes.push_back({rounded(from), rounded(to), kThin, kHalo, Ink::dim});
}

void DrawList::polyline(std::span<const Point> points, Ink ink) {
  for (std::size_t i = 1; i < points.size(); ++i) line(points[i - 1], points[i], ink);
}

void DrawList::circle(Point center, float radius, bool dashed) {
  std::array<Point, kCircleSides> corners;
  for (int i = 0; i < kCircleSides; ++i) {
    corners[static_cast<std::size_t>(i)] = on_circle(center, radius, 360.0F * static_cast<float>(i) / kCircleSides);
  }
  polygon(corners, dashed);
}

void DrawList::polygon(std::span<const Point> corners, bool dashed) {
  float travelled = 0.0F;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point from = corners[i];
    const Point to = corners[(i + 1) % corners.size()];
    if (!dashed) {
      line(from, to);
      continue;
    }
    const float length = std::hypot(to.x - from.x, to.y - from.y);
    // The outline is divided at every multiple of kDash, into a dash, a gap, a dash and so on. 1e-3 and 1e-2 [units]
    // prevent steps of length 0 due to rounding.
    for (float done = 0.0F; done < length;) {
      const float phase = std::floor((travelled + 1e-3F) / kDash);
      const float step = std::min(length - done, (phase + 1.0F) * kDash - travelled);
      const auto at = [&](float along) {
        return Point{from.x + (to.x - from.x) * along / length, from.y + (to.y - from.y) * along / length};
      };
      if (std::fmod(phase, 2.0F) < 0.5F) line(at(done), at(done + step));
      done += std::max(step, 1e-2F);
      travelled += std::max(step, 1e-2F);
    }
  }
}

void DrawList::thin_arc(Point center, float radius, float from_deg, float to_deg) {
  // A chord of c = 8 units deviates from an arc of radius r by c^2 / (8 r). At r = 100 units, the first of four arcs,
  // this is 0.08 units. At a spacing of 0.05 of the range, the first arc has r = 20 units and deviates by 0.4 units.
  // 57.3 deg is 1 rad.
  const int sides = std::max(2, static_cast<int>(radius * (to_deg - from_deg) / 57.3F / 8.0F));
  Point last = on_circle(center, radius, from_deg);
  for (int i = 1; i <= sides; ++i) {
    const Point next =
        on_circle(center, radius, from_deg + (to_deg - from_deg) * static_cast<float>(i) / static_cast<float>(sides));
    line(last, next, Ink::dim);
    last = next;
  }
}

void DrawList::video_step(const Rect& rect, std::uint8_t video) {
  video_steps_.push_back({rect, video});
}

void DrawList::plate(const Rect& rect) {
  current().plates.push_back(rect);
}

void DrawList::panel(const Rect& rect, const Color& color) {
  panels_.push_back({rect, color});
}

void DrawList::frame(const Rect& rect, Ink ink) {
  const std::array<Point, 5> corners{Point{rect.left, rect.top}, Point{rect.right, rect.top},
                                     Point{rect.right, rect.bottom}, Point{rect.left, rect.bottom},
                                     Point{rect.left, rect.top}};
  polyline(corners, ink);
}

void DrawList::occupy(std::string_view name, const Rect& rect, BoxKind kind) {
  const Point from = rounded(Point{rect.left, rect.top}), to = rounded(Point{rect.right, rect.bottom});
  occupied_.push_back({std::string(name), {from.x, from.y, to.x, to.y}, kind});
}

void DrawList::blank_behind_texts() {
  draw_on(Layer::symbols);
  for (const OccupiedBox& box : occupied_) {
    if (box.kind != BoxKind::text) continue;
    const Rect field = grown(box.rect, kPlateMargin);
    const auto lies_behind = [&](const Segment& line) { return crosses(field, line.from, line.to); };
    if (std::ranges::any_of(content(Layer::lines).strokes, lies_behind) ||
        std::ranges::any_of(content(Layer::points).strokes, lies_behind)) {
      plate(field);
    }
  }
}

Rect text_box(std::string_view words, Point at, const TextStyle& style) {
  const float width = text_width(words) * style.height;
  const float left = style.align == Align::left     ? at.x
                     : style.align == Align::center ? at.x - width / 2.0F
                                                    : at.x - width;
  const Rect ink{left, at.y - style.height / 2.0F, left + width, at.y + style.height / 2.0F};
  return style.boxed ? grown(ink, kBoxMargin) : ink;
}

Rect DrawList::text(std::string_view words, Point at, const TextStyle& style, BoxKind kind) {
  const Rect box = text_box(words, at, style);
  if (style.plate) plate(grown(box, kPlateMargin));
  if (style.boxed) {
    const std::array<Point, 4> corners{Point{box.left, box.top}, Point{box.right, box.top},
                                       Point{box.right, box.bottom}, Point{box.left, box.bottom}};
    polygon(corners, false);
  }
  const float margin = style.boxed ? kBoxMargin : 0.0F;
  PlacedText placed(*this, {box.left + margin, box.bottom - margin}, style.height, style.ink);
  stroke_text(words, placed);
  occupy(words, box, kind);
  return box;
}

namespace {

Rect box_of(const Rect& plate) {
  return plate;
}

Rect box_of(const Panel& panel) {
  return panel.rect;
}

Rect box_of(const VideoStep& step) {
  return step.rect;
}

Rect box_of(const Segment& stroke) {
  const auto [left, right] = std::minmax(stroke.from.x, stroke.to.x);
  const auto [top, bottom] = std::minmax(stroke.from.y, stroke.to.y);
  return grown({left, top, right, bottom}, stroke.width / 2.0F + stroke.halo);
}

// Without insertions, elements are compared one by one. Else all between the equal begins and the equal ends differ.
template <class Element>
void visit_changed(const std::vector<Element>& before, const std::vector<Element>& after,
                   const std::function<void(const Rect&)>& box) {
  const bool same_count = before.size() == after.size();
  std::size_t begin = 0, end = 0;  // equal elements at the start and at the end
  const std::size_t common = std::min(before.size(), after.size());
  while (begin < common && before[begin] == after[begin]) ++begin;
  while (end < common - begin && before[before.size() - 1 - end] == after[after.size() - 1 - end]) ++end;
  for (std::size_t i = begin; i < before.size() - end; ++i)
    if (!same_count || !(before[i] == after[i])) box(box_of(before[i]));
  for (std::size_t i = begin; i < after.size() - end; ++i)
    if (!same_count || !(before[i] == after[i])) box(box_of(after[i]));
}

}  // namespace

void visit_changes(const DrawList& before, const DrawList& after, const std::function<void(const Rect&)>& box) {
  visit_changed(before.panels(), after.panels(), box);
  visit_changed(before.video_steps(), after.video_steps(), box);
  for (std::size_t layer = 0; layer < kLayers; ++layer) {
    visit_changed(before.content(static_cast<Layer>(layer)).plates, after.content(static_cast<Layer>(layer)).plates,
                  box);
    visit_changed(before.content(static_cast<Layer>(layer)).strokes, after.content(static_cast<Layer>(layer)).strokes,
                  box);
  }
}

namespace {

Color color(const radar::Rgb& rgb) {
  return {static_cast<float>(rgb.red), static_cast<float>(rgb.green), static_cast<float>(rgb.blue)};
}

}  // namespace

ColorScheme color_scheme(const radar::ColorConfiguration& colors) {
  return {{}, color(colors.video), color(colors.symbols), color(colors.lines)};
}

}  // namespace yars::display
