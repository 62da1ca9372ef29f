// Plain text: escaping for terminals and logs; splitting into lines, words and fields; numbers; the word of a list that
// a misspelled word most likely means, for "did you mean" in messages.
// Inputs: UTF-8 text from outside the program: file names, arguments, records, text files with one record a line.
// Outputs: new strings, or views of the input. The input must outlive the views. The nearest word is that by
//   Damerau-Levenshtein distance: inserted, missing, wrong and transposed characters count 1 each; ASCII upper and
//   lower case are equal.
// Errors: std::nullopt for text that is not a number, or if no valid word is near enough. The other functions accept
//   every text.
#pragma once

#include <charconv>
#include <clocale>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace yars::text {

// The text with control characters escaped, for example as \n, \t or \x1b. Control characters of Unicode (U+0080 to
// U+009F, line separators, direction marks) and bytes that are not valid UTF-8 are escaped too.
std::string printable(std::string_view text);
// Like printable(), but line feeds and tabs are kept.
std::string printable_lines(std::string_view text);
// The text of someone else for a message: a longer one than 500 bytes is cut behind a character and ends with its
// length, as in "xxx... (70000 bytes)".
std::string shortened(std::string_view text);
// Number of bytes, 0 to 3, of an incomplete UTF-8 character at the end of `text`.
std::size_t unfinished_bytes(std::string_view text);

// The text in a character array of a record, up to the first zero byte. A full array may have no zero byte.
template <std::size_t N>
std::string_view text_of(const char (&field)[N]) {
  return {field, strnlen(field, N)};
}

// Copies text into a character array of a record: at most N - 1 bytes, then zeros.
template <std::size_t N>
void put_text(char (&field)[N], std::string_view text) {
  std::memset(field, 0, N);
  text.copy(field, N - 1);
}

struct NumberedLine {
  int number = 0;         // counts from 1
  std::string_view text;  // without comment and without blanks (ASCII white space) at both ends; never empty
};

// The lines of `text` that contain more than blanks and a comment. `#` begins a comment.
std::vector<NumberedLine> numbered_lines(std::string_view text);

// `text` without blanks at both ends. Carriage returns and line feeds count as blanks.
std::string_view trimmed(std::string_view text);
// The parts of `text` between blanks.
std::vector<std::string_view> words_of(std::string_view text);
// The parts of `text` between separators, each without blanks at both ends. An empty text has one empty field.
std::vector<std::string_view> fields_of(std::string_view text, char separator);

// The decimal number that `word` consists of, with or without a sign. nullopt: the word is anything else, or
// the number is outside the range of double.
std::optional<double> finite_number(std::string_view word);
// The whole number that `word` consists of: digits of the base `base`; for a signed type also a leading '-'. nullopt:
// the word is anything else, or the number is outside the range of the type.
template <std::integral Whole>
std::optional<Whole> whole_number(std::string_view word, int base = 10) {
  Whole value{};
  const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), value, base);
  if (problem != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return value;
}
// "1 file", "2 files", "0 files": the number with its noun. `plural`: where it is not the noun with an s.
std::string counted(std::uint64_t count, std::string_view noun, std::string_view plural = {});
// The shortest decimal text from which finite_number() returns the same value; `nan` or `inf` if it is not finite.
std::string text_of_number(double value);

// While it exists, the thread's numbers in text have a decimal point. For libraries: a host program may have set a
// locale with a comma, which snprintf() and strtod() follow. Not copied; the last one made ends first.
class DecimalPoint {
 public:
  DecimalPoint();
  ~DecimalPoint();
  DecimalPoint(const DecimalPoint&) = delete;
  DecimalPoint& operator=(const DecimalPoint&) = delete;

 private:
  locale_t before_;
};

// Damerau-Levenshtein distance: number of edits that lead from one word to the other. Case counts.
int edit_distance(std::string_view from, std::string_view to);

// The nearest of `valid`, at a distance of at most a third of the length of `word`. Of equally near words the first. If
// none is near: the shortest that begins with a `word` of four characters or more, as status with stat.
std::optional<std::string> nearest_word(std::string_view word, std::span<const std::string> valid);

// "did you mean 'WORD'?" with the nearest valid word; empty if none is near enough.
std::string did_you_mean(std::string_view word, std::span<const std::string> valid);

}  // namespace yars::text
