// Table of forms and slots of GUF, and the configuration under construction that they write into.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "lib/radar/configuration.hpp"

namespace yars::config {

// ( lat-long N 35 44 51 ) while it is read.
struct SexagesimalAngle {
  int direction = 0;  // index into N S E W
  double degrees = 0.0;
  double minutes = 0.0;
  double seconds = 0.0;
};

// ( hsv 120 1 0.5 ) while it is read.
struct HueSaturationValue {
  double hue_deg = 0.0;
  double saturation = 0.0;
  double value = 0.0;
};

inline constexpr int kKindByName = -1;  // the name alone tells what a point is

// What the slots of GUF write into: the configuration, and the form in hand where forms come in numbers.
struct ConfigurationBuilder {
  radar::RadarConfiguration radar{};
  int window_height_pixels = radar::ViewConfiguration{}.size_pixels;  // equals the width: the glass is square
  // SarMode's samples and width, 0 while it has not given them.
  int map_samples = radar::Fidelity{}.map_size;
  int map_sweeps = radar::Fidelity{}.map_size;
  std::string scene_folder{};  // of MgDbase
  radar::RoutePoint point{};
  int point_kind = kKindByName;             // a radar::PointKind when it is given
  std::set<std::string> kinds_left_open{};  // names of points of the route whose kind the file does not tell
  SexagesimalAngle angle{};
  radar::Rgb color{};  // in hand, until the slot it stands in takes it
  HueSaturationValue hue{};
  radar::Material material{};
  radar::RainCell rain_cell{};
  radar::Jammer jammer{};
  radar::Mover mover{};
  radar::Scene scene{};
  radar::Beacon beacon{};
  radar::Device device{};
  radar::DeviceButton device_button{};
  radar::DeviceAxis device_axis{};
};

// A draft that stands for a finished configuration.
inline ConfigurationBuilder draft_of(const radar::RadarConfiguration& configuration) {
  return {.radar = configuration, .window_height_pixels = configuration.view.size_pixels};
}

// The one table of forms and slots: reading, checking and printing all come from it. Names and positions are those of
// the 1996 report's tables 4 to 26; what YARS adds stands behind the report's positions.

// What a slot holds and where it goes. A null `of` means: checked, and used by nothing yet.
struct NumberSlot {
  double& (*of)(ConfigurationBuilder&) = nullptr;
  double si_per_unit = 1.0;  // the field is in SI, the slot in its unit
};
struct IntegerSlot {
  int& (*of)(ConfigurationBuilder&) = nullptr;
};
struct CounterSlot {
  std::uint64_t& (*of)(ConfigurationBuilder&) = nullptr;
};
struct BooleanSlot {
  bool& (*of)(ConfigurationBuilder&) = nullptr;
};
struct TextSlot {
  std::string& (*of)(ConfigurationBuilder&) = nullptr;
};
struct PathSlot {  // relative to the file it is written in
  std::string& (*of)(ConfigurationBuilder&) = nullptr;
};
struct AngleSlot {  // degrees, or a lat-long form
  double& (*of)(ConfigurationBuilder&) = nullptr;
  bool latitude = true;
};
struct ChoiceSlot {
  std::span<const std::string_view> words;
  int (*get)(const ConfigurationBuilder&) = nullptr;  // index into words; negative: nothing to print
  void (*set)(ConfigurationBuilder&, int) = nullptr;
};
enum class Order { any, ascending, descending };
struct ListSlot {
  std::vector<double>& (*of)(ConfigurationBuilder&) = nullptr;
  std::size_t least = 1;
  std::size_t most = 16;
  Order order = Order::any;
};
struct FirstSlot {  // a list of which the first number is taken
  int& (*of)(ConfigurationBuilder&) = nullptr;
};
struct PairSlot {
  double& (*first)(ConfigurationBuilder&) = nullptr;
  double& (*second)(ConfigurationBuilder&) = nullptr;
};
struct SpanSlot {  // `( low high ), low below high; a single number is the whole span
  double& (*low)(ConfigurationBuilder&) = nullptr;
  double& (*high)(ConfigurationBuilder&) = nullptr;
  bool centred = true;  // a single number n is -n/2 to n/2, else 0 to n
};
struct SymmetricSlot {  // `( -limit limit )
  double& (*of)(ConfigurationBuilder&) = nullptr;
};
struct FormSlot {
  std::vector<std::string_view> accepted;
  std::vector<std::string_view> printed;  // which of them print writes, in this order
  bool many = false;                      // a list of forms; one alone is a list of one
  void (*take)(ConfigurationBuilder&) =
      nullptr;  // called with each form read: what it made, from the draft into its place
  void (*give)(ConfigurationBuilder&) = nullptr;  // called before print writes the form: the other way
};

using Binding = std::variant<NumberSlot, IntegerSlot, CounterSlot, BooleanSlot, TextSlot, PathSlot, AngleSlot,
                             ChoiceSlot, ListSlot, FirstSlot, PairSlot, SpanSlot, SymmetricSlot, FormSlot>;

struct SlotSchema {
  std::string_view name{};
  std::string_view unit{};  // "deg", "NM", "" for none
  double lowest = -std::numeric_limits<double>::infinity();
  double highest = std::numeric_limits<double>::infinity();
  Binding binding{};
  std::string_view purpose{};
  std::string_view same_as{};   // another slot that print writes instead of this one
  std::string_view old_name{};  // a spelling of 1996, accepted with a warning
  bool before_others = false;   // read first, wherever it stands in its form
};

// A slot that breaks a rule between slots of one form.
struct ConstraintViolation {
  std::string_view slot{};
  std::string expected{};
  std::string found{};
};

struct FormSchema {
  std::string_view name{};
  std::string_view base{};  // as in def-form; empty: none
  std::string_view purpose{};
  std::vector<SlotSchema> slots{};  // by position; those of the base first
  bool part_of_value = false;       // a colour, an angle, a point: never outside all parentheses
  std::string_view old_name{};
  void (*begin)(ConfigurationBuilder&) = nullptr;
  std::optional<ConstraintViolation> (*check)(const ConfigurationBuilder&) = nullptr;
  void (*end)(ConfigurationBuilder&) = nullptr;
  // A rule with other forms, wherever they stand: looked at when all is read, for the last form that has it.
  std::optional<ConstraintViolation> (*agree)(const ConfigurationBuilder&) = nullptr;
  std::size_t (*count)(const ConfigurationBuilder&) = nullptr;  // how many of them print writes; null: one
  void (*select)(ConfigurationBuilder&, std::size_t) = nullptr;
};

const std::vector<FormSchema>& schema();

enum class Spelling { exact, other_case, old_name };
template <class Schema>
struct Found {
  const Schema* schema = nullptr;  // null: there is none
  Spelling spelling = Spelling::exact;
};

// By name; letters' case does not count.
Found<FormSchema> find_form(std::string_view name);
Found<SlotSchema> find_slot(const FormSchema& form, std::string_view name);

// The name nearest to a misspelled one, for "did you mean"; empty when none is near.
std::string_view nearest_slot(const FormSchema& form, std::string_view name);

// Whether anything in YARS uses what the slot holds.
bool is_used(const SlotSchema& slot);

// The kind of value and the range, for messages and the manual: "a number in [0, 60] deg".
std::string value_kind(const SlotSchema& slot);

// NOLINTBEGIN(bugprone-macro-parentheses): a path of fields cannot stand in parentheses.
// For the rows of the schema: the function that names one field of a draft, as `YARS_FIELD(radar.seed)`.
#define YARS_FIELD(path)                                      \
  [](::yars::config::ConfigurationBuilder & draft) -> auto& { \
    return draft.path;                                        \
  }
// NOLINTEND(bugprone-macro-parentheses)

// The rows of the schema, one function a group of forms.
std::vector<FormSchema> value_forms();       // colours, lat-long
std::vector<FormSchema> system_forms();      // System, Apg70
std::vector<FormSchema> mode_forms();        // Mode, OffMode, StbyMode, RealBeamMode, SarMode
std::vector<FormSchema> antenna_forms();     // AntennaServo, RbmAntenna
std::vector<FormSchema> display_forms();     // Window, Display and its kin
std::vector<FormSchema> database_forms();    // Database, DedDbase, MgDbase, Terrain
std::vector<FormSchema> model_forms();       // Fidelity, Receiver, Noise
std::vector<FormSchema> route_forms();       // Route, Point
std::vector<FormSchema> world_forms();       // Land, Materials, Material, Sea, Rain, RainCell
std::vector<FormSchema> navigation_forms();  // Navigation
std::vector<FormSchema> traffic_forms();     // Jammers, Jammer, Movers, Mover, Scenes, Scene
std::vector<FormSchema> limit_forms();       // WindowLimits, HeightRanges
std::vector<FormSchema> beacon_forms();      // Beacons, Beacon
std::vector<FormSchema> device_forms();      // Devices, Device, Button, Axis

// The windows that can be selected are those of SarMode; where they can be mapped tells WindowLimits.
std::optional<ConstraintViolation> check_windows_have_limits(const ConfigurationBuilder& draft);

// A place whose latitude or longitude was not given.
std::optional<ConstraintViolation> check_place(geo::GeoPoint place);

inline SlotSchema number_slot(std::string_view name, std::string_view unit, double lowest, double highest,
                              NumberSlot binding, std::string_view purpose) {
  return {.name = name, .unit = unit, .lowest = lowest, .highest = highest, .binding = binding, .purpose = purpose};
}

inline SlotSchema latitude_slot(double& (*of)(ConfigurationBuilder&)) {
  return {.name = "latitude",
          .unit = "deg",
          .lowest = -90,
          .highest = 90,
          .binding = AngleSlot{of, true},
          .purpose = "WGS84, north positive"};
}

inline SlotSchema longitude_slot(double& (*of)(ConfigurationBuilder&)) {
  return {.name = "longitude",
          .unit = "deg",
          .lowest = -180,
          .highest = 180,
          .binding = AngleSlot{of, false},
          .purpose = "WGS84, east positive"};
}

// A form based on another: the base's slots, then its own.
inline std::vector<SlotSchema> with_base(std::vector<SlotSchema> base, const std::vector<SlotSchema>& own) {
  base.insert(base.end(), own.begin(), own.end());
  return base;
}

}  // namespace yars::config
