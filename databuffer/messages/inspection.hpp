// Checks of a record's fields: the first fault as text.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "databuffer/messages/pictures.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::databuffer {

// Why a record from outside is refused: nothing for a good one, else the first fault as text, "field: expected,
// found".
using Refusal = std::optional<std::string>;

// How the border looks at records: ranges that NaN never passes, texts, and the limits that several records share.

// [m/s] of one velocity component; above orbital speed a number is garbage, and squares of it spoil Doppler sums.
inline constexpr double kLargestSpeed = 10'000.0;
// [NM] of selected range and of the cursor's distance: half round the Earth.
inline constexpr double kLargestRange = 10'800.0;
// [m] MSL: below the deepest sea floor, above the highest mountain.
inline constexpr double kLowestGround = -12'000.0;
inline constexpr double kHighestGround = 10'000.0;

enum class Missing { refused, allowed };  // whether NaN stands for "none"

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

  void latitude(std::string_view field, double value, Missing missing = Missing::refused) {
    range(field, value, -90.0, 90.0, missing);
  }
  void longitude(std::string_view field, double value, Missing missing = Missing::refused) {
    range(field, value, -180.0, 180.0, missing);
  }
  void picture_id(std::string_view field, std::uint64_t id) {
    if (id > kLatestPictureId) fault(field, "at most " + std::to_string(kLatestPictureId), std::to_string(id));
  }
  void speed(std::string_view field, double value) { range(field, value, -kLargestSpeed, kLargestSpeed); }

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
