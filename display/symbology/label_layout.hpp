// Finds a place for the labels that move with the ground: the names of points and the heading of the steering line.
// In:  labels, the one that matters most first; a list that holds all that stays where it is: texts, scales, symbols,
//      the cursor's arms, and on Layer::lines the lines.
// Out: the labels as texts of the list, clear of all of that and of each other: in one of eight places around the
//      symbol, else farther out at the end of a line that leads to it. A label that finds no place is left out.
// A label keeps its place from picture to picture while that is clear; it comes nearer only where there is room to
// spare. The same labels, list and memory give the same places; a second time with the memory they left, too.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "display/symbology/draw_list.hpp"
#include "lib/radar/modes.hpp"

namespace yars::display {

enum class LabelRole : std::uint8_t { name, heading };  // a heading stands beneath, and leaves the name between

struct Label {
  LabelRole role = LabelRole::name;
  std::array<char, 16> words{};  // zero terminated
  Point anchor;                  // [units] middle of its symbol
};

Label label_of(LabelRole role, std::string_view words, Point anchor);

inline constexpr std::size_t kMaxLabels = radar::kMaxPointsDrawn + 1;

// The labels of one picture in order of their rank.
class LabelQueue {
 public:
  void add(const Label& label);
  std::span<const Label> labels() const { return {labels_.data(), count_}; }

 private:
  std::array<Label, kMaxLabels> labels_{};
  std::size_t count_ = 0;
};

// Where the labels of the last picture stood.
class LabelMemory {
 public:
  struct Kept {
    LabelRole role = LabelRole::name;
    std::array<char, 16> words{};  // of a name; there is one heading, whatever it reads
    std::size_t place = 0;
  };
  bool names(std::string_view words) const;  // a point of this name had its label
  std::span<const Kept> kept() const { return {kept_.data(), count_}; }
  void clear() { count_ = 0; }
  void keep(const Kept& kept);

 private:
  std::array<Kept, kMaxLabels> kept_{};
  std::size_t count_ = 0;
};

void place_labels(std::span<const Label> labels, LabelMemory& memory, DrawList& list);

}  // namespace yars::display
