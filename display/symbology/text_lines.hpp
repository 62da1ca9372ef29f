// Division of a text into lines of the display's font.
// Inputs: a text in one line; the width of a line in cap heights (draw_list.hpp: text_width).
// Outputs: lines without blanks at their ends.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace yars::display {

// Divides a text at its blanks into as few lines as it takes, of about the same width. A number stays with its unit, an
// event with its argument and its key: "10.0 NM", "acq aft (PgDn)". No line is a single short word if another division
// of as many lines avoids that. A longer word has a line of its own.
std::vector<std::string> wrapped(std::string_view text, float max_width);

// The first words of the text, as many as fit a line of `max_width`; at least one if there is one.
std::string first_words(std::string_view text, float max_width);

}  // namespace yars::display
