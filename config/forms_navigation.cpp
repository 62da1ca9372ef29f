#include "config/field.hpp"
#include "config/forms.hpp"
#include "lib/radar/velocity_beams.hpp"

namespace yars::config {

namespace {

std::optional<Complaint> check_beams(const Draft& draft) {
  const radar::NavigationConfiguration& navigation = draft.radar.navigation;
  const std::size_t azimuths = navigation.beam_azimuths_deg.size();
  const std::size_t depressions = navigation.beam_depressions_deg.size();
  if (azimuths != depressions)
    return Complaint{"beamDepressions", "as many as beamAzimuths, " + std::to_string(azimuths),
                     std::to_string(depressions)};
  if (radar::horizontal_dilution(navigation)) return std::nullopt;
  return Complaint{"beamAzimuths", "beams that do not all lie in one plane", "a plane of beams"};
}

}  // namespace

std::vector<FormSchema> navigation_forms() {
  constexpr double kMostError_ft = 600'000.0;
  constexpr double kMostDrift_fps = 1'000.0;
  const auto feet = [](double& (*of)(Draft&)) { return NumberSlot{of, geo::kMetresPerFoot}; };
  return {
      {.name = "Navigation",
       .purpose = "what the navigators have wrong, and how the radar puts it right",
       .slots = {number_slot("errorNorth", "ft", -kMostError_ft, kMostError_ft,
                             feet(YARS_FIELD(radar.navigation.error_north_m)),
                             "of both navigators' position when the session begins"),
                 number_slot("errorEast", "ft", -kMostError_ft, kMostError_ft,
                             feet(YARS_FIELD(radar.navigation.error_east_m)), "as errorNorth, to the east"),
                 number_slot("driftNorth", "ft/s", -kMostDrift_fps, kMostDrift_fps,
                             feet(YARS_FIELD(radar.navigation.drift_north_mps)),
                             "of both navigators' velocity when the session begins; their position drifts with it"),
                 number_slot("driftEast", "ft/s", -kMostDrift_fps, kMostDrift_fps,
                             feet(YARS_FIELD(radar.navigation.drift_east_mps)), "as driftNorth, to the east"),
                 number_slot("driftDown", "ft/s", -kMostDrift_fps, kMostDrift_fps,
                             feet(YARS_FIELD(radar.navigation.drift_down_mps)), "as driftNorth, downward"),
                 number_slot("velocityWalk", "ft/s", 0, kMostDrift_fps, feet(YARS_FIELD(radar.navigation.walk_mps)),
                             "random walk of the velocity's error: standard deviation after an hour"),
                 number_slot("updateValidity", "s", 1, 3600, {YARS_FIELD(radar.navigation.update_validity_s)},
                             "how long a cursor placed serves an INS update"),
                 number_slot("velocityPeriod", "s", 5, 3600, {YARS_FIELD(radar.navigation.velocity_period_s)},
                             "between the velocity updates of IPVU and PVU"),
                 number_slot("velocityNoise", "ft/s", 0, 100, feet(YARS_FIELD(radar.navigation.velocity_noise_mps)),
                             "standard deviation of a horizontal component that the radar measures"),
                 {.name = "magneticModel",
                  .binding = TextSlot{YARS_FIELD(radar.navigation.magnetic_model)},
                  .purpose = "model of the earth's field for the variation, where its data is installed; left out: the "
                             "World Magnetic Model, else magneticVariation"},
                 {.name = "magneticFolder",
                  .binding = PathSlot{YARS_FIELD(radar.navigation.magnetic_folder)},
                  .purpose = "where the data of that model lies; left out: the system's place"},
                 number_slot("magneticYear", "a", 1900, 2100, {YARS_FIELD(radar.navigation.magnetic_year)},
                             "date for that model"),
                 {.name = "beamAzimuths",
                  .unit = "deg",
                  .lowest = -90,
                  .highest = 90,
                  .binding = ListSlot{YARS_FIELD(radar.navigation.beam_azimuths_deg), radar::kLeastVelocityBeams,
                                      radar::kMostVelocityBeams, Order::any},
                  .purpose = "of the beams that measure velocity, against the ground track, in their order"},
                 {.name = "beamDepressions",
                  .unit = "deg",
                  .lowest = 1,
                  .highest = 90,
                  .binding = ListSlot{YARS_FIELD(radar.navigation.beam_depressions_deg), radar::kLeastVelocityBeams,
                                      radar::kMostVelocityBeams, Order::any},
                  .purpose = "of the same beams, below the horizon"},
                 number_slot("beamDwell", "s", 0.05, 10, {YARS_FIELD(radar.navigation.beam_dwell_s)},
                             "how long the dish stands on each of them")},
       .check = check_beams}};
}

}  // namespace yars::config
