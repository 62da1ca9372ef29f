// The picture that is kept and changed, against the same picture drawn from all sweeps, over flights: straight, in
// turns, at all ranges, frozen, in other modes, with maps, with lost sweeps, and longer than the store of sweeps.
// With YARS_PICTURES=FOLDER in the environment, two of the pictures are also written to that folder.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <string>

#include "display/gl/context.hpp"
#include "display/gl/display.hpp"
#include "lib/radar/configuration.hpp"
#include "tests/display/gl/made_up_map.hpp"
#include "tests/display/gl/made_up_sweeps.hpp"
#include "tests/display/symbology/display_states.hpp"

namespace yars::display::gl {
namespace {

using radar::Mode;

constexpr double kStep_deg = 0.55;  // azimuth from sweep to sweep
constexpr double kStep_s = 0.005;
constexpr int kSize = 240;

// A radar in flight that scans to and fro over made-up ground: fields of 2 deg x 1/16 range about the first apex.
class Flight {
 public:
  double speed_mps = 250.0, turn_dps = 0.0, range_nm = 40.0, half_width_deg = 50.0;
  Mode mode = Mode::rbm;
  DisplayInput input = display::testing::operating(Mode::rbm, 40.0);

  geo::GeoPoint position = display::testing::kAircraftPosition;
  double track_deg = 30.0;

  // The next sweep; the aircraft flies on.
  databuffer::Sweep sweep() {
    position =
        geo::geodesic_direct(position, geo::Bearing::degrees(track_deg), geo::Length::metres(speed_mps * kStep_s));
    track_deg += turn_dps * kStep_s;
    right_deg_ += direction_ * kStep_deg;
    const bool end = std::abs(right_deg_ + direction_ * kStep_deg) > half_width_deg;
    const double left_deg = track_deg + right_deg_ - kStep_deg / 2.0;
    auto sweep = display::testing::blank_sweep(position, left_deg, left_deg + kStep_deg,
                                               range_nm * geo::kMetresPerNauticalMile, 480);
    sweep.mode = static_cast<std::uint8_t>(mode);
    sweep.scan = scan_;
    sweep.ground_track_deg = track_deg;
    sweep.flags = end ? databuffer::kSweepScanEnd : 0;
    for (std::uint32_t i = 0; i < sweep.samples; ++i) sweep.video[i] = ground_at(left_deg, i);
    if (end) {
      ++scan_;
      direction_ = -direction_;
    }
    return sweep;
  }

  // Input of the picture now.
  const DisplayInput& now() {
    input.state.mode = static_cast<std::uint8_t>(mode);
    input.state.range_nm = range_nm;
    input.ownship.latitude_deg = position.latitude_deg;
    input.ownship.longitude_deg = position.longitude_deg;
    input.ownship.velocity_north_mps = 250.0 * std::cos(track_deg * geo::kRadiansPerDegree);
    input.ownship.velocity_east_mps = 250.0 * std::sin(track_deg * geo::kRadiansPerDegree);
    input.ownship.heading_deg = track_deg;
    input.model.antenna_azimuth_deg = right_deg_;
    return input;
  }

 private:
  std::uint8_t ground_at(double left_deg, std::uint32_t sample) const {
    const geo::GeodesicInverse flown = geo::geodesic_inverse(display::testing::kAircraftPosition, position);
    const double range_m = range_nm * geo::kMetresPerNauticalMile * (sample + 0.5) / 480.0;
    const double angle = left_deg * geo::kRadiansPerDegree, from = flown.azimuth_at_start.radians();
    const double east = flown.distance.metres() * std::sin(from) + range_m * std::sin(angle);
    const double north = flown.distance.metres() * std::cos(from) + range_m * std::cos(angle);
    const double field_m = range_nm * geo::kMetresPerNauticalMile / 10.0;
    const int x = static_cast<int>(std::floor(east / field_m)), y = static_cast<int>(std::floor(north / field_m));
    return static_cast<std::uint8_t>(30 + 60 * ((x + 2 * y) & 3));
  }

  double right_deg_ = 0.0, direction_ = 1.0;
  std::uint32_t scan_ = 1;
};

struct Difference {
  int pixels = 0;   // pixels that differ
  int strange = 0;  // pixels of the kept picture darker or brighter than all within a pixel of them in the other
};

Difference difference(const imageio::Image& kept, const imageio::Image& other) {
  constexpr int kRounding = 2;
  Difference found;
  const auto at = [&](const imageio::Image& image, int x, int y) -> int {
    return image.pixels[(static_cast<std::size_t>(y) * kSize + static_cast<std::size_t>(x)) * 3 + 1];
  };
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      if (at(kept, x, y) == at(other, x, y)) continue;
      ++found.pixels;
      int low = 255, high = 0;
      for (int v = std::max(y - 1, 0); v <= std::min(y + 1, kSize - 1); ++v) {
        for (int u = std::max(x - 1, 0); u <= std::min(x + 1, kSize - 1); ++u) {
          low = std::min(low, at(other, u, v));
          high = std::max(high, at(other, u, v));
        }
      }
      found.strange += at(kept, x, y) < low - kRounding || at(kept, x, y) > high + kRounding ? 1 : 0;
    }
  }
  return found;
}

class KeptPicture : public ::testing::Test {
 protected:
  void SetUp() override {
    auto context = open_headless();
    if (!context) GTEST_SKIP() << "no OpenGL without a display: " << context.error().message();
    context_ = std::move(*context);
    kept_.emplace(radar::RadarConfiguration(), kSize);
    whole_.emplace(radar::RadarConfiguration(), kSize);
    add_map_ = display::testing::made_up_ground(kSize);
  }

  // Flies for this number of sweeps, three to a picture. `lost` is true for the numbers of the sweeps that are lost.
  // Compares every `every`-th picture with a picture drawn from all sweeps.
  void fly(int sweeps, int every, const std::function<bool(int)>& lost = [](int) { return false; }) {
    for (int i = 0; i < sweeps; ++i) {
      const databuffer::Sweep sweep = flight_.sweep();
      if (!lost(i)) {
        kept_->add(sweep);
        whole_->add(sweep);
      }
      if (i % 3 == 2) draw(pictures_++ % every == 0);
    }
  }

  void draw(bool compares) {
    const DisplayInput& input = flight_.now();
    redrawn_ += kept_->draw(input) && kept_->damage().is_all() ? 1 : 0;
    if (!compares) return;
    whole_->resize(kSize);  // nothing is kept
    ASSERT_TRUE(whole_->draw(input));
    const Difference found = difference(kept_->read(), whole_->read());
    most_.pixels = std::max(most_.pixels, found.pixels);
    most_.strange = std::max(most_.strange, found.strange);
    ++compared_;
  }

  // Starts a count. The result is the greatest difference since.
  void begin() {
    most_ = {};
    redrawn_ = compared_ = 0;
  }

  void show_map(std::uint64_t id) {
    flight_.mode = Mode::patch;
    display::testing::put_map(flight_.input, 60.0, 20.0, 4.7);
    flight_.input.map.id = flight_.input.state.map_newest = flight_.input.state.map_shown = id;
    flight_.input.map.size = kSize;
    for (auto* radar_display : {&*kept_, &*whole_}) radar_display->add(flight_.input.map, add_map_);
  }

  std::unique_ptr<Context> context_;
  std::optional<Display> kept_, whole_;
  std::vector<std::uint8_t> add_map_;
  Flight flight_;
  Difference most_;
  int redrawn_ = 0, compared_ = 0, pictures_ = 0;
};

// Nothing moves: new sweeps and symbols drawn into the kept picture give the same pixels as everything drawn again.
// 3000 sweeps are more than the store holds.
TEST_F(KeptPicture, OfAHoveringAircraftIsEqualPixelByPixel) {
  flight_.speed_mps = 0.0;
  begin();
  fly(3000, 19);
  EXPECT_EQ(most_.pixels, 0);
  EXPECT_LT(redrawn_, 25) << "all was drawn again in too many of the 1000 pictures";
}

TEST_F(KeptPicture, FollowsLostSweepsModesRangesFreezeAndMaps) {
  flight_.speed_mps = 0.0;
  begin();
  fly(700, 5, [](int i) { return i % 11 == 3 || (i > 250 && i < 420); });
  EXPECT_EQ(most_.pixels, 0) << "lost sweeps";
  flight_.half_width_deg = 25.0;
  fly(700, 5);
  EXPECT_EQ(most_.pixels, 0) << "a narrower scan";
  flight_.half_width_deg = 50.0;
  for (const double range_nm : {20.0, 80.0, 10.0, 40.0}) {
    flight_.range_nm = range_nm;
    fly(90, 3);
    EXPECT_EQ(most_.pixels, 0) << range_nm << " NM";
  }
  flight_.mode = Mode::beacon;
  fly(60, 3);
  flight_.mode = Mode::rbm;
  fly(60, 3);
  EXPECT_EQ(most_.pixels, 0) << "modes";
  flight_.input.state.brightness = 12;
  draw(true);
  flight_.input.state.contrast = 5;
  draw(true);
  flight_.input.state.power = static_cast<std::uint8_t>(radar::Power::standby);
  draw(true);
  flight_.input.state.power = static_cast<std::uint8_t>(radar::Power::operate);
  draw(true);
  EXPECT_EQ(most_.pixels, 0) << "brightness, contrast, standby";
  flight_.input.model.flags = databuffer::kModelFrozen;
  draw(true);
  flight_.position = display::testing::at(30.0, 3.0);
  draw(true);
  flight_.input.model.flags = 0;
  EXPECT_EQ(most_.pixels, 0) << "frozen";
  for (const std::uint64_t id : {7U, 8U}) {
    show_map(id);
    draw(true);
    flight_.track_deg += 1.0;
    draw(true);
  }
  flight_.mode = Mode::rbm;
  flight_.input.state.map_shown = 0;
  fly(60, 3);
  EXPECT_EQ(most_.pixels, 0) << "maps";
  EXPECT_GT(compared_, 100);
}

// The aircraft moves by whole pixels, one in 0.3 s. The kept picture is scrolled. It differs only where an edge of a
// wedge passes within rounding of a pixel's centre, and in the gaps near the apex where replaced sweeps still show.
TEST_F(KeptPicture, OfAStraightFlightIsScrolledByWholePixels) {
  flight_.range_nm = 10.0;
  flight_.speed_mps = 0.0;
  const auto pixel = geo::Length::metres(flight_.range_nm * geo::kMetresPerNauticalMile / 400.0 * 480.0 / kSize);
  fly(400, 1000);
  begin();
  for (int i = 0; i < 25; ++i) {
    const geo::GeoPoint before = flight_.position;
    flight_.position = geo::geodesic_direct(before, geo::Bearing::degrees(flight_.track_deg), pixel);
    flight_.track_deg = geo::geodesic_inverse(before, flight_.position).azimuth_at_end.degrees();
    fly(60, 7);
  }
  EXPECT_LT(most_.pixels, kSize * kSize / 500);
  EXPECT_LT(most_.strange, 10);
  EXPECT_LT(redrawn_, 75) << "scrolled 25 times, and drawn from all sweeps twice a second";
}

TEST_F(KeptPicture, OfAStraightFlightShowsEachPixelWithinAPixelOfItsPlace) {
  fly(400, 1000);
  begin();
  fly(800, 11);
  EXPECT_LT(most_.strange, kSize * kSize / 500);
}

TEST_F(KeptPicture, OfATurningFlightShowsEachPixelWithinAPixelOfItsPlace) {
  using Turn = std::pair<double, double>;  // deg/s, range [NM]
  for (const auto& [turn_dps, range_nm] : {Turn{0.2, 10.0}, Turn{3.0, 40.0}, Turn{-8.0, 10.0}, Turn{-8.0, 160.0}}) {
    flight_.turn_dps = turn_dps;
    flight_.range_nm = range_nm;
    fly(250, 1000);
    begin();
    fly(210, 5);
    EXPECT_LT(most_.strange, kSize * kSize / 500) << turn_dps << " deg/s at " << range_nm << " NM";
  }
  const char* folder = std::getenv("YARS_PICTURES");
  if (folder == nullptr) return;
  EXPECT_TRUE(imageio::write_png(std::string(folder) + "/kept.png", kept_->read()));
  whole_->resize(kSize);
  whole_->draw(flight_.now());
  EXPECT_TRUE(imageio::write_png(std::string(folder) + "/kept_whole.png", whole_->read()));
}

// Pictures in files: whatever was drawn before, all sweeps are drawn in the present frame.
TEST_F(KeptPicture, IsDrawnFromAllSweepsWhereVideoIsNotKept) {
  kept_->keep_video(false);
  whole_->keep_video(false);
  flight_.turn_dps = 1.0;
  begin();
  fly(600, 9);
  EXPECT_EQ(most_.pixels, 0);
}

}  // namespace
}  // namespace yars::display::gl
