// Checks of single fields of a record. The first fault is kept as text.
// Limit of the session's clock that users meet: commands, forms and pages check against it.
// Source of the limit: ClockState::rate in world_state.idl, whose range is the same.
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

inline constexpr double kMaxClockRate = 10.0;  // sim time / real time; at higher rates programs skip late ticks

// Reason to refuse a record: the first fault as "FIELD: expected ..., found ...". nullopt: the record is valid.
using Refusal = std::optional<std::string>;

// Range of a field; both ends are valid.
struct Limits {
  double min, max;
};

enum class Missing { refused, allowed };  // treatment of NaN, which means "no value"

// The first `count` entries of an array; all entries if `count` exceeds the size.
template <class Entry, std::size_t size>
std::span<const Entry> used(const Entry (&entries)[size], std::size_t count) {
  return std::span(entries).first(std::min(count, size));
}

// Checks the fields of one record one after the other, and keeps the first fault.
class Inspection {
 public:
  void range(std::string_view field, double value, double min, double max, Missing missing = Missing::refused) {
    if (missing == Missing::allowed && std::isnan(value)) return;
    // NaN fails this comparison, so that NaN is a fault.
    if (!(value >= min && value <= max))
      fault(field, '[' + text::text_of_number(min) + ", " + text::text_of_number(max) + ']',
            text::text_of_number(value));
  }
  void range(std::string_view field, double value, Limits limits, Missing missing = Missing::refused) {
    range(field, value, limits.min, limits.max, missing);
  }

  // Integers are compared as integers, because a double would round large ones.
  template <std::integral Value>
  void whole(std::string_view field, Value value, std::type_identity_t<Value> min, std::type_identity_t<Value> max) {
    if (value < min || value > max)
      fault(field, '[' + std::to_string(min) + ", " + std::to_string(max) + ']', std::to_string(value));
  }
  void at_most(std::string_view field, std::uint64_t value, std::uint64_t max) {
    if (value > max) fault(field, "at most " + std::to_string(max), std::to_string(value));
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
    // A control character could control a terminal on which the text is printed.
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
