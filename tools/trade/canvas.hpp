// Lines, discs and text with soft edges on an RGB image; x right, y down, in pixels.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "display/point.hpp"
#include "lib/imageio/png.hpp"

namespace yars::tools::trade {

using Color = std::array<std::uint8_t, 3>;

// Where a text has its given point.
enum class Anchor : std::uint8_t { left, middle, right };

class Canvas {
 public:
  Canvas(int width, int height, Color background);

  void line(display::Point from, display::Point to, float width, Color color);
  void disc(display::Point centre, float radius, Color color);
  // Base line at the point's height; capitals this high.
  void text(std::string_view text, display::Point at, float height, Anchor anchor, Color color);

  const imageio::Image& image() const { return image_; }

 private:
  imageio::Image image_;
};

float text_width(std::string_view text, float height);

}  // namespace yars::tools::trade
