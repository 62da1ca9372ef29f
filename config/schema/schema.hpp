// Table of the forms and slots of GUF, the language of the configuration files (docs/configuration.md). A form, such as
// ( Window :width 480 ), is a value of one kind. A slot, such as :width 480, is one named value of a form.
// Inputs: rows for forms and slots, from forms_*.cpp and devices.cpp. The row of a slot has name, unit, range, purpose
// and the field that the slot writes.
// Outputs: the row of a name; the kind of value of a slot as text; ConfigurationBuilder, which has the fields.
// Units: a slot's value has the unit of its row. The field has the unit in the field's name (NumberSlot converts).
// Errors: a violated rule between slots, such as minimum below maximum, gives a ConstraintViolation.
// Source: names and positions are from tables 4 to 26 of the 1996 report. Slots added later have later positions.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "lib/geo/geodesy.hpp"
#include "lib/values/fields.hpp"

namespace yars::radar {
struct AntennaConfiguration;
struct Beacon;
struct Device;
struct DeviceAxis;
struct DeviceButton;
struct Fidelity;
struct HeightRanges;
struct HighResolutionConfiguration;
struct ListEntries;
struct Material;
struct NavigationConfiguration;
struct NetworkSettings;
struct RadarConfiguration;
struct ReceiverConfiguration;
struct Rgb;
struct RoutePoint;
struct Scene;
struct TerrainConfiguration;
struct ViewConfiguration;
struct WindowLimits;
struct WorldConfiguration;
}  // namespace yars::radar

namespace yars::config {

// The form ( lat-long N 35 44 51 ) while it is read.
struct SexagesimalAngle {
  int direction = 0;  // index into N S E W
  double degrees = 0.0;
  double minutes = 0.0;
  double seconds = 0.0;
};

// The form ( hsv 120 1 0.5 ) while it is read.
struct HueSaturationValue {
  double hue_deg = 0.0;
  double saturation = 0.0;
  double value = 0.0;
};

inline constexpr int kKindByName = -1;  // ConfigurationBuilder::point_kind if the point's name determines its kind

// Configuration under construction: `whole`, and references to its sections in `radar`. A form that can occur several
// times, such as Point, is read into a field here, then copied to its list. new_builder() makes the storage.
struct ConfigurationBuilder {
  struct Storage;
  explicit ConfigurationBuilder(Storage& storage);

  struct Sections {
    explicit Sections(radar::RadarConfiguration& whole);

    std::string& name;
    std::vector<double>& ranges_nm;
    std::vector<double>& scan_widths_deg;
    std::vector<double>& windows_nm;
    std::vector<double>& pulse_us;
    radar::AntennaConfiguration& antenna;
    radar::ViewConfiguration& view;
    radar::Fidelity& fidelity;
    radar::ReceiverConfiguration& receiver;
    radar::TerrainConfiguration& terrain;
    radar::HighResolutionConfiguration& high_resolution;
    radar::NavigationConfiguration& navigation;
    radar::WorldConfiguration& world;
    std::vector<radar::RoutePoint>& route;
    std::uint64_t& seed;
    double& magnetic_variation_deg;
    radar::WindowLimits& window_limits;
    radar::HeightRanges& height_ranges;
    std::vector<radar::Device>& devices;
  };

  radar::RadarConfiguration& whole;
  Sections radar;
  int window_height_pixels;  // as the file gives it; must equal the width, because the display is square
  // [pixels] Edge of a patch map: in the slot samples and in the slot width of SarMode. 0: the form omits that slot.
  int map_samples;
  int map_sweeps;
  std::string scene_folder{};  // slot path of MgDbase
  radar::RoutePoint& point;
  int point_kind = kKindByName;                 // a radar::PointKind if the file gives the kind
  std::set<std::string> points_without_kind{};  // names of the route points whose kind the file omits
  SexagesimalAngle angle{};
  radar::Rgb& color;  // the colour read last; FormSlot::store copies it to the field of the slot that contains it
  HueSaturationValue hue{};
  radar::Material& material;
  radar::ListEntries& entries;  // of each list of the world, the entry that was read last
  radar::Scene& scene;
  radar::Beacon& beacon;
  radar::Device& device;
  radar::DeviceButton& device_button;
  radar::DeviceAxis& device_axis;
  radar::NetworkSettings& network;
  bool has_network = false;  // true: a form Network was read
};

using BuilderPointer = std::shared_ptr<ConfigurationBuilder>;

// Builder with the defaults.
BuilderPointer new_builder();

// Builder with a finished configuration, for printing.
BuilderPointer builder_of(const radar::RadarConfiguration& configuration);

// Kinds of slots. The functions `of`, `first`, `second`, `low` and `high` return a field that the slot writes. If these
// functions or `set` are null, the value is validated, but not stored.
struct NumberSlot {
  double& (*of)(ConfigurationBuilder&) = nullptr;
  double si_per_unit = 1.0;  // field = value * si_per_unit
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
struct PathSlot {  // a path; if relative, from the folder of the configuration file that contains it
  std::string& (*of)(ConfigurationBuilder&) = nullptr;
};
struct AngleSlot {  // degrees, or a lat-long form
  double& (*of)(ConfigurationBuilder&) = nullptr;
  bool latitude = true;  // false: longitude
};
struct ChoiceSlot {
  std::span<const std::string_view> words;
  int (*get)(const ConfigurationBuilder&) = nullptr;  // index into words; negative: nothing to print
  void (*set)(ConfigurationBuilder&, int) = nullptr;
};
enum class Order { any, ascending, descending };
struct ListSlot {
  std::vector<double>& (*of)(ConfigurationBuilder&) = nullptr;
  std::size_t min_count = 1;
  std::size_t max_count = 16;
  Order order = Order::any;
};
struct WordsSlot {  // a string or an identifier, or a list of them
  std::vector<std::string>& (*of)(ConfigurationBuilder&) = nullptr;
  std::size_t min_count = 0;
  std::size_t max_count = 16;
};
struct FirstSlot {  // a number, or a list whose first number is used; `of` must not be null
  int& (*of)(ConfigurationBuilder&) = nullptr;
};
struct PairSlot {  // a list of two numbers
  double& (*first)(ConfigurationBuilder&) = nullptr;
  double& (*second)(ConfigurationBuilder&) = nullptr;
};
struct SpanSlot {  // two numbers, low < high; or one number n, the width of the interval
  double& (*low)(ConfigurationBuilder&) = nullptr;
  double& (*high)(ConfigurationBuilder&) = nullptr;
  bool centred = true;  // true: the width n means -n/2 to n/2; false: 0 to n
};
struct SymmetricSlot {  // two numbers, -limit and limit
  double& (*of)(ConfigurationBuilder&) = nullptr;
};
struct FormSlot {
  std::vector<std::string_view> accepted;          // names of the forms that the slot accepts
  std::vector<std::string_view> printed;           // accepted forms that are printed, in this order
  bool many = false;                               // true: one form or a list of forms; false: one form
  void (*store)(ConfigurationBuilder&) = nullptr;  // called after each form: copies its value to the slot's field
  void (*load)(ConfigurationBuilder&) = nullptr;   // called before the forms are printed: the inverse of store
  void (*clear)(ConfigurationBuilder&) = nullptr;  // called before the forms are read: removes those of earlier values
};

using Binding = std::variant<NumberSlot, IntegerSlot, CounterSlot, BooleanSlot, TextSlot, PathSlot, AngleSlot,
                             ChoiceSlot, ListSlot, WordsSlot, FirstSlot, PairSlot, SpanSlot, SymmetricSlot, FormSlot>;

struct SlotSchema {
  std::string_view name{};
  std::string_view unit{};  // "deg", "NM"; empty: none
  double lowest = -std::numeric_limits<double>::infinity();
  double highest = std::numeric_limits<double>::infinity();
  Binding binding{};
  std::string_view purpose{};
  std::string_view instead{};   // for a slot that is not used: what does its work, or why nothing has to
  std::string_view same_as{};   // the slot that is printed instead of this one
  std::string_view old_name{};  // spelling of 1996, accepted with a warning
  bool before_others = false;   // read before the other slots of its form
};

// Violation of a rule between slots.
struct ConstraintViolation {
  std::string_view slot{};
  std::string expected{};
  std::string found{};
};

struct FormSchema {
  std::string_view name{};
  std::string_view base{};  // form that this form extends; empty: none
  std::string_view purpose{};
  std::vector<SlotSchema> slots{};  // in the order of their positions; the slots of the base first
  bool part_of_value = false;       // true: occurs only as the value of a slot, as a colour, an angle or a Point does
  std::string_view old_name{};
  void (*begin)(ConfigurationBuilder&) = nullptr;  // called before the slots are read
  std::optional<ConstraintViolation> (*check)(const ConfigurationBuilder&) = nullptr;  // validates the form
  void (*end)(ConfigurationBuilder&) = nullptr;                                        // called after validation
  // Validates a rule between forms, after all forms are read. A violation is reported at the last form with this rule.
  std::optional<ConstraintViolation> (*check_at_end)(const ConfigurationBuilder&) = nullptr;
  // For printing: the number of forms of this kind (null: one), and a function that copies one of them to the builder.
  std::size_t (*count)(const ConfigurationBuilder&) = nullptr;
  void (*select)(ConfigurationBuilder&, std::size_t) = nullptr;
};

// All forms.
const std::vector<FormSchema>& schema();

enum class Spelling { exact, other_case, old_name };
template <class Schema>
struct Found {
  const Schema* schema = nullptr;  // null: not found
  Spelling spelling = Spelling::exact;
};

// Search by name, also by the name of 1996. Upper and lower case are equal.
Found<FormSchema> find_form(std::string_view name);
Found<SlotSchema> find_slot(const FormSchema& form, std::string_view name);

// The name that a misspelled one most likely means (lib/text/plain_text.hpp); empty: none is near.
std::string nearest_slot(const FormSchema& form, std::string_view name);
std::string nearest_form(std::string_view name);
// The first form with a slot of this name; empty: no form has one.
std::string_view form_with_slot(std::string_view name);

// True if the slot, or a slot of one of the forms in it, stores its value in the configuration. False: the value is
// validated, but has no effect.
bool is_used(const SlotSchema& slot);

// The kind of value and the range, for errors and the manual: "a number in [0, 60] deg".
std::string value_kind(const SlotSchema& slot);

// NOLINTBEGIN(bugprone-macro-parentheses): a path of fields cannot stand in parentheses.
// Function that returns a reference to one field of a builder. Example: `YARS_FIELD(radar.seed)`.
#define YARS_FIELD(path) [](::yars::config::ConfigurationBuilder& builder) -> auto& { return builder.path; }
// NOLINTEND(bugprone-macro-parentheses)

// The rows of the table, one function for each group of forms.
std::vector<FormSchema> value_forms();       // rgb, rgba, hsv, hsva, lat-long
std::vector<FormSchema> system_forms();      // System, Apg70
std::vector<FormSchema> mode_forms();        // Mode, OffMode, StbyMode, RealBeamMode, SarMode
std::vector<FormSchema> antenna_forms();     // AntennaServo, RbmAntenna
std::vector<FormSchema> display_forms();     // Window, ColorScheme, Display, RbmDisplay, SarDisplay, MgDisplay
std::vector<FormSchema> database_forms();    // Database, DedDbase, MgDbase, Terrain
std::vector<FormSchema> model_forms();       // Fidelity, HighResolution, Receiver, Noise
std::vector<FormSchema> route_forms();       // Route, Point
std::vector<FormSchema> world_forms();       // Land, Materials, Material, Sea, Rain, Atmosphere
std::vector<FormSchema> navigation_forms();  // Navigation
std::vector<FormSchema> traffic_forms();     // Jammers, Jammer, Mover, Scenes, Scene
std::vector<FormSchema> list_forms();        // of the lists of the world: two of each, as Movers and Mover
std::vector<FormSchema> limit_forms();       // WindowLimits, HeightRanges
std::vector<FormSchema> beacon_forms();      // Beacons, Beacon
std::vector<FormSchema> device_forms();      // Devices, Device, Button, Axis
std::vector<FormSchema> network_forms();     // Network

// Rule: WindowLimits lists every window of SarMode, with a minimum and a maximum cursor range.
std::optional<ConstraintViolation> check_windows_have_limits(const ConfigurationBuilder& builder);

// Rule: the frequency of Receiver is within X band if the model of Sea is fitted to X band.
std::optional<ConstraintViolation> check_sea_model(const ConfigurationBuilder& builder);

// Sets the cross section of each mover that has a displacement or an edge instead, at the radar's frequency.
void set_cross_sections(radar::RadarConfiguration& configuration);

// Rule: latitude and longitude are given.
std::optional<ConstraintViolation> check_coordinates(geo::GeoPoint position);
// Rules of an entry of a list: there are fewer than `most` so far, and it has coordinates.
std::optional<ConstraintViolation> check_entry(geo::GeoPoint position, std::size_t count, int most,
                                               std::string_view entries);

// Entries of a list, "rain cells".
std::string_view plural(const values::List& list);
// Purpose of the form of a list, "the rain cells".
std::string_view purpose_of(const values::List& list);
// Name of the slot of a value, "crossSection".
std::string_view slot_name(const values::Field& field);

// Purpose of the list of these entries.
std::string_view replaced_list(int most, std::string_view entries);

inline SlotSchema number_slot(std::string_view name, std::string_view unit, double lowest, double highest,
                              NumberSlot binding, std::string_view purpose) {
  return {.name = name, .unit = unit, .lowest = lowest, .highest = highest, .binding = binding, .purpose = purpose};
}

// Slot for a list of forms that replaces the lists of earlier forms. It is read before the other slots of its form.
inline SlotSchema list_slot(std::string_view name, std::string_view form, void (*clear)(ConfigurationBuilder&),
                            std::string_view purpose) {
  return {.name = name,
          .binding = FormSlot{.accepted = {form}, .printed = {form}, .many = true, .clear = clear},
          .purpose = purpose,
          .before_others = true};
}

// Slot for forms that are added to the list of the slot `list`.
inline SlotSchema more_slot(std::string_view name, std::string_view form, std::string_view list,
                            std::string_view purpose) {
  return {.name = name,
          .binding = FormSlot{.accepted = {form}, .printed = {}, .many = true},
          .purpose = purpose,
          .same_as = list};
}
// The same for a list of the world: `moreCells` beside the slot `cells`.
SlotSchema more_slot(std::string_view slot, const values::List& list);

// Slot of a value that lib/values describes. Its purpose says what holds where the slot is left out, if that is no
// number.
SlotSchema value_slot(std::string_view name, const values::Field& field, double& (*of)(ConfigurationBuilder&));
// The same of an entry of a list. Its purpose has the default, too.
SlotSchema entry_slot(std::string_view name, const values::Field& field, double& (*of)(ConfigurationBuilder&));
SlotSchema latitude_slot(double& (*of)(ConfigurationBuilder&));
SlotSchema longitude_slot(double& (*of)(ConfigurationBuilder&));

// The slots of a form that extends a base form: first the slots of the base, then the form's own slots.
inline std::vector<SlotSchema> with_base(std::vector<SlotSchema> base, const std::vector<SlotSchema>& own) {
  base.insert(base.end(), own.begin(), own.end());
  return base;
}

}  // namespace yars::config
