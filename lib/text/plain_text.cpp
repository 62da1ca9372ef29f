#include "lib/text/plain_text.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

namespace yars::text {

namespace {

// Length [bytes] of a UTF-8 character with the first byte `first`; 0 if no character begins with this byte.
std::size_t utf8_length(unsigned char first) {
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first <= 0xDF) return 2;
  if (first >= 0xE0 && first <= 0xEF) return 3;
  if (first >= 0xF0 && first <= 0xF4) return 4;
  return 0;
}

// True for a continuation byte of UTF-8, 10xxxxxx in binary.
bool continues(char byte) {
  return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U;
}

// Code point of the UTF-8 character at the front of `text`. 0, which counts as a control character, stands for invalid
// characters: overlong forms (more bytes than the value needs), surrogates (U+D800 to U+DFFF), values above U+10FFFF.
std::uint32_t code_point(std::string_view text, std::size_t length) {
  const auto first = static_cast<unsigned char>(text[0]);
  if (length == 1) return first;
  std::uint32_t code = first & (0xFFU >> (length + 1));
  for (const char byte : text.substr(1, length - 1)) code = code << 6U | (static_cast<unsigned char>(byte) & 0x3FU);
  const bool overlong = (length == 3 && code < 0x800U) || (length == 4 && code < 0x10000U);
  const bool surrogate = code >= 0xD800U && code <= 0xDFFFU;
  return overlong || surrogate || code > 0x10FFFFU ? 0U : code;
}

// C0 and C1 controls, delete, line and paragraph separators, direction marks.
bool is_control(std::uint32_t code) {
  return code < 0x20U || (code >= 0x7FU && code < 0xA0U) || (code >= 0x2028U && code <= 0x202EU) ||
         (code >= 0x2066U && code <= 0x2069U) || code == 0x200EU || code == 0x200FU;
}

void append_escaped(std::string& result, char byte) {
  constexpr std::string_view kHex = "0123456789abcdef";
  const auto value = static_cast<unsigned char>(byte);
  if (byte == '\n') {
    result += "\\n";
  } else if (byte == '\t') {
    result += "\\t";
  } else {
    result += {'\\', 'x', kHex[value >> 4U], kHex[value & 0xFU]};
  }
}

std::string escaped(std::string_view text, bool keep_lines) {
  std::string result;
  result.reserve(text.size());
  while (!text.empty()) {
    std::size_t length = utf8_length(static_cast<unsigned char>(text[0]));
    const bool complete = length > 0 && length <= text.size() &&
                          std::all_of(text.begin() + 1, text.begin() + static_cast<std::ptrdiff_t>(length), continues);
    if (!complete) length = 1;
    const bool kept =
        complete && (!is_control(code_point(text, length)) || (keep_lines && (text[0] == '\n' || text[0] == '\t')));
    if (kept) result += text.substr(0, length);
    if (!kept) std::for_each_n(text.begin(), length, [&](char byte) { append_escaped(result, byte); });
    text.remove_prefix(length);
  }
  return result;
}

}  // namespace

std::string printable(std::string_view text) {
  return escaped(text, false);
}

std::string printable_lines(std::string_view text) {
  return escaped(text, true);
}

std::size_t unfinished_bytes(std::string_view text) {
  for (std::size_t back = 1; back <= std::min<std::size_t>(3, text.size()); ++back) {
    const char byte = text[text.size() - back];
    if (continues(byte)) continue;
    return utf8_length(static_cast<unsigned char>(byte)) > back ? back : 0;
  }
  return 0;
}

namespace {

constexpr std::string_view kBlanks = " \t\r\v\f\n";

}  // namespace

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::string shortened(std::string_view text) {
  constexpr std::size_t kMost = 500;
  if (text.size() <= kMost) return std::string(text);
  std::string_view kept = text.substr(0, kMost);
  kept.remove_suffix(unfinished_bytes(kept));
  return std::string(kept) + "... (" + std::to_string(text.size()) + " bytes)";
}

std::vector<std::string_view> fields_of(std::string_view text, char separator) {
  std::vector<std::string_view> fields;
  while (true) {
    const std::size_t end = text.find(separator);
    fields.push_back(trimmed(text.substr(0, end)));
    if (end == std::string_view::npos) return fields;
    text.remove_prefix(end + 1);
  }
}

std::vector<NumberedLine> numbered_lines(std::string_view text) {
  std::vector<NumberedLine> lines;
  int number = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view whole = text.substr(0, end);
    const std::string_view line = trimmed(whole.substr(0, whole.find('#')));
    ++number;
    if (!line.empty()) lines.push_back({number, line});
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

std::vector<std::string_view> words_of(std::string_view text) {
  std::vector<std::string_view> words;
  for (text = trimmed(text); !text.empty(); text = trimmed(text)) {
    const std::size_t end = std::min(text.find_first_of(kBlanks), text.size());
    words.push_back(text.substr(0, end));
    text.remove_prefix(end);
  }
  return words;
}

std::optional<double> finite_number(std::string_view word) {
  if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
  double value = 0.0;
  const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (problem != std::errc{} || end != word.data() + word.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::string counted(std::uint64_t count, std::string_view noun, std::string_view plural) {
  const std::string text = std::to_string(count) + ' ';
  if (count == 1) return text + std::string(noun);
  return plural.empty() ? text + std::string(noun) + 's' : text + std::string(plural);
}

std::string text_of_number(double value) {
  std::array<char, 32> buffer{};
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return {buffer.data(), result.ptr};
}

DecimalPoint::DecimalPoint() : before_(nullptr) {
  static const locale_t plain = newlocale(LC_NUMERIC_MASK, "C", duplocale(LC_GLOBAL_LOCALE));
  if (plain != nullptr) before_ = uselocale(plain);
}
DecimalPoint::~DecimalPoint() {
  if (before_ != nullptr) uselocale(before_);
}

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
