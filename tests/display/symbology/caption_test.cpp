// The caption of a tour: position of the plate, text, and what it may not cover.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "display/symbology/overlay_texts.hpp"
#include "display/symbology/readouts.hpp"
#include "lib/radar/modes.hpp"
#include "tests/display/symbology/symbology_checks.hpp"

namespace yars::display {
namespace {

using radar::Mode;
using ::testing::IsSupersetOf;

// A caption whose lines are as long as they may be.
databuffer::Caption widest() {
  databuffer::Caption caption{};
  caption.step = 12;
  caption.steps = 1000;
  testing::set_text(caption.title, "A look around the radar");
  for (auto& line : caption.lines) testing::set_text(line.text, std::string(databuffer::kCaptionLength, 'w'));
  return caption;
}

Rect plate_of(const DrawList& list, const DrawList& without) {
  const auto& plates = list.content(Layer::notices).plates;
  for (const Rect& plate : plates)
    if (std::ranges::find(without.content(Layer::notices).plates, plate) ==
        without.content(Layer::notices).plates.end())
      return plate;
  return {};
}

Rect plate_over(DisplayInput input) {
  const DrawList without = testing::drawn(input);
  input.caption = widest();
  return plate_of(testing::drawn(input), without);
}

TEST(Caption, ShowsTitleStepAndLinesInCapitals) {
  DisplayInput input = testing::operating(Mode::rbm, 40.0);
  input.caption = widest();
  testing::set_text(input.caption.lines[1].text, "Range down: key E");
  input.caption.lines[2].text[0] = '\0';
  EXPECT_THAT(testing::words(input), IsSupersetOf({"A LOOK AROUND THE RADAR", "12/1000", "RANGE DOWN: KEY E"}));
  input.caption.waiting = 1;
  EXPECT_THAT(testing::words(input), IsSupersetOf({"YOUR TURN.  N: DO IT FOR ME", "RANGE DOWN: KEY E"}));
}

TEST(Caption, WithoutAStepDrawsNothing) {
  DisplayInput input = testing::operating(Mode::rbm, 40.0);
  const DrawList without = testing::drawn(input);
  input.caption = widest();
  input.caption.step = 0;
  EXPECT_EQ(testing::drawn(input), without);
}

TEST(Caption, IsShownAlsoWithoutPower) {
  DisplayInput input;
  input.caption = widest();
  EXPECT_THAT(testing::words(input), IsSupersetOf({"12/1000"}));
}

TEST(Caption, CoversNoLegendNoMessageAndNoNumberAtTheEdge) {
  for (const Mode mode : {Mode::rbm, Mode::hrm, Mode::patch, Mode::beacon, Mode::pvu, Mode::air_to_air}) {
    DisplayInput input = testing::crowded(mode, 40.0);
    input.model_alive = input.ownship_fresh = input.state_machine_alive = true;
    const Rect plate = plate_over(input);
    ASSERT_GT(plate.right, plate.left) << static_cast<int>(mode);
    for (int button = 1; button <= radar::kBezelButtons; ++button) {
      const LegendPosition position = legend_position(button);
      const Rect legend = text_box(input.state.legends[button], position.at, {10.0F, position.align, true, false});
      EXPECT_FALSE(intersect(plate, legend)) << "PB " << button << " in mode " << static_cast<int>(mode);
    }
    const Rect message = text_box(input.state.message, {kDisplayUnits / 2.0F, 413.0F}, {10.0F});
    EXPECT_FALSE(intersect(plate, message));
  }
}

TEST(Caption, TheWidestLineStaysOnThePlate) {
  DisplayInput input = testing::operating(Mode::rbm, 40.0);
  const Rect plate = plate_over(input);
  input.caption = widest();
  const DrawList list = testing::drawn(input);
  for (const OccupiedBox& box : list.occupied())
    if (box.name.starts_with("WWWW")) {
      EXPECT_GE(box.rect.left, plate.left);
      EXPECT_LE(box.rect.right, plate.right);
      EXPECT_GE(box.rect.top, plate.top);
      EXPECT_LE(box.rect.bottom, plate.bottom);
    }
}

// Strokes of a text, as numbers.
std::vector<float> strokes_of(std::string_view text) {
  struct Numbers final : StrokeSink {
    std::vector<float> all;
    void polyline(std::span<const Point> points) override {
      for (const Point& point : points) all.insert(all.end(), {point.x, point.y});
    }
  } numbers;
  stroke_text(text, numbers);
  return numbers.all;
}

TEST(Caption, EveryCharacterOfTheShippedToursIsInTheFont) {
  const auto unknown = strokes_of("~");
  for (const auto& file : std::filesystem::directory_iterator(YARS_SOURCE_DIR "/config/tours")) {
    if (file.path().extension() != ".tour") continue;
    std::ifstream lines(file.path());
    for (std::string line; std::getline(lines, line);) {
      const auto at = line.find("caption ");
      if (line.starts_with('#') || at == std::string::npos) continue;
      for (const char character : line.substr(at)) {
        if (character == '|' || character == ' ') continue;
        EXPECT_NE(strokes_of(std::string(1, character)), unknown) << character << " in " << line;
      }
    }
  }
}

TEST(Caption, CoversNoSymbolNoNameNoSteeringLineAndNoScaleWhereThereIsRoom) {
  for (const Mode mode : {Mode::rbm, Mode::hrm, Mode::beacon}) {
    for (const double range_nm : {3.0, 6.0, 9.0, 30.0, 36.0}) {
      DisplayInput input = testing::operating(mode, 40.0);
      const geo::GeoPoint target = testing::at(40.0, range_nm);
      testing::put_target(input, target, 70.0, databuffer::SteeringLine::line_of_sight);
      testing::add_point(input, "4.", radar::PointKind::target, target);
      testing::add_point(input, "3", radar::PointKind::steer, testing::at(10.0, 5.0));
      testing::add_point(input, "2", radar::PointKind::steer, testing::at(20.0, 37.0));
      testing::put_cursor(input, 30.0, 33.0);
      const DrawList without = testing::drawn(input);
      input.caption = widest();
      for (auto& line : input.caption.lines) testing::set_text(line.text, std::string(40, 'w'));
      const Rect plate = plate_of(testing::drawn(input), without);
      const std::string what = std::to_string(static_cast<int>(mode)) + " at " + std::to_string(range_nm);
      for (const OccupiedBox& box : without.occupied()) EXPECT_FALSE(intersect(plate, box.rect)) << box.name << what;
      for (const Segment& line : without.content(Layer::lines).strokes)
        EXPECT_FALSE(crosses(plate, line.from, line.to)) << what;
    }
  }
}

TEST(Caption, CoversLeastWhereThereIsNoRoom) {
  DisplayInput input = testing::crowded(Mode::pvu, 40.0);
  const Rect plate = plate_over(input);
  EXPECT_GT(plate.right, plate.left);
  EXPECT_LE(plate.bottom, 404.0F);
  EXPECT_GE(plate.top, 66.0F);
}

// On the ground track at an eighth of the range the cursor is 50 units above the apex, inside the lower plate.
TEST(Caption, GivesWayToTheCursor) {
  DisplayInput input = testing::operating(Mode::rbm, 40.0);
  testing::put_cursor(input, 30.0, 30.0);
  EXPECT_GT(plate_over(input).top, kDisplayUnits / 2.0F);
  testing::put_cursor(input, 30.0, 5.0);
  EXPECT_LT(plate_over(input).bottom, kDisplayUnits / 2.0F);
}

}  // namespace
}  // namespace yars::display
