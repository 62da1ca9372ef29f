#include "display/symbology/help.hpp"

#include <array>
#include <cstdio>
#include <string_view>

#include "databuffer/messages/key_map.hpp"
#include "display/symbology/text_lines.hpp"
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

}  // namespace yars::display
