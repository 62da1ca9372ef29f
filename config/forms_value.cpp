#include <array>

#include "config/field.hpp"
#include "config/forms.hpp"

namespace yars::config {
namespace {

constexpr std::array<std::string_view, 8> kDirections{"N", "S", "E", "W", "north", "south", "east", "west"};

SlotSchema share(std::string_view name, std::string_view purpose) {
  return {.name = name, .lowest = 0, .highest = 1, .binding = NumberSlot{}, .purpose = purpose};
}

std::vector<SlotSchema> red_green_blue() {
  return {share("red", "share of red"), share("green", "share of green"), share("blue", "share of blue")};
}

std::vector<SlotSchema> hue_saturation_value() {
  return {{.name = "hue",
           .unit = "deg",
           .lowest = 0,
           .highest = 360,
           .binding = NumberSlot{},
           .purpose = "place on the colour wheel"},
          share("saturation", "1 = pure hue"),
          share("value", "1 = full intensity")};
}

FormSchema lat_long() {
  return {.name = "lat-long",
          .purpose = "a latitude or longitude in degrees, minutes and seconds",
          .slots = {{.name = "direction",
                     .binding = ChoiceSlot{kDirections, [](const Draft& draft) { return draft.angle.direction; },
                                           [](Draft& draft, int index) { draft.angle.direction = index % 4; }},
                     .purpose = "hemisphere"},
                    {.name = "degrees",
                     .unit = "deg",
                     .lowest = 0,
                     .highest = 180,
                     .binding = NumberSlot{YARS_FIELD(angle.degrees)},
                     .purpose = "whole or decimal degrees"},
                    {.name = "minutes",
                     .unit = "arcmin",
                     .lowest = 0,
                     .highest = 60,
                     .binding = NumberSlot{YARS_FIELD(angle.minutes)},
                     .purpose = "added to the degrees"},
                    {.name = "seconds",
                     .unit = "arcsec",
                     .lowest = 0,
                     .highest = 60,
                     .binding = NumberSlot{YARS_FIELD(angle.seconds)},
                     .purpose = "added to the minutes"}},
          .part_of_value = true,
          .begin = [](Draft& draft) { draft.angle = {}; }};
}

}  // namespace

std::vector<FormSchema> value_forms() {
  const SlotSchema alpha = share("alpha", "0 = transparent, 1 = opaque");
  return {
      {.name = "rgb", .purpose = "a colour by red, green and blue", .slots = red_green_blue(), .part_of_value = true},
      {.name = "rgba",
       .base = "rgb",
       .purpose = "rgb with transparency",
       .slots = with_base(red_green_blue(), {alpha}),
       .part_of_value = true},
      {.name = "hsv",
       .purpose = "a colour by hue, saturation and value",
       .slots = hue_saturation_value(),
       .part_of_value = true},
      {.name = "hsva",
       .base = "hsv",
       .purpose = "hsv with transparency",
       .slots = with_base(hue_saturation_value(), {alpha}),
       .part_of_value = true},
      lat_long()};
}

}  // namespace yars::config
