// One field of a record as `yars status` shows it in text and JSON.
// Inputs: fields with @status in lib/values/*.idl; the generated shown_fields.hpp makes a ShownField of each.
// Outputs: name, unit and value. Units: as `unit` says.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

#include "lib/text/plain_text.hpp"

namespace yars::databuffer {

struct ShownField {
  std::string_view name;  // "wind_speed_mps"
  std::string_view stem;  // "wind_speed"
  std::string_view unit;  // "m/s"; empty: none
  // A double may be NaN, a text empty: then there is no value.
  std::variant<bool, std::int64_t, std::uint64_t, double, std::string> value;
};

template <std::size_t size>
std::string shown_text(const char (&text)[size]) {
  return std::string(text::text_of(text));
}

}  // namespace yars::databuffer
