// Checks of a record's fields: the first fault as text.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "databuffer/messages/limits.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::databuffer {

// Why a record from outside is refused: nothing for a good one, else the first fault as text, "field: expected,
// found".
using Refusal = std::optional<std::string>;

// A range, both ends included.
struct Limits {
  double least, most;
};

enum class Missing { refused, allowed };  // whether NaN stands for "none"

// The entries of an array that are in use; a count beyond the array counts as the whole of it.
template <class Entry, std::size_t size>
std::span<const Entry> used(const Entry (&entries)[size], std::size_t count) {
  return std::span(entries).first(std::min(count, size));
}

// Collects the first fault of a record; a reader wants one line, not twenty.
class Inspection {
 public:
  void range(std::string_view field, double value, double least, double most, Missing missing = Missing::refused) {
    if (missing == Missing::allowed && std::isnan(value)) return;
    // Written so that NaN fails.
    if (!(value >= least && value <= most))
      fault(field, '[' + text::text_of_number(least) + ", " + text::text_of_number(most) + ']',
            text::text_of_number(value));
  }
  void range(std::string_view field, double value, Limits limits, Missing missing = Missing::refused) {
    range(field, value, limits.least, limits.most, missing);
  }

  // Whole numbers are compared exactly, also where a double would round them.
  template <std::integral Value>
  void whole(std::string_view field, Value value, std::type_identity_t<Value> least, std::type_identity_t<Value> most) {
    if (value < least || value > most)
      fault(field, '[' + std::to_string(least) + ", " + std::to_string(most) + ']', std::to_string(value));
  }
  void at_most(std::string_view field, std::uint64_t value, std::uint64_t most) {
    if (value > most) fault(field, "at most " + std::to_string(most), std::to_string(value));
  }

  void latitude(std::string_view field, double value, Missing missing = Missing::refused) {
    range(field, value, -90.0, 90.0, missing);
  }
  void longitude(std::string_view field, double value, Missing missing = Missing::refused) {
    range(field, value, -180.0, 180.0, missing);
  }

  void text(std::string_view field, std::span<const char> characters) {
    const auto end = std::ranges::find(characters, '\0');
    if (end == characters.end()) fault(field, "a zero at its end", "none");
    // A control character in a name could drive the terminal of whoever prints it.
    const auto printable = [](char character) { return character >= ' ' && character <= '~'; };
    if (!std::all_of(characters.begin(), end, printable)) fault(field, "printable ASCII", "something else");
  }

  void fault(std::string_view field, std::string_view expected, std::string_view found) {
    if (!refusal_)
      refusal_ = std::string(field) + ": expected " + std::string(expected) + ", found " + std::string(found);
  }

  Refusal result() { return std::move(refusal_); }

 private:
  Refusal refusal_;
};

}  // namespace yars::databuffer
