// Forms of the configuration language GUF with their slots (schema.hpp): colours, angles, window and displays.
#include <algorithm>
#include <array>
#include <cmath>

#include "config/schema/schema.hpp"
#include "lib/radar/view.hpp"

namespace yars::config {

namespace {

// The index modulo 4 is the direction: 0 north, 1 south, 2 east, 3 west.
constexpr std::array<std::string_view, 8> kDirections{"N", "S", "E", "W", "north", "south", "east", "west"};

// Schema of a slot with a number from 0 to 1.
SlotSchema fraction_slot(std::string_view name, NumberSlot binding, std::string_view purpose) {
  return {.name = name, .lowest = 0, .highest = 1, .binding = binding, .purpose = purpose};
}

std::vector<SlotSchema> red_green_blue() {
  return {fraction_slot("red", {YARS_FIELD(color.red)}, "fraction of red"),
          fraction_slot("green", {YARS_FIELD(color.green)}, "fraction of green"),
          fraction_slot("blue", {YARS_FIELD(color.blue)}, "fraction of blue")};
}

// RGB of a colour given by hue in [0, 360] (red 0, green 120, blue 240), saturation and value, both in [0, 1].
radar::Rgb rgb_from_hsv(double hue_deg, double saturation, double value) {
  // A channel equals `value` within 60 degrees of channel_hue_deg. Between 60 and 120 degrees the channel falls
  // linearly to value * (1 - saturation), and is constant beyond.
  const auto channel = [&](double channel_hue_deg) {
    const double sixths = std::abs(std::remainder(hue_deg - channel_hue_deg, 360.0)) / 60.0;
    return value * (1.0 - saturation * std::clamp(sixths - 1.0, 0.0, 1.0));
  };
  return {channel(0.0), channel(120.0), channel(240.0)};
}

std::vector<SlotSchema> hue_saturation_value() {
  return {{.name = "hue",
           .unit = "deg",
           .lowest = 0,
           .highest = 360,
           .binding = NumberSlot{YARS_FIELD(hue.hue_deg)},
           .purpose = "angle on the colour wheel"},
          fraction_slot("saturation", {YARS_FIELD(hue.saturation)}, "0 = gray, 1 = pure hue; 1 when omitted"),
          fraction_slot("value", {YARS_FIELD(hue.value)}, "0 = black, 1 = full intensity; 1 when omitted")};
}

FormSchema lat_long() {
  return {.name = "lat-long",
          .purpose = "a latitude or longitude in degrees, minutes and seconds",
          .slots = {{.name = "direction",
                     .binding = ChoiceSlot{
                         kDirections, [](const ConfigurationBuilder& builder) { return builder.angle.direction; },
                         [](ConfigurationBuilder& builder, int index) { builder.angle.direction = index % 4; }},
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
          .begin = [](ConfigurationBuilder& builder) { builder.angle = {}; }};
}

}  // namespace

std::vector<FormSchema> value_forms() {
  SlotSchema alpha = fraction_slot("alpha", {}, "0 = transparent, 1 = opaque");
  alpha.instead = "all colours are opaque";
  const auto black = [](ConfigurationBuilder& builder) { builder.color = {}; };
  const auto pure_red = [](ConfigurationBuilder& builder) { builder.hue = {0.0, 1.0, 1.0}; };
  const auto convert = [](ConfigurationBuilder& builder) {
    builder.color = rgb_from_hsv(builder.hue.hue_deg, builder.hue.saturation, builder.hue.value);
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

namespace {

constexpr std::array<std::string_view, 2> kColourModes{"colormap", "rgb"};
constexpr std::array<std::string_view, 4> kBufferModes{"doublebuffer", "singlebuffer", "double", "single"};

constexpr std::array<std::string_view, 3> kColorPresets{"green", "gray", "night"};

// Schema of a colour slot. `store` copies builder.color to the slot's field; `load` copies the field to builder.color.
SlotSchema color_slot(std::string_view name, void (*store)(ConfigurationBuilder&), void (*load)(ConfigurationBuilder&),
                      std::string_view purpose) {
  return {.name = name,
          .binding = FormSlot{{"rgb", "rgba", "hsv", "hsva"}, {"rgb"}, false, store, load},
          .purpose = purpose};
}

FormSchema color_scheme() {
  return {
      .name = "ColorScheme",
      .purpose = "the colours of the display",
      .slots = {{.name = "preset",
                 .binding = ChoiceSlot{kColorPresets,
                                       [](const ConfigurationBuilder& builder) {
                                         return static_cast<int>(builder.radar.view.colors.preset);
                                       },
                                       [](ConfigurationBuilder& builder, int index) {
                                         builder.radar.view.colors =
                                             radar::color_preset(static_cast<radar::ColorPreset>(index));
                                       }},
                 .purpose = "all colours at once: green phosphor, gray, or a dim red for the night",
                 .before_others = true},
                color_slot(
                    "video", [](ConfigurationBuilder& builder) { builder.radar.view.colors.video = builder.color; },
                    [](ConfigurationBuilder& builder) { builder.color = builder.radar.view.colors.video; },
                    "colour of the brightest video; darker video is a fraction of it"),
                color_slot(
                    "symbols", [](ConfigurationBuilder& builder) { builder.radar.view.colors.symbols = builder.color; },
                    [](ConfigurationBuilder& builder) { builder.color = builder.radar.view.colors.symbols; },
                    "legends and symbols"),
                color_slot(
                    "lines", [](ConfigurationBuilder& builder) { builder.radar.view.colors.lines = builder.color; },
                    [](ConfigurationBuilder& builder) { builder.color = builder.radar.view.colors.lines; },
                    "range arcs and zero azimuth line")}};
}

std::vector<SlotSchema> view_slots() {
  return {{.name = "width",
           .unit = "ranges",
           .lowest = -4,
           .highest = 4,
           .binding = SpanSlot{YARS_FIELD(radar.view.width_min), YARS_FIELD(radar.view.width_max), true},
           .purpose = "left and right edge of the display, relative to the aircraft; 1 = the selected range"},
          {.name = "height",
           .unit = "ranges",
           .lowest = -4,
           .highest = 4,
           .binding = SpanSlot{YARS_FIELD(radar.view.height_min), YARS_FIELD(radar.view.height_max), false},
           .purpose = "bottom and top edge of the display, relative to the aircraft; 1 = the selected range"}};
}

constexpr std::string_view kMapFills = "a map fills the display; windows of SarMode are its sizes";

std::vector<SlotSchema> unused_view_slots() {
  return {{.name = "width",
           .lowest = -4,
           .highest = 4,
           .binding = SpanSlot{},
           .purpose = "left and right edge",
           .instead = kMapFills},
          {.name = "height",
           .lowest = -4,
           .highest = 4,
           .binding = SpanSlot{nullptr, nullptr, false},
           .purpose = "bottom and top edge",
           .instead = kMapFills}};
}

std::optional<ConstraintViolation> check_square(const ConfigurationBuilder& builder) {
  if (builder.window_height_pixels == builder.radar.view.size_pixels) return std::nullopt;
  return ConstraintViolation{
      "height", "the width, " + std::to_string(builder.radar.view.size_pixels) + " (the display is square)",
      std::to_string(builder.window_height_pixels)};
}

FormSchema window() {
  return {.name = "Window",
          .purpose = "the window of the display",
          .slots = {{.name = "width",
                     .unit = "pixels",
                     .lowest = 64,
                     .highest = 4096,
                     .binding = IntegerSlot{YARS_FIELD(radar.view.size_pixels)},
                     .purpose = "width of the display"},
                    {.name = "height",
                     .unit = "pixels",
                     .lowest = 64,
                     .highest = 4096,
                     .binding = IntegerSlot{YARS_FIELD(window_height_pixels)},
                     .purpose = "height of the display, equal to the width"},
                    {.name = "colorIndex",
                     .lowest = 0,
                     .highest = 4095,
                     .binding = IntegerSlot{},
                     .purpose = "first entry in the colour map of the 1996 display",
                     .instead = "scheme has the colours"},
                    {.name = "colors",
                     .binding = FormSlot{{"rgb", "rgba", "hsv", "hsva"},
                                         {},
                                         true,
                                         [](ConfigurationBuilder& builder) {
                                           builder.radar.view.colors.video = builder.color;
                                         }},
                     .purpose = "colours of the video from dark to bright; only the last is used",
                     .same_as = "video of ColorScheme"},
                    {.name = "cmode",
                     .binding = ChoiceSlot{kColourModes},
                     .purpose = "colour mode of the 1996 display",
                     .instead = "OpenGL has no colour map; scheme has the colours"},
                    {.name = "bmode",
                     .binding = ChoiceSlot{kBufferModes},
                     .purpose = "buffer mode of the 1996 display",
                     .instead = "the display draws into two buffers",
                     .old_name = "mode"},
                    {.name = "scheme",
                     .binding = FormSlot{{"ColorScheme"}, {"ColorScheme"}},
                     .purpose = "the colours of the display"}},
          .check = check_square};
}

}  // namespace

std::vector<FormSchema> display_forms() {
  return {
      window(),
      color_scheme(),
      {.name = "Display", .purpose = "the part of the ground that the display shows", .slots = view_slots()},
      {.name = "RbmDisplay",
       .base = "Display",
       .purpose = "the picture of the real beam map",
       .slots = with_base(view_slots(),
                          {{.name = "rangeRings",
                            .unit = "NM",
                            .lowest = 0,
                            .highest = 500,
                            .binding = ListSlot{YARS_FIELD(radar.view.arc_spacing_nm), 0, 16},
                            .purpose = "spacing of the range arcs, one number per range; the last applies to all "
                                       "further ranges; without numbers: arcs at 25, 50, 75, 100 % of the range"}})},
      {.name = "SarDisplay",
       .base = "Display",
       .purpose = "the picture of the high resolution map",
       .slots = unused_view_slots()},
      {.name = "MgDisplay", .base = "Display", .purpose = "the test picture of 1996", .slots = unused_view_slots()}};
}

}  // namespace yars::config
