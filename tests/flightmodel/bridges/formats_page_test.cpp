// Tests of the tables of docs/spec/formats.md#flight-models: packets built by them alone decode to the flight that was
// put into them.
#include "tests/flightmodel/bridges/formats_page.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "flightmodel/bridges/bridge.hpp"

namespace yars::flightmodel::bridges {
namespace {

void expect_motion(const databuffer::Ownship& own, geo::Vector3 north_east_down) {
  EXPECT_NEAR(own.velocity_north_mps, north_east_down.x, 1e-3);
  EXPECT_NEAR(own.velocity_east_mps, north_east_down.y, 1e-3);
  EXPECT_NEAR(own.velocity_down_mps, north_east_down.z, 1e-3);
}

void expect_attitude(const databuffer::Ownship& own, double heading_deg, double pitch_deg, double roll_deg) {
  EXPECT_NEAR(own.heading_deg, heading_deg, 1e-4);
  EXPECT_NEAR(own.pitch_deg, pitch_deg, 1e-4);
  EXPECT_NEAR(own.roll_deg, roll_deg, 1e-4);
}

TEST(FormatsPage, APacketByTheTableOfFlightGearDecodes) {
  for (const auto& [version, bytes] : {std::pair{24, 408}, std::pair{25, 552}}) {
    PacketByPage packet("flightgear", static_cast<std::size_t>(bytes), std::endian::big);
    packet.set("version", version);
    packet.set("longitude", -121.9);
    packet.set("latitude", 36.6);
    packet.set("altitude", 4572.0);
    for (const auto& [name, value] :
         {std::pair{"roll rate", 1.0}, std::pair{"pitch rate", 0.5}, std::pair{"heading rate", -2.0},
          std::pair{"roll", -15.0}, std::pair{"pitch", 2.5}, std::pair{"heading", 80.0},
          std::pair{"velocity north", 40.0}, std::pair{"velocity east", 230.0}, std::pair{"velocity down", -5.0}})
      packet.set(name, value);
    EXPECT_TRUE(packet.is_complete());
    const auto sample = decode_flightgear(packet.bytes());
    ASSERT_TRUE(sample) << sample.error().message();
    EXPECT_NEAR(sample->ownship.latitude_deg, 36.6, 1e-12);
    EXPECT_NEAR(sample->ownship.longitude_deg, -121.9, 1e-12);
    EXPECT_EQ(sample->ownship.altitude_msl_m, 4572.0);
    expect_attitude(sample->ownship, 80.0, 2.5, -15.0);
    expect_motion(sample->ownship, {40.0, 230.0, -5.0});
    EXPECT_NEAR(sample->rates->roll_dps, 1.0, 1e-6);
    EXPECT_NEAR(sample->rates->pitch_dps, 0.5, 1e-6);
    EXPECT_NEAR(sample->rates->heading_dps, -2.0, 1e-6);
  }
}

TEST(FormatsPage, TheColumnsOfJsbsimAreAllThatALineNeeds) {
  const std::vector<TableRow> rows = table_of_formats("jsbsim", "column");
  ASSERT_EQ(rows.size(), kJsbsimValues);
  std::string labels = "<LABELS>";
  for (const TableRow& row : rows) labels += "," + row[0];
  const auto columns = parse_jsbsim_labels(labels);
  ASSERT_TRUE(columns) << columns.error().message();
  const auto state = parse_jsbsim_line(*columns, "7,36.6,-121.9,15000,-15,2.5,80,100,200,-10");
  ASSERT_TRUE(state) << state.error().message();
  EXPECT_EQ(state->time.seconds(), 7.0);
  EXPECT_EQ(state->sample.ownship.latitude_deg, 36.6);
  EXPECT_EQ(state->sample.ownship.longitude_deg, -121.9);
  EXPECT_NEAR(state->sample.ownship.altitude_msl_m, 4572.0, 1e-9);
  expect_attitude(state->sample.ownship, 80.0, 2.5, -15.0);
  expect_motion(state->sample.ownship, {30.48, 60.96, -3.048});
}

// The aircraft is at X-Plane's reference point, where its axes are east, up and south.
TEST(FormatsPage, XPlanesDatarefsAreThoseThatAreRequested) {
  const std::vector<TableRow> rows = table_of_formats("xplane", "number");
  ASSERT_EQ(rows.size(), kXplaneDatarefs);
  const std::map<std::string, float> flight{{"latitude", 36.5F},
                                            {"longitude", -122.0F},
                                            {"elevation", 3000.0F},
                                            {"local_vx", 100.0F},
                                            {"local_vy", 2.0F},
                                            {"local_vz", -200.0F},
                                            {"lat_ref", 36.5F},
                                            {"lon_ref", -122.0F},
                                            {"true_psi", 26.5F},
                                            {"true_theta", 0.0F},
                                            {"true_phi", 0.0F},
                                            {"P", 3.0F},
                                            {"Q", 2.0F},
                                            {"R", 1.0F}};
  PacketBytes reply(5 + 8 * rows.size(), std::byte{0});
  const PacketBytes mark = bytes_of("RREF,");
  std::copy(mark.begin(), mark.end(), reply.begin());
  for (std::size_t number = 0; number < rows.size(); ++number) {
    ASSERT_EQ(rows[number][0], std::to_string(number));
    ASSERT_EQ(rows[number][1], kXplaneNames[number]);
    const std::string name = rows[number][1].substr(rows[number][1].find_last_of('/') + 1);
    put(reply, 5 + 8 * number, static_cast<std::uint32_t>(number), std::endian::little);
    put(reply, 9 + 8 * number, flight.at(name), std::endian::little);
  }
  XplaneBridge bridge;
  const auto sample = bridge.receive(reply, {});
  ASSERT_TRUE(sample && *sample);
  EXPECT_EQ((*sample)->ownship.altitude_msl_m, 3000.0);
  expect_attitude((*sample)->ownship, 26.5, 0.0, 0.0);
  expect_motion((*sample)->ownship, {200.0, 100.0, -2.0});
  EXPECT_NEAR((*sample)->rates->roll_dps, 3.0, 1e-6);
  EXPECT_NEAR((*sample)->rates->heading_dps, 1.0, 1e-6);
}

// At 0 N 0 E the Earth's axes x, y, z point up, east and north. Psi 90 deg turns the nose east, phi -90 deg the keel
// down.
TEST(FormatsPage, APduByTheTableOfDisDecodes) {
  constexpr double kEquator_m = 6'378'137.0;
  PacketByPage packet("dis", 144, std::endian::big);
  for (const auto& [name, value] : {std::pair{"version", 6.0},
                                    std::pair{"exercise", 5.0},
                                    std::pair{"type", 1.0},
                                    std::pair{"time stamp", 100.0},
                                    std::pair{"length", 144.0},
                                    std::pair{"site", 1.0},
                                    std::pair{"application", 2.0},
                                    std::pair{"entity", 3.0},
                                    std::pair{"parameters", 0.0},
                                    std::pair{"kind", 1.0},
                                    std::pair{"domain", 2.0},
                                    std::pair{"location x", kEquator_m + 4000.0},
                                    std::pair{"location y", 0.0},
                                    std::pair{"location z", 0.0},
                                    std::pair{"velocity x", 5.0},
                                    std::pair{"velocity y", 230.0},
                                    std::pair{"velocity z", 40.0},
                                    std::pair{"psi", 90.0},
                                    std::pair{"theta", 0.0},
                                    std::pair{"phi", -90.0},
                                    std::pair{"appearance", 2097152.0},
                                    std::pair{"algorithm", 4.0},
                                    std::pair{"acceleration x", 1.0},
                                    std::pair{"acceleration y", 2.0},
                                    std::pair{"acceleration z", 3.0},
                                    std::pair{"rate x", 4.0},
                                    std::pair{"rate y", 0.0},
                                    std::pair{"rate z", 0.0}})
    packet.set(name, value);
  EXPECT_TRUE(packet.is_complete());
  const auto state = decode_entity_state(packet.bytes(), no_geoid());
  ASSERT_TRUE(state) << state.error().message();
  EXPECT_EQ(text_of(state->id), "1,2,3");
  EXPECT_EQ(state->kind, EntityKind::platform);
  EXPECT_EQ(state->domain, EntityDomain::air);
  EXPECT_NEAR(state->stamp.value().seconds(), 100.0, 1e-5);
  EXPECT_EQ(state->exercise, 5);
  EXPECT_TRUE(state->frozen);
  EXPECT_FALSE(state->deactivated);
  EXPECT_NEAR(state->sample.ownship.latitude_deg, 0.0, 1e-9);
  EXPECT_NEAR(state->sample.ownship.longitude_deg, 0.0, 1e-9);
  EXPECT_NEAR(state->sample.ownship.altitude_msl_m, 4000.0, 1e-3);
  EXPECT_NEAR(state->sample.ownship.heading_deg, 90.0, 1e-4);
  EXPECT_NEAR(state->sample.ownship.pitch_deg, 0.0, 1e-4);
  expect_motion(state->sample.ownship, {40.0, 230.0, -5.0});
  EXPECT_NEAR(state->sample.acceleration_mps2->x, 3.0, 1e-5);
  EXPECT_NEAR(state->sample.acceleration_mps2->y, 2.0, 1e-5);
  EXPECT_NEAR(state->sample.acceleration_mps2->z, -1.0, 1e-5);
  EXPECT_NEAR(state->sample.rates->roll_dps, 4.0, 1e-5);
}

}  // namespace
}  // namespace yars::flightmodel::bridges
