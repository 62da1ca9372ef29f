#include "display/symbology/text_layout.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <span>
#include <utility>

#include "display/symbology/draw_list.hpp"

namespace yars::display {

namespace {

std::vector<std::string> words_in(std::string_view text) {
  std::vector<std::string> words;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    if (end > 0) words.emplace_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return words;
}

bool is_clause_mark(char character) {
  return character == ',' || character == ';' || character == ':';
}

bool is_one_of(std::string_view word, std::span<const std::string_view> list) {
  return std::ranges::find(list, word) != list.end();
}

// True if no line may end between the two words.
bool belong_together(const std::string& word, const std::string& next) {
  constexpr std::array<std::string_view, 7> kUnits{"DEG", "NM", "FT", "S", "SEC", "KT", "TIMES"};
  constexpr std::array<std::string_view, 8> kBefore{"PB", "SP", "ACQ", "TDC", "POWER", "MODE", "WINDOW", "YARS"};
  const bool number = std::ranges::all_of(word, [](char c) { return (c >= '0' && c <= '9') || c == '.'; });
  std::string unit = in_capitals(next);
  while (!unit.empty() && is_clause_mark(unit.back())) unit.pop_back();
  return next.front() == '(' || (number && is_one_of(unit, kUnits)) || is_one_of(in_capitals(word), kBefore);
}

// Words that stand in one line, joined: "10.0 NM".
std::vector<std::string> groups_of(std::string_view text) {
  std::vector<std::string> groups;
  std::string before;
  for (const std::string& word : words_in(text)) {
    if (!groups.empty() && belong_together(before, word)) {
      groups.back() += ' ' + word;
    } else {
      groups.push_back(word);
    }
    before = word;
  }
  return groups;
}

// A way to divide the groups from one of them to the last into lines.
struct Division {
  std::size_t lines = 0;
  float cost = 0.0F;
  std::size_t end = 0;  // index of the group that begins the second line
  bool operator<(const Division& other) const { return lines != other.lines ? lines < other.lines : cost < other.cost; }
};

// Cost of a line among divisions into as many lines: the square of the part of the line that stays empty; much more
// for a single short word; a little if the line ends within a clause.
float cost_of_line(const std::string& line, float max_width) {
  constexpr std::size_t kShortWord = 7;  // characters
  constexpr float kSingleWord = 4.0F, kWithinClause = 0.1F;
  const float empty = std::max(0.0F, 1.0F - text_width(line) / max_width);
  const bool single = line.size() <= kShortWord && line.find(' ') == std::string::npos;
  const bool clause = is_clause_mark(line.back());
  return empty * empty + (single ? kSingleWord : 0.0F) + (clause ? 0.0F : kWithinClause);
}

}  // namespace

std::vector<std::string> wrapped(std::string_view text, float max_width) {
  const std::vector<std::string> groups = groups_of(text);
  std::vector<Division> best(groups.size() + 1);  // [i]: of the groups from i on
  for (std::size_t begin = groups.size(); begin-- > 0;) {
    std::string line;
    for (std::size_t end = begin + 1; end <= groups.size(); ++end) {
      line += (line.empty() ? "" : " ") + groups[end - 1];
      if (end > begin + 1 && text_width(line) > max_width) break;
      const Division one{best[end].lines + 1, best[end].cost + cost_of_line(line, max_width), end};
      if (end == begin + 1 || one < best[begin]) best[begin] = one;
    }
  }
  std::vector<std::string> lines;
  for (std::size_t begin = 0; begin < groups.size(); begin = best[begin].end) {
    std::string& line = lines.emplace_back(groups[begin]);
    for (std::size_t i = begin + 1; i < best[begin].end; ++i) line += ' ' + groups[i];
  }
  return lines;
}

std::string first_words(std::string_view text, float max_width) {
  std::string line;
  for (const std::string& word : words_in(text)) {
    std::string longer = line;
    if (!line.empty()) longer += ' ';
    longer += word;
    if (!line.empty() && text_width(longer) > max_width) break;
    line = std::move(longer);
  }
  return line;
}

namespace {

constexpr float kLabelHeight = 9.0F;  // [units] cap height
constexpr float kLeaderStart = 8.0F;  // [units] distance from a symbol's centre to the start of a leader line
constexpr float kLineGap = 2.5F;      // [units] distance from the end of the leader line to the text

// Clearance that a position must have [units]. The ink of a text reaches 0.7 units and half a pixel beyond its box.
struct Clearance {
  float around;                // free space on all sides of the text
  float beside_line;           // free space on either side of the leader line
  float beyond_line;           // length added to the ends of all lines in the test for crossing lines
  bool crosses_symbols;        // the leader line may cross points, solid scales, window outline and steering line
  bool among_legends = false;  // the text may stand in the rows of the legends, and nearer beside a legend
  bool behind_texts = false;  // the leader line may run behind the cursor and behind fixed texts, whose plates cover it
};
constexpr Clearance kKeepPosition{2.5F, 1.0F, 0.0F, true};
// A new position needs more clearance than a kept position. Otherwise the label would move again in the next picture.
// kLastResort applies if no position satisfies kNewPosition. kMoveNearer applies to a move nearer the symbol.
constexpr Clearance kNewPosition{3.5F, 2.0F, 2.0F, false}, kLastResort{3.5F, 2.0F, 2.0F, true};
// For a name that has no other position.
constexpr Clearance kAmongLegends{3.5F, 2.0F, 2.0F, true, true}, kBehindTexts{3.5F, 2.0F, 2.0F, true, false, true};
constexpr Clearance kMoveNearer{7.0F, 3.0F, 3.0F, false};
constexpr float kEdgeAllowance = 1.5F;  // [units] reduces the clearance from the edge of the display
constexpr float kBesideText = 3.0F;     // [units] extra clearance beside another label; closer texts read as one word
constexpr float kBesideLegend = 6.0F;   // [units] the same beside a legend or readout
// [units] Rows of the legends and of the window size, at the upper and lower edge. A label there would be read as a
// legend.
constexpr Rect kUpperRow{0.0F, 0.0F, kDisplayUnits, 20.0F}, kLowerRow{0.0F, 446.0F, kDisplayUnits, kDisplayUnits};
constexpr float kAroundSymbol = 2.0F;  // [units] extra clearance from another point; a closer label seems its name

struct Position {
  Point offset;  // [units] vector from the anchor to the reference point of the text
  Align align = Align::left;
  Point line_end;        // [units] vector from the anchor to the end of the leader line; (0, 0): no line
  std::size_t ring = 0;  // number of the ring in kRings, from 1; 0: beside the symbol, without a leader line
};

// The corner positions are first, because the arms of a cursor on the point leave the corners free.
constexpr std::array<Position, 8> kAroundName{{{{10.0F, -11.0F}, Align::left, {}, 0},
                                               {{10.0F, 11.0F}, Align::left, {}, 0},
                                               {{-10.0F, -11.0F}, Align::right, {}, 0},
                                               {{-10.0F, 11.0F}, Align::right, {}, 0},
                                               {{12.0F, 0.0F}, Align::left, {}, 0},
                                               {{-12.0F, 0.0F}, Align::right, {}, 0},
                                               {{0.0F, -15.0F}, Align::center, {}, 0},
                                               {{0.0F, 15.0F}, Align::center, {}, 0}}};
constexpr std::array<Position, 8> kAroundHeading{{{{0.0F, 25.0F}, Align::center, {}, 0},
                                                  {{10.0F, 25.0F}, Align::left, {}, 0},
                                                  {{-10.0F, 25.0F}, Align::right, {}, 0},
                                                  {{0.0F, -25.0F}, Align::center, {}, 0},
                                                  {{10.0F, -25.0F}, Align::left, {}, 0},
                                                  {{-10.0F, -25.0F}, Align::right, {}, 0},
                                                  {{14.0F, 0.0F}, Align::left, {}, 0},
                                                  {{-14.0F, 0.0F}, Align::right, {}, 0}}};
constexpr std::array kRings{26.0F, 38.0F, 52.0F, 68.0F, 86.0F, 106.0F};  // [units] anchor to end of leader line
// Directions of leader lines [deg], clockwise from up, corners first.
constexpr std::array kDirections{45.0F,   135.0F,  315.0F,  225.0F,  90.0F,   270.0F,  0.0F,    180.0F,
                                 22.5F,   67.5F,   112.5F,  157.5F,  202.5F,  247.5F,  292.5F,  337.5F,
                                 11.25F,  33.75F,  56.25F,  78.75F,  101.25F, 123.75F, 146.25F, 168.75F,
                                 191.25F, 213.75F, 236.25F, 258.75F, 281.25F, 303.75F, 326.25F, 348.75F};
constexpr std::size_t kPositions = kAroundName.size() + kRings.size() * kDirections.size();

Position position_on_ring(std::size_t ring, float direction_deg) {
  const float angle = direction_deg * std::numbers::pi_v<float> / 180.0F;
  const Point out{std::sin(angle), -std::cos(angle)};  // unit vector
  const float length = kRings[ring];
  Position position;
  position.ring = ring + 1;
  position.line_end = {out.x * length, out.y * length};
  constexpr float slanted = 0.3F;  // sine of the angle from up or down; steeper lines end above or below the text
  position.align = out.x > slanted ? Align::left : out.x < -slanted ? Align::right : Align::center;
  const float distance = length + kLineGap;
  position.offset = {out.x * distance, out.y * (distance + kLabelHeight / 2.0F)};
  return position;
}

Position position_of(LabelRole role, std::size_t index) {
  if (index < kAroundName.size()) return role == LabelRole::name ? kAroundName[index] : kAroundHeading[index];
  const std::size_t beyond = index - kAroundName.size();
  return position_on_ring(beyond / kDirections.size(), kDirections[beyond % kDirections.size()]);
}

Point moved(Point from, Point by) {
  return {from.x + by.x, from.y + by.y};
}

std::string_view words_of(const std::array<char, 16>& words) {
  const std::string_view all(words.data(), words.size());
  return all.substr(0, all.find('\0'));
}

bool is_label(const LabelMemory::Kept& kept, const Label& label) {
  return kept.role == label.role && (label.role == LabelRole::heading || kept.words == label.words);
}

// Search for a free position of one label in a draw list.
class Search {
 public:
  Search(const Label& label, std::span<const Segment> lines, const DrawList& list)
      : label_(label), lines_(lines), list_(list) {}

  bool is_free(std::size_t index, const Clearance& clearance) const {
    const Position position = position_of(label_.role, index);
    const Rect box =
        text_box(words_of(label_.words), moved(label_.anchor, position.offset), {kLabelHeight, position.align});
    // The clearance from the display's edge, too, is smaller for a kept position. Otherwise a label at the edge could
    // blink.
    return on_display(grown(box, clearance.around - kEdgeAllowance)) &&
           is_clear(grown(box, clearance.around), clearance.among_legends) &&
           (position.ring == 0 || line_is_clear(position, clearance));
  }

  std::optional<std::size_t> first_free(const Clearance& clearance, std::size_t end) const {
    for (std::size_t index = 0; index < end; ++index) {
      if (is_free(index, clearance)) return index;
    }
    return std::nullopt;
  }

  std::optional<std::size_t> choose(std::optional<std::size_t> before) const {
    if (!before || !is_free(*before, kKeepPosition)) {
      auto clear = first_free(kNewPosition, kPositions);
      if (!clear) clear = first_free(kLastResort, kPositions);
      if (clear || label_.role == LabelRole::heading) return clear;
      clear = first_free(kAmongLegends, kPositions);
      return clear ? clear : first_free(kBehindTexts, kPositions);
    }
    const std::size_t ring = position_of(label_.role, *before).ring;
    const std::size_t nearer = ring == 0 ? 0 : kAroundName.size() + (ring - 1) * kDirections.size();
    return first_free(kMoveNearer, nearer).value_or(*before);
  }

  // Leader line of a position, from the edge of the symbol to the label.
  Segment line(const Position& position) const {
    const float fraction = kLeaderStart / std::hypot(position.line_end.x, position.line_end.y);
    return {moved(label_.anchor, {position.line_end.x * fraction, position.line_end.y * fraction}),
            moved(label_.anchor, position.line_end), 0.0F, 0.0F, Ink::bright};
  }

 private:
  static bool on_display(const Rect& box) {
    return box.left >= 0.0F && box.top >= 0.0F && box.right <= kDisplayUnits && box.bottom <= kDisplayUnits;
  }

  bool is_own_symbol(const OccupiedBox& box) const {
    constexpr float rounding = 0.25F;  // [units] coordinates of boxes are rounded to 1/8 unit
    return box.kind == BoxKind::point &&
           std::abs((box.rect.left + box.rect.right) / 2.0F - label_.anchor.x) < rounding &&
           std::abs((box.rect.top + box.rect.bottom) / 2.0F - label_.anchor.y) < rounding;
  }

  Rect required_clear(const Rect& area, const OccupiedBox& box, bool among_legends) const {
    if (box.kind == BoxKind::point) return grown(area, kAroundSymbol);
    if (box.kind != BoxKind::text && box.kind != BoxKind::label) return area;
    const float beside = box.kind == BoxKind::text && !among_legends ? kBesideLegend : kBesideText;
    return {area.left - beside, area.top, area.right + beside, area.bottom};
  }

  bool is_clear(const Rect& area, bool among_legends) const {
    if (!among_legends && (intersect(area, kUpperRow) || intersect(area, kLowerRow))) return false;
    for (const OccupiedBox& box : list_.occupied()) {
      // All positions are clear of the label's own symbol.
      if (!is_own_symbol(box) && intersect(required_clear(area, box, among_legends), box.rect)) return false;
    }
    return std::ranges::none_of(lines_, [&](const Segment& line) { return crosses(area, line.from, line.to); });
  }

  // True when the leader line crosses no text, no label, no cursor arm and no other leader line. It may cross scales
  // with gaps (BoxKind::scale). With `crosses_symbols` it may also cross points, solid scales, the window outline and
  // the steering line, with `behind_texts` fixed texts and the cursor. Points and texts close to the gap between the
  // anchor and the start of the line are ignored. Close means within 1.5 units for a kept position, 1 unit for a new
  // one, and 0.5 units for a move nearer the symbol. A kept position therefore stays free more easily than a new one.
  bool line_is_clear(const Position& position, const Clearance& clearance) const {
    const Segment own = line(position);
    for (const OccupiedBox& box : list_.occupied()) {
      const bool symbol = box.kind == BoxKind::point;
      const bool crossable = symbol || box.kind == BoxKind::solid;
      if (box.kind == BoxKind::scale || (crossable && clearance.crosses_symbols)) continue;
      if ((box.kind == BoxKind::text || box.kind == BoxKind::cursor) && clearance.behind_texts) continue;
      const bool fixed = symbol || box.kind == BoxKind::text;
      const float margin = 2.0F - clearance.beside_line / 2.0F;
      if (fixed && crosses(grown(box.rect, margin), label_.anchor, own.from)) continue;
      if (crosses(grown(box.rect, clearance.beside_line), own.from, own.to)) return false;
    }
    const Segment wide = lengthened(own, clearance.beyond_line);
    return std::ranges::none_of(lines_, [&](const Segment& other) {
      const bool leads_to_label = other.ink == Ink::dim;
      return (leads_to_label || !clearance.crosses_symbols) && cross(wide, lengthened(other, clearance.beyond_line));
    });
  }

  static Segment lengthened(const Segment& line, float by) {
    const float length = std::hypot(line.to.x - line.from.x, line.to.y - line.from.y);
    if (length <= 0.0F) return line;
    const Point step{(line.to.x - line.from.x) * by / length, (line.to.y - line.from.y) * by / length};
    Segment longer = line;
    longer.from = {line.from.x - step.x, line.from.y - step.y};
    longer.to = moved(line.to, step);
    return longer;
  }

  static bool cross(const Segment& a, const Segment& b) {
    const auto side = [](const Segment& line, Point at) {
      return (line.to.x - line.from.x) * (at.y - line.from.y) - (line.to.y - line.from.y) * (at.x - line.from.x);
    };
    return side(a, b.from) * side(a, b.to) < 0.0F && side(b, a.from) * side(b, a.to) < 0.0F;
  }

  const Label& label_;
  std::span<const Segment> lines_;
  const DrawList& list_;
};

}  // namespace

bool LabelMemory::names(std::string_view words) const {
  return std::ranges::any_of(
      kept(), [words](const Kept& one) { return one.role == LabelRole::name && words_of(one.words) == words; });
}

Label label_of(LabelRole role, std::string_view words, Point anchor) {
  Label label{role, {}, anchor};
  std::ranges::copy(words.substr(0, label.words.size() - 1), label.words.begin());
  return label;
}

void LabelQueue::add(const Label& label) {
  if (count_ < labels_.size()) labels_[count_++] = label;
}

void LabelMemory::keep(const Kept& kept) {
  if (count_ < kept_.size()) kept_[count_++] = kept;
}

void place_labels(std::span<const Label> labels, LabelMemory& memory, DrawList& list) {
  LabelMemory placed;
  for (const Label& label : labels) {
    const auto& lines = list.content(Layer::lines).strokes;
    const auto* const kept =
        std::ranges::find_if(memory.kept(), [&](const LabelMemory::Kept& one) { return is_label(one, label); }).base();
    const bool known = kept != memory.kept().data() + memory.kept().size();
    const Search search(label, lines, list);
    const auto index = search.choose(known ? std::optional(kept->position) : std::nullopt);
    if (!index) continue;
    const Position position = position_of(label.role, *index);
    if (position.ring > 0) {
      const Segment line = search.line(position);
      list.draw_on(Layer::lines);
      list.leader(line.from, line.to);
      list.draw_on(Layer::symbols);
    }
    list.text(words_of(label.words), moved(label.anchor, position.offset), {kLabelHeight, position.align},
              BoxKind::label);
    placed.keep({label.role, label.words, *index});
  }
  memory = placed;
}

}  // namespace yars::display
