// Patch maps of the host that has the radar model.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "databuffer/session/picture_pool.hpp"
#include "gateway/exchange/model_exchange.hpp"
#include "tests/gateway/exchange/two_hosts.hpp"

namespace yars::gateway {
namespace {

using databuffer::Role;
using testing::bit;

class MapExchangeTest : public testing::TwoHosts {
 protected:
  databuffer::PatchMap map(std::uint64_t id) {
    databuffer::PatchMap made{};
    made.id = id;
    made.latitude_deg = made.apex_latitude_deg = 36.6;
    made.longitude_deg = made.apex_longitude_deg = -121.9;
    made.window_nm = 4.7;
    made.distance_m = 33'000.0;
    made.resolution_m = 20.0;
    made.size = 8;
    made.hash = databuffer::map_hash(made, pixels_);
    return made;
  }
  void receive(const std::string& host, const databuffer::PatchMap& record) {
    auto sample = from<yars_net_PatchMapSample>(host);
    sample.id = record.id;
    copy_record(sample.map, record);
    exchange_.receive(context_, sample);
    for (std::uint32_t row = 0; row < record.size; ++row) {
      auto line = from<yars_net_PatchRowSample>(host);
      line.id = record.id;
      line.row = row;
      line.length = record.size;
      std::copy_n(pixels_.begin() + row * record.size, record.size, line.pixels);
      exchange_.receive(context_, line);
    }
    exchange_.publish(context_);
  }
  bool is_published(std::uint64_t id) {
    databuffer::PatchMap found{};
    return databuffer::read_patch(layout(), id, found);
  }
  std::vector<std::uint8_t> pixels_ = std::vector<std::uint8_t>(64, 7);
  MapExchange exchange_{500};
};

TEST_F(MapExchangeTest, AMapIsPublishedWhenItIsWhole) {
  announce("beta", bit(Role::radar_model));
  receive("beta", map(3));
  databuffer::PatchMap found{};
  std::vector<std::uint8_t> pixels;
  ASSERT_TRUE(databuffer::read_patch(layout(), 3, found, pixels));
  EXPECT_EQ(pixels, pixels_);
}

TEST_F(MapExchangeTest, MapsOfAHostWithoutTheRoleAreNotPublished) {
  announce("beta", bit(Role::radar_model));
  announce("gamma", 0);
  receive("gamma", map(3));
  EXPECT_FALSE(is_published(3));
}

TEST_F(MapExchangeTest, InvalidMapsAreRefused) {
  announce("beta", bit(Role::radar_model));
  auto bad = map(3);
  bad.size = databuffer::kMaxPatchPixels + 1;
  auto sample = from<yars_net_PatchMapSample>("beta");
  sample.id = 3;
  copy_record(sample.map, bad);
  exchange_.receive(context_, sample);
  EXPECT_EQ(refusals(), 1u);
  bad = map(3);
  bad.hash ^= 1;
  receive("beta", bad);
  EXPECT_FALSE(is_published(3));
  auto other = from<yars_net_PatchMapSample>("beta");
  other.id = 4;
  copy_record(other.map, map(3));
  exchange_.receive(context_, other);
  EXPECT_EQ(refusals(), 2u) << "the sample has another id than the map";
  auto row = from<yars_net_PatchRowSample>("beta");
  row.length = 1025;
  exchange_.receive(context_, row);
  EXPECT_EQ(refusals(), 3u);
}

TEST_F(MapExchangeTest, AMapOfThePartThatYieldedIsReplaced) {
  std::vector<std::uint8_t> mine(64, 9);
  auto own = map(3);
  own.hash = databuffer::map_hash(own, mine);
  ASSERT_TRUE(databuffer::publish_patch(session_.layout(), own, mine, {}));
  announce("beta", bit(Role::radar_model));
  receive("beta", map(3));
  databuffer::PatchMap found{};
  ASSERT_TRUE(databuffer::read_patch(layout(), 3, found));
  EXPECT_EQ(found.hash, map(3).hash);
}

}  // namespace
}  // namespace yars::gateway
