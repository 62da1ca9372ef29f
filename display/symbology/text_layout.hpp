// Layout of texts: division of a text into lines of the display's font; placement of the labels of ground symbols,
// which are names of points and the heading of the steering line.
// Inputs: a text in one line, and the width of a line; labels, the most important first, and a draw list that already
//   has all texts, scales, symbols, cursor arms and lines.
// Outputs: lines without blanks at their ends; the labels as texts of the list, clear of each other and of the list's
//   content. Range arcs and the zero azimuth line may run behind the labels.
// A label is put in one of eight positions around its symbol, or farther out at the end of a leader line. A label
// without a free position is omitted. A label in the rows of the legends at the upper and lower edge would be read as a
// legend; only a name without another position is put there. A name without any such position has a leader line that
// runs behind texts and the cursor. A label keeps its position from picture to picture while the position is clear. It
// moves nearer its symbol only to a position with more clearance than a new label needs. The same labels, list and
// memory give the same positions. So do the same labels and list with the memory that the first call has updated.
// Units: display units; widths of lines in cap heights (draw_list.hpp: text_width).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "display/symbology/draw_list.hpp"
#include "lib/radar/modes.hpp"

namespace yars::display {

// Divides a text at its blanks into as few lines as it takes, of about the same width. A number stays with its unit, an
// event with its argument and its key: "10.0 NM", "acq aft (PgDn)". No line is a single short word if another division
// of as many lines avoids that. A longer word has a line of its own.
std::vector<std::string> wrapped(std::string_view text, float max_width);

// The first words of the text, as many as fit a line of `max_width`; at least one if there is one.
std::string first_words(std::string_view text, float max_width);

// Name of a point, or heading of the steering line. A heading is farther from its symbol than a name.
enum class LabelRole : std::uint8_t { name, heading };

struct Label {
  LabelRole role = LabelRole::name;
  std::array<char, 16> words{};  // zero terminated
  Point anchor;                  // [units] centre of the label's symbol
};

// A label with the first 15 bytes of `words`.
Label label_of(LabelRole role, std::string_view words, Point anchor);

inline constexpr std::size_t kMaxLabels = radar::kMaxPointsDrawn + 1;

// The labels of one picture, the most important first. Labels beyond kMaxLabels are dropped.
class LabelQueue {
 public:
  void add(const Label& label);
  std::span<const Label> labels() const { return {labels_.data(), count_}; }

 private:
  std::array<Label, kMaxLabels> labels_{};
  std::size_t count_ = 0;
};

// Positions of the labels in the last picture.
class LabelMemory {
 public:
  struct Kept {
    LabelRole role = LabelRole::name;
    std::array<char, 16> words{};  // identifies a name; ignored for a heading, because a picture has only one
    std::size_t position = 0;      // index of the candidate position (position_of)
  };
  bool names(std::string_view words) const;  // true if the last picture had a label with this name
  std::span<const Kept> kept() const { return {kept_.data(), count_}; }
  void clear() { count_ = 0; }
  void keep(const Kept& kept);

 private:
  std::array<Kept, kMaxLabels> kept_{};
  std::size_t count_ = 0;
};

// Adds all labels that have a free position to `list`, and replaces `memory` by these positions.
void place_labels(std::span<const Label> labels, LabelMemory& memory, DrawList& list);

}  // namespace yars::display
