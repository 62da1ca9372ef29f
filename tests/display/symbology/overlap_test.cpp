// The symbology has no forbidden overlap in any radar state. overlap.hpp lists the allowed overlaps.
#include "tests/display/symbology/overlap.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/display/symbology/random_input.hpp"
#include "tests/display/symbology/symbology_checks.hpp"

namespace yars::display {
namespace {

using radar::Mode;
using testing::crowded;
using testing::drawn;
using testing::expect_no_overlap;

constexpr std::array kModes{Mode::rbm, Mode::hrm,        Mode::patch,   Mode::beacon,
                            Mode::pvu, Mode::air_to_air, Mode::ranging, Mode::menu};

TEST(Overlap, ThereIsNoneInAnyModeAtAnyRangeWithAllIndicationsShown) {
  for (const Mode mode : kModes) {
    for (const double range_nm : {4.7, 10.0, 20.0, 40.0, 80.0, 160.0}) {
      const std::string what = std::string(radar::name_of(mode)) + " at " + std::to_string(range_nm);
      expect_no_overlap(drawn(crowded(mode, range_nm)), what);
    }
  }
}

TEST(Overlap, ThereIsNoneInStandby) {
  for (const Mode mode : kModes) {
    DisplayInput input = crowded(mode, 160.0);
    input.state.power = static_cast<std::uint8_t>(radar::Power::standby);
    expect_no_overlap(drawn(input), "standby");
  }
}

TEST(Overlap, ThereIsNoneWithATargetDesignatedAnywhere) {
  for (const Mode mode : {Mode::rbm, Mode::hrm, Mode::beacon}) {
    for (double bearing_deg = -30.0; bearing_deg <= 90.0; bearing_deg += 15.0) {
      for (double range_nm = 2.0; range_nm <= 42.0; range_nm += 4.0) {
        DisplayInput input = crowded(mode, 40.0);
        const geo::GeoPoint position = testing::at(bearing_deg, range_nm);
        testing::put_target(input, position, 45.0, databuffer::SteeringLine::slewing);
        testing::add_point(input, "4.", radar::PointKind::target, position);
        expect_no_overlap(drawn(input), std::to_string(bearing_deg) + " at " + std::to_string(range_nm));
      }
    }
  }
}

// Length of the cursor's arms that is drawn [units]; 36 without a text nearby.
float length_of_cursor(const DrawList& list) {
  float length = 0.0F;
  for (const Segment& line : list.content(Layer::steered).strokes)
    length += std::hypot(line.to.x - line.from.x, line.to.y - line.from.y);
  return length;
}

void put_cursor_on_display(DisplayInput& input, Point at) {
  databuffer::RadarState& state = input.state;
  const geo::GeoPoint position = testing::ground_at(input, at);
  state.flags |= databuffer::kCursorValid;
  state.cursor_latitude_deg = position.latitude_deg;
  state.cursor_longitude_deg = position.longitude_deg;
}

// The pilot moves the cursor over the whole display. Everywhere each readout stays, no text lies over another text or
// over a symbol, and the cursor can be seen.
TEST(Overlap, ThereIsNoneWithTheCursorAnywhereAndNoReadoutVanishes) {
  constexpr int kStep = 30;      // [units]
  constexpr float kSeen = 4.0F;  // [units] of the cursor's arms
  int offset = 0;                // [units] differs from mode to mode, so that all modes together have a finer step
  for (const Mode mode : {Mode::rbm, Mode::hrm, Mode::patch, Mode::beacon, Mode::ranging}) {
    for (const char* message : {"", "BLIND ZONE"}) {
      DisplayInput input = crowded(mode, 40.0);
      testing::set_text(input.state.message, message);
      input.state.boxed &= ~(1U << 20U);  // the band has no box, which would keep the readout below it in its place
      input.model_alive = input.ownship_fresh = input.state_machine_alive = true;
      put_cursor_on_display(input, {240.0F, 150.0F});
      const auto before = testing::texts(drawn(input));
      offset = (offset + 6) % kStep;
      for (int x = offset; x <= 480; x += kStep) {
        for (int y = offset; y <= 480; y += kStep) {
          put_cursor_on_display(input, {static_cast<float>(x), static_cast<float>(y)});
          const DrawList list = drawn(input);
          const std::string what = std::string(radar::name_of(mode)) + " '" + message + "' with the cursor at " +
                                   std::to_string(x) + ", " + std::to_string(y);
          expect_no_overlap(list, what);
          ASSERT_EQ(testing::texts(list), before) << what;
          ASSERT_GE(length_of_cursor(list), kSeen) << what;
          if (::testing::Test::HasFailure()) return;
        }
      }
    }
  }
}

TEST(Overlap, ThereIsNoneWithTheCursorAnywhereAndPartsOfTheSetSilent) {
  DisplayInput input = crowded(Mode::rbm, 40.0);
  input.state_machine_alive = true;
  const auto before = testing::texts(drawn(input));
  for (int x = 0; x <= 480; x += 16) {
    for (int y = 0; y <= 480; y += 16) {
      put_cursor_on_display(input, {static_cast<float>(x), static_cast<float>(y)});
      const DrawList list = drawn(input);
      expect_no_overlap(list, std::to_string(x) + ", " + std::to_string(y));
      ASSERT_EQ(testing::texts(list), before) << x << ", " << y;
    }
  }
}

// A label in the row of the legends would be read as the legend of a button that has none.
void expect_no_label_among_legends(const DrawList& list, const std::string& what) {
  for (const OccupiedBox& box : list.occupied()) {
    if (box.kind != BoxKind::label) continue;
    EXPECT_GT(box.rect.top, 20.0F) << box.name << ' ' << what;
    EXPECT_LT(box.rect.bottom, 446.0F) << box.name << ' ' << what;
  }
}

TEST(Overlap, ThereIsNoneWithATargetAsternAndNoLabelStandsAmongTheLegends) {
  for (const Mode mode : {Mode::rbm, Mode::hrm, Mode::beacon}) {
    for (double bearing_deg = 120.0; bearing_deg <= 300.0; bearing_deg += 10.0) {
      for (double range_nm = 0.5; range_nm <= 20.0; range_nm *= 1.3) {
        for (const bool all : {false, true}) {
          DisplayInput input = all ? crowded(mode, 40.0) : testing::operating(mode, 40.0);
          const geo::GeoPoint position = testing::at(bearing_deg, range_nm);
          testing::put_target(input, position, bearing_deg, databuffer::SteeringLine::line_of_sight);
          testing::add_point(input, "4.", radar::PointKind::target, position);
          const std::string what = std::to_string(bearing_deg) + " at " + std::to_string(range_nm);
          const DrawList list = drawn(input);
          expect_no_overlap(list, what);
          expect_no_label_among_legends(list, what);
        }
      }
    }
  }
}

TEST(Overlap, PointsInAllDirectionsAreClearOfGrayScaleAndMessages) {
  for (const Mode mode : {Mode::rbm, Mode::hrm, Mode::beacon}) {
    for (const char* message : {"", "BLIND ZONE"}) {
      for (double right_deg = 0.0; right_deg < 360.0; right_deg += 5.0) {
        for (const double range_nm : {0.5, 1.0, 2.0, 3.0, 4.0, 12.0, 16.0, 18.0, 20.0, 21.0}) {
          DisplayInput input = testing::operating(mode, 40.0);
          testing::set_text(input.state.message, message);
          testing::add_point(input, "7.", radar::PointKind::target, testing::at(30.0 + right_deg, range_nm));
          expect_no_overlap(drawn(input), std::to_string(right_deg) + " at " + std::to_string(range_nm));
        }
      }
    }
  }
}

TEST(Overlap, ThereIsNoneInAnyOfManyRandomStates) {
  const unsigned seed = 20261122;
  RecordProperty("seed", static_cast<int>(seed));
  testing::RandomDisplayInput states(seed);
  int pictures_with_overlap = 0;
  std::string first;
  constexpr int kStates = 2000;
  for (int i = 0; i < kStates; ++i) {
    const DisplayInput input = states.next();
    const DrawList list = drawn(input);
    for (const int size : {480, 1024}) {
      const auto found = testing::overlaps(list, size);
      if (found.empty()) continue;
      ++pictures_with_overlap;
      if (first.empty()) {
        first = "state " + std::to_string(i) + " of seed " + std::to_string(seed) + ", " +
                std::string(radar::name_of(static_cast<Mode>(input.state.mode))) + " at " + std::to_string(size) + ":";
        for (const std::string& sentence : found) first += " " + sentence + ";";
      }
    }
  }
  EXPECT_EQ(pictures_with_overlap, 0) << first;
}

}  // namespace
}  // namespace yars::display
