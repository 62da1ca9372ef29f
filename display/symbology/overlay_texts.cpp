#include "display/symbology/overlay_texts.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include "databuffer/messages/key_map.hpp"
#include "display/symbology/text_layout.hpp"
#include "lib/radar/modes.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::display {

namespace {

using text::text_of;

constexpr Rect kPlate{58.0F, 24.0F, 422.0F, 456.0F};  // [units] between the legends of the four sides
constexpr float kHeight = 7.5F;                       // [units] cap height
constexpr float kPitch = 11.5F;                       // [units] distance of rows
constexpr float kTitleRow = 34.0F, kFirstRow = 50.0F;
// Columns [units]: number (right end), key, legend, words (left end and right end).
constexpr float kNumber = 80.0F, kKey = 86.0F, kLegend = 98.0F, kWords = 148.0F, kRightEnd = 416.0F;
constexpr float kWordsWidth = (kRightEnd - kWords) / kHeight;  // [cap heights]

// Keys of the window, which have no event.
constexpr std::array kWindowHelp{
    databuffer::KeyHelp{"mouse", "click: TDC switch there; right: cursor"},
    databuffer::KeyHelp{"F8 F11", "bezel; full screen"},
};

bool is_live(const DisplayInput& input, int button) {
  return (input.advice.live >> static_cast<unsigned>(button) & 1U) != 0;
}

// The part before the remedy, which the help has no room for.
std::string_view without_remedy(std::string_view words) {
  return words.substr(0, words.find(';'));
}

class Rows {
 public:
  explicit Rows(DrawList& list) : list_(list) {}
  void put(std::string_view words, float x, Ink ink, Align align = Align::left) {
    list_.text(words, {x, y_}, {kHeight, align, false, false, ink});
  }
  void next(float rows = 1.0F) { y_ += rows * kPitch; }

 private:
  DrawList& list_;
  float y_ = kFirstRow;
};

void put_button(const DisplayInput& input, int button, Rows& rows) {
  const Ink ink = is_live(input, button) ? Ink::bright : Ink::dim;
  rows.put(std::to_string(button), kNumber, ink, Align::right);
  rows.put(databuffer::key_of_button(button), kKey, ink);
  rows.put(text_of(input.state.legends[button]), kLegend, ink);
  rows.put(first_words(in_capitals(without_remedy(words_of_button(input, button))), kWordsWidth), kWords, ink);
  rows.next();
}

// The TDC's switch, with its remedy, on two lines.
void put_switch(const DisplayInput& input, Rows& rows) {
  const Ink ink = is_live(input, 0) ? Ink::bright : Ink::dim;
  rows.put("TDC SWITCH", 64.0F, ink);
  auto lines = wrapped(in_capitals(text_of(input.advice.buttons[0])), kWordsWidth);
  lines.resize(2);
  for (const std::string& line : lines) {
    rows.put(line, kWords, ink);
    rows.next();
  }
}

}  // namespace

std::string words_of_button(const DisplayInput& input, int button) {
  const std::string_view words = text_of(input.advice.buttons[button]);
  return words.empty() || !input.state_machine_alive ? "not known: state-machine is silent; start state-machine"
                                                     : std::string(words);
}

std::string words_of_window(const DisplayInput& input) {
  if (!(input.state.window_nm > 0.0))
    return "window blank: the cursor's range selects it; back to the smallest: acq fwd (PgUp)";
  std::array<char, 80> buffer;
  std::snprintf(buffer.data(), buffer.size(), "window %.4g NM: larger acq fwd (PgUp), smaller acq aft (PgDn)",
                input.state.window_nm);
  return buffer.data();
}

std::string name_of_button(int button) {
  const std::string_view key = databuffer::key_of_button(button);
  return "PB " + std::to_string(button) + (key.empty() ? "" : ", KEY " + std::string(key));
}

void draw_help(const DisplayInput& input, DrawList& list) {
  list.draw_on(Layer::cover);
  list.plate(kPlate);
  list.frame(kPlate, Ink::dim);
  list.text("HELP", {64.0F, kTitleRow}, {9.0F, Align::left});
  list.text("BACK: ? OR ESC", {kRightEnd, kTitleRow}, {kHeight, Align::right});
  Rows rows(list);
  rows.put("PB", kNumber, Ink::dim, Align::right);
  rows.put("KEY", kKey, Ink::dim);
  rows.put("DOES NOW", kWords, Ink::dim);
  rows.next();
  for (int button = 1; button <= radar::kBezelButtons; ++button) put_button(input, button, rows);
  rows.next(0.4F);
  put_switch(input, rows);
  rows.next(0.2F);
  const auto put_key = [&rows](const databuffer::KeyHelp& one) {
    rows.put(in_capitals(one.keys), 64.0F, Ink::bright);
    rows.put(in_capitals(one.does), kWords, Ink::bright);
    rows.next();
  };
  for (const databuffer::KeyHelp& one : databuffer::key_help()) put_key(one);
  for (const databuffer::KeyHelp& one : kWindowHelp) put_key(one);
  list.draw_on(Layer::symbols);
}

namespace {

// All in display units. The widest line, kCaptionLength characters, fits between the legends of both sides.
constexpr float kPlateLeft = 66.0F, kPlateRight = 414.0F;
constexpr float kPictureLeft = 106.0F;  // right of the elevation scale; a plate begins there if it is narrow enough
constexpr float kLowerEnd = 404.0F;     // the message's line is below
constexpr float kUpperBegin = 66.0F;    // FREEZE and the name of A/A are above
constexpr float kPlateStep = 8.0F;      // between two positions that are tried
constexpr float kPadding = 6.0F;
constexpr float kLineHeight = 8.5F, kLinePitch = 14.0F;
constexpr float kHeadHeight = 6.0F, kHeadPitch = 11.0F;  // row with the title and the number of the step
constexpr float kAroundPlate = 4.0F;                     // around the plate

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

// The texts of a caption as they are drawn.
struct CaptionText {
  std::string title, number;
  std::vector<std::string> lines;
};

CaptionText text_of_caption(const databuffer::Caption& caption) {
  CaptionText text{caption.waiting != 0 ? kYourTurn : upper_case(text::text_of(caption.title)),
                   std::to_string(caption.step) + "/" + std::to_string(caption.steps),
                   {}};
  for (std::size_t i = 0; i < lines_of(caption); ++i)
    text.lines.push_back(upper_case(text::text_of(caption.lines[i].text)));
  return text;
}

// A plate as wide as its texts, at the height of the lowest position. It keeps clear of the elevation scale if it can.
Rect lowest_plate(const CaptionText& text) {
  constexpr float kGap = 20.0F;  // between title and number
  float width = (text_width(text.title) + text_width(text.number)) * kHeadHeight + kGap;
  for (const std::string& line : text.lines) width = std::max(width, text_width(line) * kLineHeight);
  width += 2.0F * kPadding;
  const float left = std::max(kPlateLeft, std::min(kPictureLeft, kPlateRight - width));
  const float height = 2.0F * kPadding + kHeadPitch + kLinePitch * static_cast<float>(text.lines.size());
  return {left, kLowerEnd - height, std::min(left + width, kPlateRight), kLowerEnd};
}

// Number of texts, labels, symbols and lines on the ground that a plate would cover.
std::size_t covered(const Rect& plate, const DrawList& list) {
  const Rect area = grown(plate, kAroundPlate);
  const auto& boxes = list.occupied();
  const auto& lines = list.content(Layer::lines).strokes;
  const auto hidden = [&](const OccupiedBox& box) { return box.kind != BoxKind::scale && intersect(area, box.rect); };
  const auto crossed = [&](const Segment& line) { return crosses(area, line.from, line.to); };
  return static_cast<std::size_t>(std::ranges::count_if(boxes, hidden) + std::ranges::count_if(lines, crossed));
}

// The lowest position if the plate covers nothing there, else the highest, else the lowest of all others at which it
// covers least.
Rect place_plate(const CaptionText& text, const DrawList& list) {
  const Rect lowest = lowest_plate(text);
  const float height = lowest.bottom - lowest.top;
  const auto at = [&](float top) { return Rect{lowest.left, top, lowest.right, top + height}; };
  Rect best = lowest;
  std::size_t least = covered(best, list);
  const auto consider = [&](const Rect& plate) {
    const std::size_t count = covered(plate, list);
    if (count >= least) return;
    least = count;
    best = plate;
  };
  consider(at(kUpperBegin));
  for (float top = lowest.top - kPlateStep; least > 0 && top > kUpperBegin; top -= kPlateStep) consider(at(top));
  return best;
}

}  // namespace

void draw_caption(const databuffer::Caption& caption, DrawList& list) {
  if (caption.step == 0) return;
  const CaptionText text = text_of_caption(caption);
  const Rect plate = place_plate(text, list);
  list.draw_on(Layer::notices);
  list.plate(plate);
  float y = plate.top + kPadding + kHeadHeight / 2.0F;
  list.text(text.title, {plate.left + kPadding, y}, {kHeadHeight, Align::left});
  list.text(text.number, {plate.right - kPadding, y}, {kHeadHeight, Align::right});
  y += kHeadPitch + (kLineHeight - kHeadHeight) / 2.0F;
  for (const std::string& line : text.lines) {
    list.text(line, {plate.left + kPadding, y}, {kLineHeight, Align::left});
    y += kLinePitch;
  }
  list.draw_on(Layer::symbols);
}

}  // namespace yars::display
