#include <array>

#include "config/field.hpp"
#include "config/forms.hpp"

namespace yars::config {
namespace {

constexpr std::array<std::string_view, 8> kDirections{"N", "S", "E", "W", "north", "south", "east", "west"};

SlotSchema share(std::string_view name, NumberSlot binding, std::string_view purpose) {
  return {.name = name, .lowest = 0, .highest = 1, .binding = binding, .purpose = purpose};
}

std::vector<SlotSchema> red_green_blue() {
  return {share("red", {YARS_FIELD(color.red)}, "share of red"),
          share("green", {YARS_FIELD(color.green)}, "share of green"),
          share("blue", {YARS_FIELD(color.blue)}, "share of blue")};
}

std::vector<SlotSchema> hue_saturation_value() {
  return {{.name = "hue",
           .unit = "deg",
           .lowest = 0,
           .highest = 360,
           .binding = NumberSlot{YARS_FIELD(hue.hue_deg)},
           .purpose = "place on the colour wheel"},
          share("saturation", {YARS_FIELD(hue.saturation)}, "1 = pure hue, also where it is left out"),
          share("value", {YARS_FIELD(hue.value)}, "1 = full intensity, also where it is left out")};
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
  const SlotSchema alpha = share("alpha", {}, "0 = transparent, 1 = opaque");
  const auto black = [](Draft& draft) { draft.color = {}; };
  const auto pure_red = [](Draft& draft) { draft.hue = {0.0, 1.0, 1.0}; };
  const auto convert = [](Draft& draft) {
    draft.color = radar::rgb_from_hsv(draft.hue.hue_deg, draft.hue.saturation, draft.hue.value);
  };
  return {{.name = "rgb",
           .purpose = "a colour by red, green and blue",
           .slots = red_green_blue(),
           .part_of_value = true,
           .begin = black},
          {.name = "rgba",
           .base = "rgb",
           .purpose = "rgb with transparency",
           .slots = with_base(red_green_blue(), {alpha}),
           .part_of_value = true,
           .begin = black},
          {.name = "hsv",
           .purpose = "a colour by hue, saturation and value",
           .slots = hue_saturation_value(),
           .part_of_value = true,
           .begin = pure_red,
           .end = convert},
          {.name = "hsva",
           .base = "hsv",
           .purpose = "hsv with transparency",
           .slots = with_base(hue_saturation_value(), {alpha}),
           .part_of_value = true,
           .begin = pure_red,
           .end = convert},
          lat_long()};
}

}  // namespace yars::config
