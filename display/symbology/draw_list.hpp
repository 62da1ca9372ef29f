// What is drawn over the video: points and boxes in display units, the stroke font, the draw list, its colors.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lib/radar/configuration.hpp"

namespace yars::display {

// A place on the glass, in glass units: 480 to the edge of the square, x right, y down, origin upper left.
inline constexpr float kDisplayUnits = 480.0F;  // edge of the glass; the legends' layout is measured in it

struct Point {
  float x = 0.0F;
  float y = 0.0F;
  friend bool operator==(const Point&, const Point&) = default;
};

struct Rect {
  float left = 0.0F, top = 0.0F, right = 0.0F, bottom = 0.0F;
  friend bool operator==(const Rect&, const Rect&) = default;
};

// True when they share area; touching edges do not count.
inline bool intersect(const Rect& a, const Rect& b) {
  return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
}

// True when a part of the line from one point to the other lies within; touching an edge does not count.
inline bool crosses(const Rect& rect, Point from, Point to) {
  float begin = 0.0F, end = 1.0F;  // shares of the line that lie between the edges
  const auto cut = [&](float at, float step, float low, float high) {
    if (step == 0.0F) {
      if (at <= low || at >= high) end = -1.0F;
      return;
    }
    const float first = (low - at) / step, second = (high - at) / step;
    begin = std::max(begin, std::min(first, second));
    end = std::min(end, std::max(first, second));
  };
  cut(from.x, to.x - from.x, rect.left, rect.right);
  cut(from.y, to.y - from.y, rect.top, rect.bottom);
  return begin < end;
}

inline Rect grown(const Rect& rect, float by) {
  return {rect.left - by, rect.top - by, rect.right + by, rect.bottom + by};
}

// The glass's own vector font: capitals, digits and a few signs as polylines, readable at 10 units of height.
// In:  text, ASCII or UTF-8 of which only the degree sign is known; small letters read as capitals, but "v" is a
//      down arrow and "^" an up arrow, as the legends of PB 14 and 13 have them.
// Out: strokes in units of the cap height, x right, y down, origin at the left end of the base line.
// A character that the font has not is drawn as an empty box.

// Called once for each polyline of the text; the points are valid during the call.
class StrokeSink {
 public:
  virtual void polyline(std::span<const Point> points) = 0;

 protected:
  ~StrokeSink() = default;
};

void stroke_text(std::string_view text, StrokeSink& sink);

// Width of the inked part, in cap heights.
float text_width(std::string_view text);

// What is drawn over the video, as plain data: line segments, filled rectangles, steps of video, and the boxes
// that texts, scales and symbols take up (label_layout.hpp places labels clear of them).
// Coordinates are glass units, rounded to 1/8, so that a motion nobody sees leaves the list equal.
// A list keeps its memory from one picture to the next.

// Drawn one over the other, each with its plates, then its halos, below its strokes: range arcs and zero azimuth line;
// lines on the ground; points on the ground; texts and scales; notices; what the pilot steers, over everything.
enum class Layer : std::uint8_t { grid, lines, points, symbols, notices, steered };
inline constexpr std::size_t kLayers = 6;

enum class Ink : std::uint8_t { bright, dim };  // symbols; lines of the grid below them

struct Segment {
  Point from, to;
  float width = 0.0F;  // whole width
  float halo = 0.0F;   // black margin on either side that parts the stroke from the video
  Ink ink = Ink::bright;
  friend bool operator==(const Segment&, const Segment&) = default;
};

// A field of the gray scale: shown as the video level would be.
struct VideoStep {
  Rect rect;
  std::uint8_t video = 0;
  friend bool operator==(const VideoStep&, const VideoStep&) = default;
};

struct LayerContent {
  std::vector<Rect> plates;
  std::vector<Segment> strokes;
  friend bool operator==(const LayerContent&, const LayerContent&) = default;
};

// Texts and scales stand at fixed places, labels where label_layout.hpp puts them, points and the cursor where the
// ground is. A scale is lines with room between them; a solid one has none.
enum class BoxKind : std::uint8_t { text, label, scale, solid, point, cursor };

struct OccupiedBox {
  std::string name;  // the text itself, or what the scale or symbol is
  Rect rect;         // of a scale or a symbol with its ink, of a text to the middle of its outer strokes
  BoxKind kind = BoxKind::text;
  friend bool operator==(const OccupiedBox&, const OccupiedBox&) = default;
};

enum class Align : std::uint8_t { left, center, right };

struct TextStyle {
  float height = 10.0F;
  Align align = Align::center;
  bool boxed = false;
  bool plate = false;  // black ground behind it, where lines would cross
};

class DrawList {
 public:
  void clear();
  void draw_on(Layer layer) { layer_ = layer; }  // what follows; a cleared list draws on symbols

  // A line to a place that is no number is left out: an antenna that tells nothing has no caret.
  void line(Point from, Point to, Ink ink = Ink::bright);
  // From a symbol to its label: thin and dim, for the symbols to stand out, parted from the video all the same.
  void leader(Point from, Point to);
  void polyline(std::span<const Point> points, Ink ink = Ink::bright);
  void circle(Point center, float radius, bool dashed = false);
  // Dashed outlines go round the closed polygon.
  void polygon(std::span<const Point> corners, bool dashed);
  void thin_arc(Point center, float radius, float from_deg, float to_deg);  // degrees clockwise from up, dim
  void video_step(const Rect& rect, std::uint8_t video);
  void plate(const Rect& rect);

  // Draws text with its middle height at `at.y`; returns the box taken up, frame included, and records it.
  Rect text(std::string_view words, Point at, const TextStyle& style = {}, BoxKind kind = BoxKind::text);
  void occupy(std::string_view name, const Rect& rect, BoxKind kind);
  // A black ground behind each fixed text that a line or a point of the ground would lie behind.
  void blank_behind_texts();

  const LayerContent& content(Layer layer) const { return layers_[static_cast<std::size_t>(layer)]; }
  const std::vector<VideoStep>& video_steps() const { return video_steps_; }
  const std::vector<OccupiedBox>& occupied() const { return occupied_; }
  friend bool operator==(const DrawList&, const DrawList&) = default;

 private:
  LayerContent& current() { return layers_[static_cast<std::size_t>(layer_)]; }

  Layer layer_ = Layer::symbols;
  std::array<LayerContent, kLayers> layers_;
  std::vector<VideoStep> video_steps_;
  std::vector<OccupiedBox> occupied_;
};

// Where text would go, without drawing it.
Rect text_box(std::string_view words, Point at, const TextStyle& style = {});

// Colors of the glass, each channel 0..1. The default is that of the built-in configuration, a green phosphor.
struct Color {
  float red = 0.0F, green = 0.0F, blue = 0.0F;
};

struct ColorScheme {
  Color ground{0.0F, 0.0F, 0.0F};
  Color video{0.30F, 0.95F, 0.42F};  // full light; grays are fractions of it
  Color bright{0.72F, 1.0F, 0.76F};  // symbols stand out from the brightest video
  Color dim{0.22F, 0.55F, 0.28F};    // arcs and lines below them

  Color of(Ink ink) const { return ink == Ink::dim ? dim : bright; }
};

ColorScheme color_scheme(const radar::ColorConfiguration& colors);

}  // namespace yars::display
