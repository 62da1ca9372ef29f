// Text from outside (file names, comments, records, arguments) as a terminal or a log may show it.
#pragma once

#include <string>
#include <string_view>

namespace yars::failure {

// Control characters as \n, \t or \x1b, also those of Unicode (U+0080 to U+009F, direction marks) and bytes that are no
// UTF-8; the rest as it is. Text without any comes back unchanged.
std::string printable(std::string_view text);
// The same, but new lines and tabs stay.
std::string printable_lines(std::string_view text);
// Bytes at the end of `text` that begin a character of UTF-8 whose other bytes are still to come: 0 to 3.
std::size_t unfinished_bytes(std::string_view text);

}  // namespace yars::failure
