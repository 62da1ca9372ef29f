#include "tools/trade/pareto_front.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <string_view>

#include "display/symbology/draw_list.hpp"
#include "lib/imageio/png.hpp"

namespace yars::tools::trade {

// Lines, discs and text with soft edges on an RGB image; x right, y down, in pixels.

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

namespace {

using display::Point;
using display::Rect;

constexpr int kWidth = 1560, kHeight = 780;
constexpr float kTitle = 15.0F, kTick = 11.0F, kLabel = 10.0F;  // [pixels] heights of capitals
constexpr float kRadius = 5.0F;
constexpr float kZeroRow = 40.0F;  // [pixels] below the least decade
constexpr Color kPaper{255, 255, 255}, kInk{30, 30, 30}, kGrid{222, 222, 222}, kFront{255, 190, 90};
constexpr Color kPresetColor{200, 30, 30};
constexpr std::array<Color, 6> kFamilyColors{
    {{30, 90, 190}, {20, 130, 70}, {130, 60, 160}, {0, 130, 140}, {150, 90, 20}, {90, 90, 90}}};

// A logarithmic axis over whole decades, to pixels.
struct Axis {
  int least = 0, most = 1;  // powers of ten
  float from = 0.0F, to = 0.0F;

  float at(double value) const {
    const double share = (std::log10(value) - least) / (most - least);
    return from + static_cast<float>(share) * (to - from);
  }
};

struct Mark {
  std::string name, family;
  double ms = 0.0, error = 0.0, worst = 0.0;
  Color color{};
  Point place;
};

std::string power_text(int exponent) {
  std::string digits(static_cast<std::size_t>(std::abs(exponent)) + 1, '0');
  (exponent >= 0 ? digits.front() : digits.back()) = '1';
  if (exponent < 0) digits.insert(digits.begin() + 1, '.');
  return digits;
}

// Decades that hold all values above zero; at least one.
Axis axis_over(const std::vector<double>& values, float from, float to) {
  double least = std::numeric_limits<double>::infinity(), most = 0.0;
  for (const double value : values) {
    if (!(value > 0.0)) continue;
    least = std::min(least, value);
    most = std::max(most, value);
  }
  if (most <= 0.0) return {0, 1, from, to};
  Axis axis{static_cast<int>(std::floor(std::log10(least))), static_cast<int>(std::ceil(std::log10(most))), from, to};
  axis.most = std::max(axis.most, axis.least + 1);
  return axis;
}

std::vector<Mark> marks_of(const TradeTable& table, std::size_t time_column, std::size_t column) {
  std::map<std::string, Color> colors{{"preset", kPresetColor}};
  std::vector<Mark> marks;
  for (std::size_t i = 0; i < table.contenders.size(); ++i) {
    const Contender& contender = table.contenders[i];
    const Summary time = summary_of(table, i, time_column);
    const Summary error = summary_of(table, i, column);
    if (std::isnan(error.mean) || !(time.mean > 0.0)) continue;
    const Color next = kFamilyColors[(colors.size() - 1) % kFamilyColors.size()];
    const Color color = colors.emplace(contender.family, next).first->second;
    marks.push_back({contender.name, contender.family, time.mean, error.mean, error.worst, color, {}});
  }
  return marks;
}

class Panel {
 public:
  Panel(Canvas& canvas, Rect frame, std::string_view time_title, std::string_view title, std::vector<Mark> marks)
      : canvas_(canvas), frame_(frame), time_title_(time_title), title_(title), marks_(std::move(marks)) {
    std::vector<double> times, errors;
    for (const Mark& mark : marks_) {
      times.push_back(mark.ms);
      errors.insert(errors.end(), {mark.error, mark.worst});
    }
    time_ = axis_over(times, frame_.left, frame_.right);
    error_ = axis_over(errors, frame_.bottom - kZeroRow, frame_.top);
    for (Mark& mark : marks_) mark.place = {time_.at(mark.ms), height_of(mark.error)};
  }

  void draw() {
    draw_axes();
    draw_front();
    for (std::size_t i = 0; i < marks_.size(); ++i) draw_mark(i);
    for (const Mark& mark : marks_) taken_.push_back(about(mark.place));
    for (const Mark& mark : marks_) draw_label(mark);
  }

 private:
  static Rect about(Point place) { return display::grown({place.x, place.y, place.x, place.y}, kRadius + 1.0F); }
  float height_of(double error) const { return error > 0.0 ? error_.at(error) : frame_.bottom - 0.5F * kZeroRow; }

  void draw_axes() {
    for (int power = time_.least; power < time_.most; ++power)
      for (int digit = 1; digit < 10; ++digit) time_tick(digit * std::pow(10.0, power), digit == 1 ? power : kNoText);
    time_tick(std::pow(10.0, time_.most), time_.most);
    for (int power = error_.least; power < error_.most; ++power)
      for (int digit = 1; digit < 10; ++digit) error_tick(digit * std::pow(10.0, power), digit == 1 ? power : kNoText);
    error_tick(std::pow(10.0, error_.most), error_.most);
    canvas_.text("0", {frame_.left - 10.0F, height_of(0.0) + 0.5F * kTick}, kTick, Anchor::right, kInk);
    canvas_.line({frame_.left, frame_.bottom}, {frame_.right, frame_.bottom}, 1.5F, kInk);
    canvas_.line({frame_.left, frame_.bottom}, {frame_.left, frame_.top}, 1.5F, kInk);
    const float middle = 0.5F * (frame_.left + frame_.right);
    canvas_.text(time_title_, {middle, frame_.bottom + 52.0F}, kTick, Anchor::middle, kInk);
    canvas_.text(title_, {frame_.left, frame_.top - 22.0F}, kTitle, Anchor::left, kInk);
  }

  void time_tick(double value, int power) {
    const float x = time_.at(value);
    canvas_.line({x, frame_.top}, {x, frame_.bottom}, power == kNoText ? 0.6F : 1.4F, kGrid);
    if (power != kNoText) canvas_.text(power_text(power), {x, frame_.bottom + 24.0F}, kTick, Anchor::middle, kInk);
  }

  void error_tick(double value, int power) {
    const float y = error_.at(value);
    canvas_.line({frame_.left, y}, {frame_.right, y}, power == kNoText ? 0.6F : 1.4F, kGrid);
    if (power == kNoText) return;
    canvas_.text(power_text(power), {frame_.left - 10.0F, y + 0.5F * kTick}, kTick, Anchor::right, kInk);
  }

  // What no other one beats in both, from fast to slow.
  void draw_front() {
    std::vector<Mark> sorted = marks_;
    std::sort(sorted.begin(), sorted.end(),
              [](const Mark& a, const Mark& b) { return a.ms != b.ms ? a.ms < b.ms : a.error < b.error; });
    const Mark* last = nullptr;
    for (const Mark& mark : sorted) {
      if (last != nullptr && mark.error >= last->error) continue;
      if (last != nullptr) canvas_.line(last->place, mark.place, 5.0F, kFront);
      last = &mark;
    }
  }

  void draw_mark(std::size_t index) {
    const Mark& mark = marks_[index];
    const bool swept = mark.family != "preset" && index > 0 && marks_[index - 1].family == mark.family;
    if (swept) canvas_.line(marks_[index - 1].place, mark.place, 1.2F, mark.color);
    if (mark.worst > mark.error) canvas_.line(mark.place, {mark.place.x, height_of(mark.worst)}, 1.2F, mark.color);
    canvas_.disc(mark.place, kRadius, mark.color);
  }

  // The first free place about the mark, nearest first; where all is taken, the label is left out.
  void draw_label(const Mark& mark) {
    const float width = text_width(mark.name, kLabel);
    for (float away = kRadius + 5.0F; away < 130.0F; away += 6.0F) {
      for (const Point side : {Point{1.0F, 0.0F},
                               {1.0F, 0.8F},
                               {-1.0F, 0.8F},
                               {-1.0F, 0.0F},
                               {1.0F, -0.8F},
                               {-1.0F, -0.8F},
                               {0.2F, 1.0F},
                               {0.2F, -1.0F}}) {
        const float left = mark.place.x + side.x * away - (side.x < 0.0F ? width : 0.0F);
        const float base = mark.place.y + side.y * away + 0.5F * kLabel;
        const Rect box = display::grown({left, base - kLabel, left + width, base}, 3.0F);
        const bool inside = box.left > frame_.left && box.right < frame_.right + 60.0F && box.top > frame_.top - 8.0F &&
                            box.bottom < frame_.bottom;
        const auto in_the_way = [&](const Rect& other) { return display::intersect(box, other); };
        if (!inside || std::any_of(taken_.begin(), taken_.end(), in_the_way)) continue;
        taken_.push_back(box);
        const Point end{std::clamp(mark.place.x, left, left + width), std::clamp(mark.place.y, box.top, box.bottom)};
        if (away > 20.0F) canvas_.line(mark.place, end, 0.6F, mark.color);
        canvas_.text(mark.name, {left, base}, kLabel, Anchor::left, mark.color);
        return;
      }
    }
  }

  static constexpr int kNoText = std::numeric_limits<int>::min();
  Canvas& canvas_;
  Rect frame_;
  std::string_view time_title_, title_;
  std::vector<Mark> marks_;
  std::vector<Rect> taken_;  // where no label fits any more
  Axis time_, error_;
};

}  // namespace

imageio::Image front_picture(const TradeTable& table, const Front& front) {
  Canvas canvas(kWidth, kHeight, kPaper);
  canvas.text("speed against accuracy: mean (disc) and worst (hair) of " + std::to_string(table.scenes.size()) +
                  (table.scenes.size() == 1 ? " scene" : " scenes"),
              {80.0F, 36.0F}, kTitle, Anchor::left, kInk);
  constexpr float kTop = 100.0F, kBottom = 690.0F;
  constexpr std::array<Rect, 2> kFrames{{{80.0F, kTop, 720.0F, kBottom}, {860.0F, kTop, 1500.0F, kBottom}}};
  for (std::size_t i = 0; i < kFrames.size(); ++i)
    Panel(canvas, kFrames[i], front.time_title, front.errors[i].title,
          marks_of(table, front.time_column, front.errors[i].column))
        .draw();
  return canvas.image();
}

}  // namespace yars::tools::trade
