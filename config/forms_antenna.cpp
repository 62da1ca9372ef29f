#include <cmath>

#include "config/field.hpp"
#include "config/forms.hpp"
#include "config/value.hpp"

namespace yars::config {
namespace {

std::optional<Complaint> check_position(const Draft& draft) {
  const radar::AntennaConfiguration& antenna = draft.radar.antenna;
  const double azimuth_deg = antenna.circular_scan ? 180.0 : antenna.azimuth_limit_deg;
  if (std::abs(antenna.start_azimuth_deg) <= azimuth_deg &&
      std::abs(antenna.start_elevation_deg) <= antenna.elevation_limit_deg) {
    return std::nullopt;
  }
  return Complaint{"position",
                   "a position within the gimbal, " + number_text(azimuth_deg) + " and " +
                       number_text(antenna.elevation_limit_deg) + " deg either way",
                   number_text(antenna.start_azimuth_deg) + " and " + number_text(antenna.start_elevation_deg)};
}

}  // namespace

std::vector<FormSchema> antenna_forms() {
  FormSchema servo{.name = "AntennaServo",
                   .purpose = "the dish, its gimbal and its servo",
                   .slots = {{.name = "azimuthLimits",
                              .unit = "deg",
                              .lowest = 1,
                              .highest = 180,
                              .binding = SymmetricSlot{YARS_FIELD(radar.antenna.azimuth_limit_deg)},
                              .purpose = "gimbal, left and right of the nose"},
                             {.name = "elevationLimits",
                              .unit = "deg",
                              .lowest = 1,
                              .highest = 90,
                              .binding = SymmetricSlot{YARS_FIELD(radar.antenna.elevation_limit_deg)},
                              .purpose = "gimbal, down and up"},
                             {.name = "maxRates",
                              .unit = "deg/s",
                              .lowest = 1,
                              .highest = 1000,
                              .binding = PairSlot{YARS_FIELD(radar.antenna.azimuth_rate_dps),
                                                  YARS_FIELD(radar.antenna.elevation_rate_dps)},
                              .purpose = "in azimuth and elevation"},
                             {.name = "beamWidth",
                              .unit = "deg",
                              .lowest = 0.1,
                              .highest = 30,
                              .binding = PairSlot{YARS_FIELD(radar.antenna.azimuth_beamwidth_deg),
                                                  YARS_FIELD(radar.antenna.elevation_beamwidth_deg)},
                              .purpose = "two-way 3 dB, in azimuth and elevation"},
                             {.name = "position",
                              .unit = "deg",
                              .lowest = -180,
                              .highest = 180,
                              .binding = PairSlot{YARS_FIELD(radar.antenna.start_azimuth_deg),
                                                  YARS_FIELD(radar.antenna.start_elevation_deg)},
                              .purpose = "azimuth and elevation at start; the elevation commanded at power-up"},
                             {.name = "tolerance",
                              .unit = "deg",
                              .lowest = 0.001,
                              .highest = 5,
                              .binding = NumberSlot{YARS_FIELD(radar.antenna.tolerance_deg)},
                              .purpose = "a commanded position counts as reached within this"},
                             {.name = "driftLimit",
                              .unit = "deg",
                              .lowest = 0,
                              .highest = 60,
                              .binding = NumberSlot{YARS_FIELD(radar.antenna.drift_limit_deg)},
                              .purpose = "the scan follows the ground track up to this drift"}},
                   .check = check_position};
  FormSchema scan{
      .name = "RbmAntenna",
      .purpose = "the scan of the real beam map",
      .slots = {{.name = "scanWidths",
                 .unit = "deg",
                 .lowest = 1,
                 .highest = 360,
                 .binding = ListSlot{YARS_FIELD(radar.scan_widths_deg), 3, 3, Order::descending},
                 .purpose = "FULL, HALF, QTR"},
                {.name = "scanBars",
                 .lowest = 1,
                 .highest = 4,
                 .binding = FirstSlot{YARS_FIELD(radar.antenna.scan_bars)},
                 .purpose = "elevation bars of the real beam map and of beacons; of a list of patterns the first"},
                {.name = "circularScan",
                 .binding = BooleanSlot{YARS_FIELD(radar.antenna.circular_scan)},
                 .purpose = "the dish goes round instead of back and forth"}}};
  return {servo, scan};
}

}  // namespace yars::config
