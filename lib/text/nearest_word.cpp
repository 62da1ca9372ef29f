#include "lib/text/nearest_word.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <vector>

namespace yars::text {

namespace {

// Longer words are not compared: the table of distances has the size of the product of the lengths.
constexpr std::size_t kMaxLength = 64;

std::string lower_case(std::string_view word) {
  std::string lower(word);
  for (char& character : lower) character = static_cast<char>(std::tolower(static_cast<unsigned char>(character)));
  return lower;
}

// Distances between all prefixes of two words. Row and column 0 stand before the empty prefix, for transpositions.
class DistanceTable {
 public:
  DistanceTable(std::size_t rows, std::size_t columns) : columns_(columns + 2), cells_((rows + 2) * columns_) {}
  int& at(std::size_t row, std::size_t column) { return cells_[row * columns_ + column]; }

 private:
  std::size_t columns_;
  std::vector<int> cells_;
};

}  // namespace

// Source: R. Lowrance, R. A. Wagner, "An Extension of the String-to-String Correction Problem", J. ACM 22 (1975).
int edit_distance(std::string_view from, std::string_view to) {
  const int far = static_cast<int>(from.size() + to.size());
  DistanceTable table(from.size(), to.size());
  table.at(0, 0) = far;
  for (std::size_t i = 0; i <= from.size(); ++i) {
    table.at(i + 1, 0) = far;
    table.at(i + 1, 1) = static_cast<int>(i);
  }
  for (std::size_t j = 0; j <= to.size(); ++j) {
    table.at(0, j + 1) = far;
    table.at(1, j + 1) = static_cast<int>(j);
  }
  std::map<char, std::size_t> last_row;  // the last row in which a character of `from` stands
  for (std::size_t i = 1; i <= from.size(); ++i) {
    std::size_t last_match = 0;  // the last column of this row with equal characters
    for (std::size_t j = 1; j <= to.size(); ++j) {
      const std::size_t row = last_row.contains(to[j - 1]) ? last_row[to[j - 1]] : 0;
      const std::size_t column = last_match;
      const bool equal = from[i - 1] == to[j - 1];
      if (equal) last_match = j;
      const int transposed = table.at(row, column) + static_cast<int>((i - row - 1) + 1 + (j - column - 1));
      table.at(i + 1, j + 1) =
          std::min({table.at(i, j) + (equal ? 0 : 1), table.at(i + 1, j) + 1, table.at(i, j + 1) + 1, transposed});
    }
    last_row[from[i - 1]] = i;
  }
  return table.at(from.size() + 1, to.size() + 1);
}

namespace {

constexpr std::size_t kMinBegin = 4;  // shorter words begin too many others

// The shortest valid word that begins with `lower`, of equally short ones the first.
std::optional<std::string> shortest_completion(const std::string& lower, std::span<const std::string> valid) {
  std::optional<std::string> shortest;
  for (const std::string& candidate : valid)
    if (lower.size() >= kMinBegin && candidate.size() <= kMaxLength && lower_case(candidate).starts_with(lower) &&
        (!shortest || candidate.size() < shortest->size()))
      shortest = candidate;
  return shortest;
}

}  // namespace

std::optional<std::string> nearest_word(std::string_view word, std::span<const std::string> valid) {
  const std::string lower = lower_case(word);
  int best = static_cast<int>(word.size() / 3) + 1;  // found: a smaller distance
  std::optional<std::string> nearest;
  for (const std::string& candidate : valid) {
    if (word.size() > kMaxLength || candidate.size() > kMaxLength) continue;
    const int distance = edit_distance(lower, lower_case(candidate));
    if (distance >= best) continue;
    best = distance;
    nearest = candidate;
  }
  return nearest ? nearest : shortest_completion(lower, valid);
}

std::string did_you_mean(std::string_view word, std::span<const std::string> valid) {
  const auto nearest = nearest_word(word, valid);
  return nearest ? "did you mean '" + *nearest + "'?" : std::string();
}

}  // namespace yars::text
