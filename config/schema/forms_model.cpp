// Forms of the configuration language GUF with their slots (schema.hpp): radar, fidelity, maps, receiver and noise.
#include <algorithm>
#include <array>

#include "config/guf/parser.hpp"
#include "config/schema/schema.hpp"
#include "lib/radar/fidelity.hpp"
#include "lib/radar/modes.hpp"
#include "lib/radar/sensor.hpp"
#include "lib/values/presets.hpp"

namespace yars::config {

namespace {

// Rule: the widest scan fits into the gimbal limits, unless the scan is circular.
std::optional<ConstraintViolation> check_widths_against_gimbal(const ConfigurationBuilder& builder) {
  const auto& radar = builder.radar;
  const double widest_deg = radar.scan_widths_deg.front();
  const double gimbal_deg = 2.0 * radar.antenna.azimuth_limit_deg;
  if (radar.antenna.circular_scan || widest_deg <= gimbal_deg) return std::nullopt;
  return ConstraintViolation{"modes", "scan widths within the gimbal's " + number_text(gimbal_deg) + " deg",
                             number_text(widest_deg) + " deg"};
}

// What places the aircraft, in place of slots of System.
constexpr std::string_view kPlacedBySource =
    "flight-model places the aircraft, as --source fixed:37.3,-122.6,15000,90,400 does (latitude, longitude, ft, deg, "
    "kn)";

// Slots at positions 1 to 11, in the order of the 1996 report.
std::vector<SlotSchema> reported_slots() {
  return {
      {.name = "display",
       .binding = FormSlot{{"Window", "Display", "RbmDisplay", "SarDisplay", "MgDisplay"}, {"Window"}},
       .purpose = "the radar display"},
      {.name = "antenna",
       .binding = FormSlot{{"AntennaServo", "RbmAntenna"}, {"AntennaServo"}},
       .purpose = "the dish and its servo"},
      {.name = "databases",
       .binding = FormSlot{{"Database", "DedDbase", "MgDbase", "Terrain"}, {}, true},
       .purpose = "terrain of all modes",
       .same_as = "terrain"},
      {.name = "samples",
       .lowest = values::ScanRequest::samples.low,
       .highest = values::ScanRequest::samples.high,
       .binding = IntegerSlot{YARS_FIELD(radar.fidelity.samples)},
       .purpose = values::ScanRequest::samples.purpose,
       .same_as = "samples of Fidelity"},
      {.name = "modes",
       .binding = FormSlot{{"Mode", "OffMode", "StbyMode", "RealBeamMode", "SarMode"},
                           {"OffMode", "StbyMode", "RealBeamMode", "SarMode"},
                           true},
       .purpose = "the modes of the radar"},
      {.name = "ranges",
       .unit = "NM",
       .lowest = 0.1,
       .highest = 500,
       .binding = ListSlot{YARS_FIELD(radar.ranges_nm), 1, 16, Order::ascending},
       .purpose = "ranges that can be selected"},
      {.name = "rate",
       .unit = "Hz",
       .lowest = 1,
       .highest = 1000,
       .binding = NumberSlot{},
       .purpose = "updates of the 1996 main loop",
       .instead = "all programs step by ticks of 5 ms"},
      {.name = "latitude",
       .unit = "deg",
       .lowest = -90,
       .highest = 90,
       .binding = AngleSlot{nullptr, true},
       .purpose = "position of the radar at start",
       .instead = kPlacedBySource},
      {.name = "longitude",
       .unit = "deg",
       .lowest = -180,
       .highest = 180,
       .binding = AngleSlot{nullptr, false},
       .purpose = "position of the radar at start",
       .instead = kPlacedBySource},
      {.name = "altitude",
       .unit = "ft",
       .lowest = -1500,
       .highest = 100'000,
       .binding = NumberSlot{},
       .purpose = "height of the radar at start",
       .instead = kPlacedBySource},
      {.name = "heading",
       .unit = "deg",
       .lowest = -360,
       .highest = 360,
       .binding = NumberSlot{},
       .purpose = "heading of the radar at start",
       .instead = kPlacedBySource},
  };
}

std::vector<SlotSchema> system_slots() {
  std::vector<SlotSchema> slots = with_base(
      reported_slots(),
      {{.name = "name", .binding = TextSlot{YARS_FIELD(radar.name)}, .purpose = "name of this radar"},
       {.name = "pulseWidths",
        .unit = "us",
        .lowest = 0.01,
        .highest = 100,
        .binding = ListSlot{YARS_FIELD(radar.pulse_us), 1, 16, Order::any},
        .purpose = "pulse length by range; the last value applies to longer ranges"},
       {.name = "magneticVariation",
        .unit = "deg",
        .lowest = -180,
        .highest = 180,
        .binding = NumberSlot{YARS_FIELD(radar.magnetic_variation_deg)},
        .purpose = "magnetic variation, east positive; left out: unknown, and bearings count from true north"},
       {.name = "fidelity", .binding = FormSlot{{"Fidelity"}, {"Fidelity"}}, .purpose = "speed against accuracy"},
       {.name = "receiver", .binding = FormSlot{{"Receiver"}, {"Receiver"}}, .purpose = "receiver and ground return"},
       {.name = "noise", .binding = FormSlot{{"Noise"}, {"Noise"}}, .purpose = "thermal noise and speckle"},
       {.name = "terrain", .binding = FormSlot{{"Terrain"}, {"Terrain"}}, .purpose = "source of the elevations"},
       {.name = "route", .binding = FormSlot{{"Route"}, {"Route"}}, .purpose = "sequence points"},
       {.name = "land", .binding = FormSlot{{"Land"}, {"Land"}}, .purpose = "radar return of land"},
       {.name = "materials", .binding = FormSlot{{"Materials"}, {"Materials"}}, .purpose = "radar return of materials"},
       {.name = "sea", .binding = FormSlot{{"Sea"}, {"Sea"}}, .purpose = "radar return of the sea"},
       {.name = "rain", .binding = FormSlot{{"Rain"}, {"Rain"}}, .purpose = "rain"},
       {.name = "jammers", .binding = FormSlot{{"Jammers"}, {"Jammers"}}, .purpose = "jammers"},
       {.name = "movers", .binding = FormSlot{{"Movers"}, {"Movers"}}, .purpose = "ships and vehicles"},
       {.name = "scenes", .binding = FormSlot{{"Scenes"}, {"Scenes"}}, .purpose = "polygonal scenes"},
       {.name = "highResolution",
        .binding = FormSlot{{"HighResolution"}, {"HighResolution"}},
        .purpose = "high resolution maps"},
       {.name = "navigation",
        .binding = FormSlot{{"Navigation"}, {"Navigation"}},
        .purpose = "errors of the navigators, and their updates"},
       {.name = "windowLimits",
        .binding = FormSlot{{"WindowLimits"}, {"WindowLimits"}},
        .purpose = "limits of the cursor range for each window of patch maps"},
       {.name = "heightRanges",
        .binding = FormSlot{{"HeightRanges"}, {"HeightRanges"}},
        .purpose = "automatic choice of the range by height"},
       {.name = "beacons", .binding = FormSlot{{"Beacons"}, {"Beacons"}}, .purpose = "radar beacons"},
       {.name = "devices", .binding = FormSlot{{"Devices"}, {"Devices"}}, .purpose = "maps of cockpit hardware"},
       {.name = "atmosphere",
        .binding = FormSlot{{"Atmosphere"}, {"Atmosphere"}},
        .purpose = "the air, and attenuation by its gases"}});
  for (const FormSchema& form : list_forms()) {
    const auto is_there = [&form](const SlotSchema& slot) {
      const auto* const forms = std::get_if<FormSlot>(&slot.binding);
      return forms != nullptr && forms->accepted.front() == form.name;
    };
    if (form.part_of_value || std::ranges::any_of(slots, is_there)) continue;
    slots.push_back(
        {.name = form.slots.front().name, .binding = FormSlot{{form.name}, {form.name}}, .purpose = form.purpose});
  }
  return slots;
}

}  // namespace

std::vector<FormSchema> system_forms() {
  return {{.name = "System",
           .purpose = "a radar of any type",
           .slots = system_slots(),
           .old_name = "Radar",
           .check = check_widths_against_gimbal},
          {.name = "Apg70",
           .base = "System",
           .purpose = "the radar",
           .slots = system_slots(),
           .check = check_widths_against_gimbal}};
}

namespace {

// Words in the order of the enumerations of lib/radar.
constexpr std::array<std::string_view, 3> kAlgorithms{"standard", "reference", "report-1996"};
constexpr std::array<std::string_view, 3> kEarthModels{"flat", "sphere", "ellipsoid"};
constexpr std::array<std::string_view, 3> kInterpolations{"nearest", "bilinear", "cubic"};
constexpr std::array<std::string_view, 4> kBeams{"hard-edge", "gaussian", "cosecant-squared", "mapping"};

// The presets, and `auto`, with which radar-model selects a preset by its processor load.
constexpr auto kPresets = [] {
  std::array<std::string_view, values::kPresets.size() + 1> names{};
  std::ranges::copy(values::kPresets, names.begin());
  names.back() = "auto";
  return names;
}();

int preset_of(const ConfigurationBuilder& builder) {
  const auto* const found = std::find(kPresets.begin(), kPresets.end(), builder.radar.fidelity.name);
  return found == kPresets.end() ? -1 : static_cast<int>(found - kPresets.begin());
}

void set_preset(ConfigurationBuilder& builder, int index) {
  const std::string_view name = kPresets[static_cast<std::size_t>(index)];
  if (const auto preset = radar::fidelity_preset(name)) {
    builder.radar.fidelity = *preset;
    return;
  }
  // `auto` is not a preset: it sets `automatic`, and every other slot to its default.
  builder.radar.fidelity = radar::Fidelity();
  builder.radar.fidelity.automatic = true;
}

SlotSchema flag(std::string_view name, bool& (*of)(ConfigurationBuilder&), std::string_view purpose) {
  return {.name = name, .binding = BooleanSlot{of}, .purpose = purpose};
}

// Slots of the real beam map.
std::vector<SlotSchema> sweep_fidelity_slots() {
  return {
      {.name = "preset",
       .binding = ChoiceSlot{kPresets, preset_of, set_preset},
       .purpose = "sets all other slots, which can then be set one by one; auto: preset standard with automatic true",
       .before_others = true},
      {.name = "algorithm",
       .binding = ChoiceSlot{kAlgorithms,
                             [](const ConfigurationBuilder& builder) { return int(builder.radar.fidelity.algorithm); },
                             [](ConfigurationBuilder& builder, int index) {
                               builder.radar.fidelity.algorithm = radar::Algorithm(index);
                             }},
       .purpose = "reference: simple and exact; the tests compare the other algorithms with it"},
      {.name = "earth",
       .binding = ChoiceSlot{
           kEarthModels, [](const ConfigurationBuilder& builder) { return int(builder.radar.fidelity.earth); },
           [](ConfigurationBuilder& builder, int index) { builder.radar.fidelity.earth = radar::EarthModel(index); }},
       .purpose = "shape of the earth"},
      {.name = "earthRadiusFactor",
       .lowest = 0.5,
       .highest = 10,
       .binding = NumberSlot{YARS_FIELD(radar.fidelity.earth_radius_factor)},
       .purpose = "effective earth radius factor for refraction; 1 = no refraction; when omitted, the refractivity of "
                  "the atmosphere bends the rays"},
      {.name = "samples",
       .lowest = values::ScanRequest::samples.low,
       .highest = values::ScanRequest::samples.high,
       .binding = IntegerSlot{YARS_FIELD(radar.fidelity.samples)},
       .purpose = values::ScanRequest::samples.purpose},
      {.name = "geodesicKnots",
       .lowest = 0,
       .highest = 9,
       .binding = IntegerSlot{YARS_FIELD(radar.fidelity.geodesic_knots)},
       .purpose = "number of exact positions on the geodesic of a sweep (1 counts as 2); the others are interpolated; "
                  "with 5 or more, a series accurate to 1 mm replaces the interpolation where possible; 0: all exact"},
      {.name = "interpolation",
       .binding =
           ChoiceSlot{kInterpolations,
                      [](const ConfigurationBuilder& builder) { return int(builder.radar.fidelity.interpolation); },
                      [](ConfigurationBuilder& builder, int index) {
                        builder.radar.fidelity.interpolation = radar::Interpolation(index);
                      }},
       .purpose = "interpolation between posts of the terrain"},
      {.name = "postsPerSample",
       .lowest = 0,
       .highest = 1000,
       .binding = NumberSlot{YARS_FIELD(radar.fidelity.posts_per_sample)},
       .purpose = "terrain with more posts per sample is read from a coarser level; 0 = always the finest"},
      {.name = "subBeams",
       .lowest = 1,
       .highest = radar::kMaxSubBeams,
       .binding = IntegerSlot{YARS_FIELD(radar.fidelity.sub_beams)},
       .purpose = "rays across the beam in azimuth, which successive sweeps share; 1 = a ray for each sweep"},
      flag("automatic", YARS_FIELD(radar.fidelity.automatic),
           "true: a radar-model in a session uses the finest preset with a load within coreShare"),
      {.name = "coreShare",
       .lowest = 0.001,
       .highest = 1,
       .binding = NumberSlot{YARS_FIELD(radar.fidelity.core_share)},
       .purpose = "maximum load as a fraction of a CPU core, for automatic"},
      flag("slantRange", YARS_FIELD(radar.fidelity.slant_range),
           "true: samples are equidistant in slant range; false: in ground range"),
      {.name = "crossTrackSlope",
       .binding = BooleanSlot{},
       .purpose = "incidence angle includes the slope across the sweep",
       .instead = "land returns by its area normal to the ray, whatever the slope across the sweep"},
      flag("noise", YARS_FIELD(radar.fidelity.noise),
           "random fluctuation: of sweeps by speckle and texture, of patch maps by speckle, of movers by their echo"),
      flag("azimuthSmear", YARS_FIELD(radar.fidelity.azimuth_smear), "smear over three sweeps"),
      flag("pulseSmear", YARS_FIELD(radar.fidelity.pulse_smear), "smear over the pulse length"),
      {.name = "beam",
       .binding = ChoiceSlot{
           kBeams, [](const ConfigurationBuilder& builder) { return int(builder.radar.fidelity.beam); },
           [](ConfigurationBuilder& builder, int index) { builder.radar.fidelity.beam = radar::BeamPattern(index); }},
       .purpose = "beam pattern in elevation; two-way gain below its centre: cosecant-squared csc^2, mapping csc^4 "
                  "(one-way csc^2)"}};
}

// Slots of patch maps.
std::vector<SlotSchema> map_fidelity_slots() {
  return {
      {.name = "mapSize",
       .lowest = values::PatchRequest::size.low,
       .highest = values::PatchRequest::size.high,
       .binding = IntegerSlot{YARS_FIELD(radar.fidelity.map_size)},
       .purpose = "pixels along the edge of a patch map; the resolution remains 1/480 of the window; at most 1024 in a "
                  "session and with the algorithm reference"},
      {.name = "mapOversampling",
       .lowest = 1,
       .highest = 4,
       .binding = IntegerSlot{YARS_FIELD(radar.fidelity.map_oversampling)},
       .purpose = "cells of the polar grid per pixel of a patch map, in range and in azimuth"},
      flag("mapLayover", YARS_FIELD(radar.fidelity.map_layover),
           "true: slant range geometry with layover; false: orthographic"),
      flag("mapResponse", YARS_FIELD(radar.fidelity.map_response), "impulse response with its sidelobes"),
      flag("mapDetail", YARS_FIELD(radar.fidelity.map_detail), "synthetic texture finer than the posts"),
      flag("mapDoubleBounce", YARS_FIELD(radar.fidelity.map_double_bounce), "double bounce between walls and ground"),
      {.name = "mapNoise",
       .lowest = 0,
       .highest = 1,
       .binding = NumberSlot{YARS_FIELD(radar.fidelity.map_noise)},
       .purpose = "random fraction of the brightness of patch maps of algorithm report-1996"},
      flag("mapSmoothGround", YARS_FIELD(radar.fidelity.map_smooth_ground),
           "true: ground of patch maps is smooth between posts more than three pixels apart; false: facets"),
      flag("diffraction", YARS_FIELD(radar.fidelity.diffraction),
           "edges bend rays into shadows; with the algorithm reference only"),
      flag("seaLobes", YARS_FIELD(radar.fidelity.sea_lobes),
           "movers and scenes over the sea: the direct ray and the one that the sea reflects interfere")};
}

std::vector<SlotSchema> receiver_slots() {
  return {number_slot("frequency", "GHz", 1, 40, {YARS_FIELD(radar.receiver.frequency_ghz)}, "carrier frequency"),
          number_slot("stcExponent", "", 0, 6, {YARS_FIELD(radar.receiver.stc_exponent)},
                      "sensitivity time control: exponent n of (slant range / 40 NM)^n; left out: flat land is even in "
                      "range (mapping 0, cosecant-squared 2, other beams 3)"),
          number_slot("dynamicRange", "dB", 10, 120, {YARS_FIELD(radar.receiver.dynamic_range_db)},
                      "range of the power from black to white"),
          number_slot("gainStep", "dB", 0, 40, {YARS_FIELD(radar.receiver.gain_step_db)},
                      "loss per step of GAIN, from 3 down to 0"),
          number_slot("landGamma", "dB", -60, 20, {YARS_FIELD(radar.receiver.land_gamma_db)},
                      "gamma of land without culture: sigma0 = gamma sin(grazing angle)"),
          flag("automaticGain", YARS_FIELD(radar.receiver.automatic_gain),
               "true: level land at half the selected range has one brightness from every altitude; false: power in "
               "units of full scale is drawn")};
}

std::vector<SlotSchema> high_resolution_slots() {
  return {
      {.name = "looks",
       .lowest = values::PatchRequest::looks.low,
       .highest = values::PatchRequest::looks.high,
       .binding = ListSlot{YARS_FIELD(radar.high_resolution.looks), 2, 2, Order::ascending},
       .purpose = "independent looks that a map averages at ML1 and ML2"},
      number_slot("broadening", "", 1, 3, {YARS_FIELD(radar.high_resolution.broadening)},
                  "widening of the impulse response by its weighting; the formation time is proportional to it"),
      number_slot("sidelobes", "dB", -60, -13, {YARS_FIELD(radar.high_resolution.sidelobe_db)},
                  "sidelobes of the impulse response, relative to its peak"),
      number_slot("formationCap", "s", 0.1, 600, {YARS_FIELD(radar.high_resolution.max_formation_time_s)},
                  "maximum formation time of a map"),
      number_slot("blindZone", "deg", 0, 45, {YARS_FIELD(radar.high_resolution.blind_zone_deg)},
                  "half width of the blind zone, on either side of the ground track"),
      number_slot("sectorTime", "s", 0.5, 120, {YARS_FIELD(radar.high_resolution.sector_time_s)},
                  "time of an HRM PPI scan of FULL width; other widths in proportion"),
      number_slot("dwell", "s", 0.01, 10, {YARS_FIELD(radar.high_resolution.dwell_s)},
                  "dwell of the HRM PPI on each direction; it sets the resolution"),
      number_slot("sectorStep", "deg", 0.02, 5, {YARS_FIELD(radar.high_resolution.sector_step_deg)},
                  "azimuth between sweeps of the HRM PPI"),
      number_slot("dynamicRange", "dB", 10, 120, {YARS_FIELD(radar.high_resolution.dynamic_range_db)},
                  "range of the power from black to white"),
      number_slot("brightestGamma", "dB", -40, 60, {YARS_FIELD(radar.high_resolution.brightest_gamma_db)},
                  "gamma of level ground that is drawn white"),
      number_slot("noiseGamma", "dB", -120, 20, {YARS_FIELD(radar.high_resolution.noise_gamma_db)},
                  "gamma of level ground with a return equal to thermal noise at 20 NM, window 0.67 NM"),
      number_slot(
          "doubleBounce", "dB", -60, 40, {YARS_FIELD(radar.high_resolution.double_bounce_db)},
          "return of the double bounce at the foot of a wall, relative to what the cardinal effect adds to the wall"),
      {.name = "plainMaterial",
       .lowest = 0,
       .highest = radar::kMaterials - 1,
       .binding = IntegerSlot{YARS_FIELD(radar.high_resolution.default_material)},
       .purpose = "surface material code for faces of a scene that have none"},
      number_slot("detailContrast", "", 0, 2, {YARS_FIELD(radar.high_resolution.detail_contrast)},
                  "standard deviation of the natural logarithm of the synthetic detail finer than the posts")};
}

std::vector<SlotSchema> noise_slots() {
  return {number_slot("floor", "dB", -120, 0, {YARS_FIELD(radar.receiver.noise_floor_db)},
                      "thermal noise with the pulse of the 40 NM range, relative to full scale"),
          {.name = "looks",
           .lowest = 0,
           .highest = values::PatchRequest::looks.high,
           .binding = IntegerSlot{YARS_FIELD(radar.receiver.looks)},
           .purpose = "independent looks averaged in each sample; more looks give less speckle; 0: by the Doppler "
                      "spread of the beam, one near the track and many beside it"},
          {.name = "seed",
           .lowest = 0,
           .highest = 9'007'199'254'740'992.0,  // 2^53: every integer up to it is exact as a double
           .binding = CounterSlot{YARS_FIELD(radar.seed)},
           .purpose = "equal seeds give equal noise"}};
}

}  // namespace

std::vector<FormSchema> model_forms() {
  return {{.name = "Fidelity",
           .purpose = "speed against accuracy",
           .slots = with_base(sweep_fidelity_slots(), map_fidelity_slots())},
          {.name = "HighResolution", .purpose = "high resolution maps", .slots = high_resolution_slots()},
          {.name = "Receiver",
           .purpose = "receiver and ground return",
           .slots = receiver_slots(),
           .check_at_end = check_sea_model},
          {.name = "Noise", .purpose = "thermal noise and speckle", .slots = noise_slots()}};
}

}  // namespace yars::config
