#include "display/symbology/caption.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <string>
#include <string_view>

#include "lib/text/plain_text.hpp"

namespace yars::display {

namespace {

// All in display units. The widest line, kCaptionLength characters, fits between the legends of both sides.
constexpr float kPlateLeft = 66.0F, kPlateRight = 414.0F;
constexpr float kLowerEnd = 404.0F;   // the message's line is below
constexpr float kUpperBegin = 66.0F;  // FREEZE and the name of A/A are above
constexpr float kPadding = 6.0F;
constexpr float kLineHeight = 8.5F, kLinePitch = 14.0F;
constexpr float kHeadHeight = 6.0F, kHeadPitch = 11.0F;  // row with the title and the number of the step

constexpr const char* kYourTurn = "YOUR TURN.  N: DO IT FOR ME";  // in place of the title while the tour waits

// The font has an arrow for the letter v, so texts are drawn in upper case.
std::string upper_case(std::string_view words) {
  std::string upper(words);
  std::ranges::transform(upper, upper.begin(),
                         [](unsigned char letter) { return static_cast<char>(std::toupper(letter)); });
  return upper;
}

std::size_t lines_of(const databuffer::Caption& caption) {
  std::size_t count = databuffer::kCaptionLines;
  while (count > 0 && caption.lines[count - 1].text[0] == '\0') --count;
  return count;
}

// True if the plate is below the middle of the cursor. The arms of the cursor may reach over the plate's edge, because
// the cursor is drawn above it.
bool is_below_cursor(const Rect& plate, const DrawList& list) {
  return std::ranges::any_of(list.occupied(), [&](const OccupiedBox& box) {
    const float x = (box.rect.left + box.rect.right) / 2.0F, y = (box.rect.top + box.rect.bottom) / 2.0F;
    return box.kind == BoxKind::cursor && intersect(plate, {x, y, x, y});
  });
}

}  // namespace

void draw_caption(const databuffer::Caption& caption, DrawList& list) {
  if (caption.step == 0) return;
  const std::size_t lines = lines_of(caption);
  const float height = 2.0F * kPadding + kHeadPitch + kLinePitch * static_cast<float>(lines);
  Rect plate{kPlateLeft, kLowerEnd - height, kPlateRight, kLowerEnd};
  if (is_below_cursor(plate, list)) plate = {kPlateLeft, kUpperBegin, kPlateRight, kUpperBegin + height};
  list.draw_on(Layer::notices);
  list.plate(plate);
  float y = plate.top + kPadding + kHeadHeight / 2.0F;
  const std::string number = std::to_string(caption.step) + "/" + std::to_string(caption.steps);
  const std::string title = caption.waiting != 0 ? kYourTurn : upper_case(text::text_of(caption.title));
  list.text(title, {plate.left + kPadding, y}, {kHeadHeight, Align::left});
  list.text(number, {plate.right - kPadding, y}, {kHeadHeight, Align::right});
  y += kHeadPitch + (kLineHeight - kHeadHeight) / 2.0F;
  for (std::size_t i = 0; i < lines; ++i, y += kLinePitch)
    list.text(upper_case(text::text_of(caption.lines[i].text)), {plate.left + kPadding, y}, {kLineHeight, Align::left});
  list.draw_on(Layer::symbols);
}

}  // namespace yars::display
