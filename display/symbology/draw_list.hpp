// Draw list of the display: line segments, filled rectangles and video steps, in layers, without OpenGL.
// Inputs: drawing calls in display units.
// Outputs: plain data by layer; boxes occupied by texts, scales and symbols, which text_layout.hpp reads.
// Units: display units. The display is a square with an edge of 480 units. Origin upper left, x right, y down.
// Accuracy: coordinates of strokes and occupied boxes are rounded to 1/8 unit, so that the list usually stays equal
//   during a motion that is too small to see.
// Threads: one thread at a time.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace yars::radar {
struct ColorConfiguration;
}  // namespace yars::radar

namespace yars::display {

// Edge of the square display [units]. The fixed positions of legends and scales assume this value.
inline constexpr float kDisplayUnits = 480.0F;

struct Point {
  float x = 0.0F;
  float y = 0.0F;
  friend bool operator==(const Point&, const Point&) = default;
};

struct Rect {
  float left = 0.0F, top = 0.0F, right = 0.0F, bottom = 0.0F;
  friend bool operator==(const Rect&, const Rect&) = default;
};

// True when the rectangles share area. Touching edges do not count.
inline bool intersect(const Rect& a, const Rect& b) {
  return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
}

// True when a part of the line between the points lies inside the rectangle. Touching an edge does not count.
inline bool crosses(const Rect& rect, Point from, Point to) {
  float begin = 0.0F, end = 1.0F;  // part of the line inside the rectangle, as fractions of the line
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

// The rectangle enlarged by `by` on all four sides.
inline Rect grown(const Rect& rect, float by) {
  return {rect.left - by, rect.top - by, rect.right + by, rect.bottom + by};
}

// One color, each channel 0..1.
struct Color {
  float red = 0.0F, green = 0.0F, blue = 0.0F;
  friend bool operator==(const Color&, const Color&) = default;
};

// Receives the polylines of stroke_text(), one call per polyline. The points are valid during the call only.
class StrokeSink {
 public:
  virtual void polyline(std::span<const Point> points) = 0;

 protected:
  ~StrokeSink() = default;
};

// Vector font of the display: capitals, digits and some signs as polylines, readable at a height of 10 units.
// Input: ASCII, and the degree sign in UTF-8. Lower case is drawn as upper case, except "v", which is a down arrow.
// "^" is an up arrow. A character that the font does not have is drawn as an empty box.
// Output: strokes in cap heights (1 is the height of a capital letter), x right, y down, origin at the left end of the
// base line.
void stroke_text(std::string_view text, StrokeSink& sink);

// The text in capitals, for prose: a lower-case "v" would be drawn as an arrow.
std::string in_capitals(std::string_view text);

// Width from the left edge of the first glyph to the right edge of the last [cap heights].
float text_width(std::string_view text);

// Layers from bottom to top, left column first. Within a layer, plates are drawn first, then halos, then strokes.
//   grid     range arcs, zero azimuth line        symbols  texts, scales
//   lines    lines on the ground                  notices  messages
//   points   points on the ground                 steered  the cursor
//   cover    help and tooltips, over all else
enum class Layer : std::uint8_t { grid, lines, points, symbols, notices, steered, cover };
inline constexpr std::size_t kLayers = 7;

enum class Ink : std::uint8_t { bright, dim };  // bright: symbols, texts; dim: thin lines such as arcs

struct Segment {
  Point from, to;
  float width = 0.0F;  // [units] full width
  float halo = 0.0F;   // [units] width of the black margin on either side, for contrast with the video
  Ink ink = Ink::bright;
  friend bool operator==(const Segment&, const Segment&) = default;
};

// One bar of the gray scale that the display shows, drawn as bright as video of the level `video`.
struct VideoStep {
  Rect rect;
  std::uint8_t video = 0;
  friend bool operator==(const VideoStep&, const VideoStep&) = default;
};

// Filled rectangle of a fixed color, below all layers: a part of the bezel.
struct Panel {
  Rect rect;
  Color color;
  friend bool operator==(const Panel&, const Panel&) = default;
};

struct LayerContent {
  std::vector<Rect> plates;  // filled black
  std::vector<Segment> strokes;
  friend bool operator==(const LayerContent&, const LayerContent&) = default;
};

// Kind of an occupied box. Texts and scales have fixed positions. text_layout.hpp chooses the positions of labels.
// Points and the cursor are drawn at their ground positions. Leader lines of labels may cross a `scale`; they avoid a
// `solid` scale.
enum class BoxKind : std::uint8_t { text, label, scale, solid, point, cursor };

struct OccupiedBox {
  std::string name;  // the text that is drawn, or the kind of scale or symbol
  Rect rect;         // encloses the centre lines of the strokes; boxes of points and the cursor enclose the ink
  BoxKind kind = BoxKind::text;
  friend bool operator==(const OccupiedBox&, const OccupiedBox&) = default;
};

enum class Align : std::uint8_t { left, center, right };

struct TextStyle {
  float height = 10.0F;  // [units] cap height
  Align align = Align::center;
  bool boxed = false;  // framed
  bool plate = false;  // black plate behind the text, which hides lines
  Ink ink = Ink::bright;
};

// Draw list of one picture. clear() keeps the allocated memory for the next picture.
class DrawList {
 public:
  void clear();
  void draw_on(Layer layer) { layer_ = layer; }  // layer of the following calls; clear() selects symbols

  // A line with a NaN or infinite coordinate is omitted, such as the antenna caret while the antenna angle is unknown.
  void line(Point from, Point to, Ink ink = Ink::bright);
  // Leader line from a symbol to its label: thin and dim, with a halo.
  void leader(Point from, Point to);
  void polyline(std::span<const Point> points, Ink ink = Ink::bright);
  void circle(Point center, float radius, bool dashed = false);
  // Outline of the closed polygon. The dash pattern continues around the corners.
  void polygon(std::span<const Point> corners, bool dashed);
  void thin_arc(Point center, float radius, float from_deg, float to_deg);  // [deg] clockwise from up; dim
  void video_step(const Rect& rect, std::uint8_t video);
  void plate(const Rect& rect);
  void panel(const Rect& rect, const Color& color);
  void frame(const Rect& rect, Ink ink = Ink::bright);  // outline of a rectangle

  // Draws text, vertically centred on `at.y`. `style.align`: left end, middle or right end of the text is at `at.x`.
  // Returns the box of the text, or of its frame if boxed, and records that box as occupied.
  Rect text(std::string_view words, Point at, const TextStyle& style = {}, BoxKind kind = BoxKind::text);
  void occupy(std::string_view name, const Rect& rect, BoxKind kind);  // records a box as occupied
  // Adds a black plate behind each text (BoxKind::text) that a stroke of the layers `lines` or `points` crosses or
  // nearly touches.
  void blank_behind_texts();

  const LayerContent& content(Layer layer) const { return layers_[static_cast<std::size_t>(layer)]; }
  const std::vector<VideoStep>& video_steps() const { return video_steps_; }
  const std::vector<Panel>& panels() const { return panels_; }
  const std::vector<OccupiedBox>& occupied() const { return occupied_; }
  friend bool operator==(const DrawList&, const DrawList&) = default;

 private:
  LayerContent& current() { return layers_[static_cast<std::size_t>(layer_)]; }

  Layer layer_ = Layer::symbols;
  std::array<LayerContent, kLayers> layers_;
  std::vector<VideoStep> video_steps_;
  std::vector<Panel> panels_;
  std::vector<OccupiedBox> occupied_;
};

// Calls `box` with a rectangle [units] around the ink of each element that only one of the lists has. Elements after an
// inserted or removed one may be reported, too.
void visit_changes(const DrawList& before, const DrawList& after, const std::function<void(const Rect&)>& box);

// The box that DrawList::text would occupy.
Rect text_box(std::string_view words, Point at, const TextStyle& style = {});

// Colors of the display. The defaults are the green of the built-in configuration.
struct ColorScheme {
  Color ground{0.0F, 0.0F, 0.0F};    // background
  Color video{0.30F, 0.95F, 0.42F};  // color of light 1 (radar_video.hpp); the light scales this color
  Color bright{0.72F, 1.0F, 0.76F};  // symbols; brighter than the brightest video
  Color dim{0.22F, 0.55F, 0.28F};    // arcs, lines

  Color of(Ink ink) const { return ink == Ink::dim ? dim : bright; }
};

// The configured colors on a black background.
ColorScheme color_scheme(const radar::ColorConfiguration& colors);

}  // namespace yars::display
