#include "display/symbology/text_lines.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
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

}  // namespace yars::display
