#include "display/draw_list.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "display/stroke_font.hpp"

namespace yars::display {

namespace {

constexpr float kStroke = 1.35F;      // [units] a pixel and a bit at 480: thinner fades, thicker clogs 10-unit text
constexpr float kThin = 1.0F;         // [units] arcs, which video must not drown in
constexpr float kHalo = 1.4F;         // [units] enough that bright video does not touch a stroke
constexpr float kDash = 3.0F;         // [units] dash and gap of an offset's outline
constexpr float kBoxMargin = 3.0F;    // [units] between a legend and its frame
constexpr float kPlateMargin = 2.0F;  // [units] of black around a text, as wide as its halo
constexpr int kCircleSides = 24;

float rounded(float value) {
  return std::round(value * 8.0F) / 8.0F;
}
Point rounded(Point point) {
  return {rounded(point.x), rounded(point.y)};
}

Point on_circle(Point center, float radius, float degrees) {
  const float angle = degrees * std::numbers::pi_v<float> / 180.0F;
  return {center.x + radius * std::sin(angle), center.y - radius * std::cos(angle)};
}

// Places the font's unit strokes on the glass.
class PlacedText final : public StrokeSink {
 public:
  PlacedText(DrawList& list, Point base_left, float height) : list_(list), base_left_(base_left), height_(height) {}
  void polyline(std::span<const Point> points) override {
    for (std::size_t i = 1; i < points.size(); ++i) list_.line(placed(points[i - 1]), placed(points[i]));
  }

 private:
  Point placed(Point point) const { return {base_left_.x + point.x * height_, base_left_.y + point.y * height_}; }
  DrawList& list_;
  Point base_left_;
  float height_;
};

}  // namespace

void DrawList::clear() {
  for (LayerContent& layer : layers_) {
    layer.plates.clear();
    layer.strokes.clear();
  }
  layer_ = Layer::symbols;
  video_steps_.clear();
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
    // Cut at every multiple of the dash length along the outline; ink the even pieces.
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
  // A side of 8 units leaves the true arc by 8^2 / (8 r): 0.08 units at the smallest radius drawn, 100.
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
  PlacedText placed(*this, {box.left + margin, box.bottom - margin}, style.height);
  stroke_text(words, placed);
  occupy(words, box, kind);
  return box;
}

}  // namespace yars::display
