#include "display/stroke_font.hpp"

#include <array>
#include <cstddef>

namespace yars::display {

namespace {

// Glyphs are drawn on a grid 8 wide and 12 high: a point is a digit 0-8 for x and a letter a-m for y, upwards from
// the base line; a blank lifts the pen.
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
constexpr float kColumn = 0.58F / 8.0F;  // cap heights a grid column: capitals are 0.58 as wide as high
constexpr float kRow = 1.0F / 12.0F;     // cap heights a grid row
constexpr std::size_t kMostPoints = 24;  // of one polyline; the longest above has 16

const Glyph& glyph_of(char32_t code) {
  if (code >= U'a' && code <= U'z' && code != U'v') code -= U'a' - U'A';
  for (const Glyph& glyph : kGlyphs) {
    if (glyph.code == code) return glyph;
  }
  return kUnknown;
}

// Takes one character off the front. Only two-byte UTF-8 is decoded; other high bytes read as unknown.
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
  std::array<Point, kMostPoints> points;
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
    const float row = static_cast<float>(glyph.strokes[i + 1] - 'a');
    if (count < kMostPoints) points[count++] = {left + column * kColumn, -row * kRow};
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

float text_width(std::string_view text) {
  int columns = 0;
  while (!text.empty()) columns += glyph_of(take(text)).width + kGap;
  return static_cast<float>(columns > 0 ? columns - kGap : 0) * kColumn;
}

}  // namespace yars::display
