// Word of a list that a misspelled word most likely means, for "did you mean" in messages.
// Inputs: a word from the user; the words that are valid.
// Output: the nearest valid word by Damerau-Levenshtein distance: inserted, missing, wrong and transposed characters
// count 1 each. ASCII upper and lower case are equal.
// Errors: std::nullopt if no valid word is near enough.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace yars::text {

// Damerau-Levenshtein distance: number of edits that lead from one word to the other. Case counts.
int edit_distance(std::string_view from, std::string_view to);

// The nearest of `valid`, at a distance of at most a third of the length of `word`. Of equally near words the first. If
// none is near: the shortest that begins with a `word` of four characters or more, as status with stat.
std::optional<std::string> nearest_word(std::string_view word, std::span<const std::string> valid);

// "did you mean 'WORD'?" with the nearest valid word; empty if none is near enough.
std::string did_you_mean(std::string_view word, std::span<const std::string> valid);

}  // namespace yars::text
