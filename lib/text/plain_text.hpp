// Text: made safe for terminals; lines, words, fields and numbers of plain text.
#pragma once

#include <cstddef>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace yars::text {

// Text from outside (file names, comments, records, arguments) as a terminal or a log may show it.

// Control characters as \n, \t or \x1b, also those of Unicode (U+0080 to U+009F, direction marks) and bytes that are no
// UTF-8; the rest as it is. Text without any comes back unchanged.
std::string printable(std::string_view text);
// The same, but new lines and tabs stay.
std::string printable_lines(std::string_view text);
// Bytes at the end of `text` that begin a character of UTF-8 whose other bytes are still to come: 0 to 3.
std::size_t unfinished_bytes(std::string_view text);

// Plain text that people write, a record a line: routes, tracks, scripts. `#` begins a comment.

// The text in a record's field, which a foreign writer may have left without its zero.
template <std::size_t N>
std::string_view text_of(const char (&field)[N]) {
  return {field, strnlen(field, N)};
}

struct NumberedLine {
  int number = 0;         // from 1, as editors count
  std::string_view text;  // without comment and outer blanks; never empty
};

// The lines that say something. They point into `text`, which must outlive them.
std::vector<NumberedLine> numbered_lines(std::string_view text);

// Without blanks (also carriage returns) at both ends.
std::string_view trimmed(std::string_view text);
// What stands between blanks.
std::vector<std::string_view> words_of(std::string_view text);
// What stands between separators, trimmed; an empty text is one empty field.
std::vector<std::string_view> fields_of(std::string_view text, char separator);

// A finite decimal number and nothing else; a sign of either kind may lead.
std::optional<double> finite_number(std::string_view word);
// The shortest text that reads back as the same number.
std::string text_of_number(double value);

}  // namespace yars::text
