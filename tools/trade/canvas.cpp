#include "tools/trade/canvas.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "display/stroke_font.hpp"

namespace yars::tools::trade {

namespace {

using display::Point;

constexpr float kStrokeShare = 0.14F;  // width of a stroke, of the capitals' height

// The font reads a small v as an arrow.
std::string capitals(std::string_view text) {
  std::string big(text);
  std::transform(big.begin(), big.end(), big.begin(),
                 [](char letter) { return letter >= 'a' && letter <= 'z' ? static_cast<char>(letter - 32) : letter; });
  return big;
}

float distance_to(Point from, Point to, float x, float y) {
  const float along_x = to.x - from.x;
  const float along_y = to.y - from.y;
  const float length2 = along_x * along_x + along_y * along_y;
  const float way = length2 > 0.0F ? ((x - from.x) * along_x + (y - from.y) * along_y) / length2 : 0.0F;
  const float share = std::clamp(way, 0.0F, 1.0F);
  return std::hypot(x - from.x - share * along_x, y - from.y - share * along_y);
}

class TextStrokes final : public display::StrokeSink {
 public:
  TextStrokes(Canvas& canvas, Point origin, float height, Color color)
      : canvas_(canvas), origin_(origin), height_(height), color_(color) {}
  void polyline(std::span<const Point> points) override {
    for (std::size_t i = 0; i + 1 < points.size(); ++i)
      canvas_.line(placed(points[i]), placed(points[i + 1]), kStrokeShare * height_, color_);
  }

 private:
  Point placed(Point point) const { return {origin_.x + height_ * point.x, origin_.y + height_ * point.y}; }

  Canvas& canvas_;
  Point origin_;
  float height_;
  Color color_;
};

}  // namespace

Canvas::Canvas(int width, int height, Color background)
    : image_{width, height, 3, std::vector<std::uint8_t>(static_cast<std::size_t>(width) * height * 3)} {
  for (std::size_t i = 0; i < image_.pixels.size(); ++i) image_.pixels[i] = background[i % 3];
}

void Canvas::line(Point from, Point to, float width, Color color) {
  const float reach = 0.5F * width + 1.0F;
  const auto inside = [](float value, int size) { return std::clamp(static_cast<int>(value), 0, size); };
  const int left = inside(std::min(from.x, to.x) - reach, image_.width);
  const int right = inside(std::max(from.x, to.x) + reach + 1.0F, image_.width);
  const int top = inside(std::min(from.y, to.y) - reach, image_.height);
  const int bottom = inside(std::max(from.y, to.y) + reach + 1.0F, image_.height);
  for (int y = top; y < bottom; ++y) {
    for (int x = left; x < right; ++x) {
      const float away = distance_to(from, to, static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
      const float cover = std::clamp(0.5F * width + 0.5F - away, 0.0F, 1.0F);
      if (cover <= 0.0F) continue;
      std::uint8_t* pixel = &image_.pixels[(static_cast<std::size_t>(y) * image_.width + x) * 3];
      for (std::size_t channel = 0; channel < 3; ++channel) {
        const float mixed =
            static_cast<float>(pixel[channel]) * (1.0F - cover) + static_cast<float>(color[channel]) * cover;
        pixel[channel] = static_cast<std::uint8_t>(std::lround(mixed));
      }
    }
  }
}

void Canvas::disc(Point centre, float radius, Color color) {
  line(centre, centre, 2.0F * radius, color);
}

void Canvas::text(std::string_view text, Point at, float height, Anchor anchor, Color color) {
  const float width = text_width(text, height);
  if (anchor == Anchor::middle) at.x -= 0.5F * width;
  if (anchor == Anchor::right) at.x -= width;
  TextStrokes strokes(*this, at, height, color);
  display::stroke_text(capitals(text), strokes);
}

float text_width(std::string_view text, float height) {
  return height * display::text_width(capitals(text));
}

}  // namespace yars::tools::trade
