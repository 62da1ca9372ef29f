// Help over the picture, remedies below messages, states without a picture. Source: docs/pilots_manual.md#help,
// #remedies, #states.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "display/symbology/overlay_texts.hpp"
#include "display/symbology/text_layout.hpp"
#include "tests/display/symbology/overlap.hpp"
#include "tests/display/symbology/symbology_checks.hpp"

namespace yars::display {
namespace {

using radar::Mode;
using ::testing::Contains;
using ::testing::IsEmpty;
using ::testing::Not;

DisplayInput advised(Mode mode) {
  DisplayInput input = testing::operating(mode, 40.0);
  for (int button = 0; button <= radar::kBezelButtons; ++button)
    testing::set_text(input.advice.buttons[button], "does what is number " + std::to_string(button));
  testing::set_text(input.advice.buttons[0], "BLIND ZONE; turn 5 deg or more left, or move the cursor right");
  testing::set_text(input.advice.buttons[8], "dead in RBM; live in patch map");
  input.advice.live = ~0U & ~(1U << 8) & ~1U;
  return input;
}

TEST(Help, ItNamesEachButtonWithItsKeyItsLegendAndWhatItDoesNow) {
  DisplayInput input = advised(Mode::rbm);
  input.help = true;
  const auto texts = testing::words(input);
  for (int button = 1; button <= radar::kBezelButtons; ++button) {
    EXPECT_THAT(texts, Contains(std::to_string(button)));
    if (button == 8) continue;
    EXPECT_THAT(texts, Contains("DOES WHAT IS NUMBER " + std::to_string(button)));
  }
  for (const char* words : {"K", "GAIN 3", "FULL", "DEAD IN RBM", "TDC SWITCH", "PGUP PGDN", "F5 F6 F7", "F8 F11"})
    EXPECT_THAT(texts, Contains(words));
}

TEST(Help, ItIsDrawnOnlyWhenItIsAskedFor) {
  DisplayInput input = advised(Mode::rbm);
  EXPECT_THAT(testing::words(input), Not(Contains("HELP")));
  input.help = true;
  EXPECT_THAT(testing::words(input), Contains("HELP"));
  input.state.power = static_cast<std::uint8_t>(radar::Power::off);
  EXPECT_THAT(testing::words(input), Contains("HELP")) << "also while the power is OFF";
}

TEST(Help, ItsTextsLieWithinThePlateAndDoNotOverlap) {
  DrawList list;
  draw_help(advised(Mode::rbm), list);
  const auto& texts = list.occupied();
  const Rect plate = list.content(Layer::cover).plates.front();
  for (std::size_t i = 0; i < texts.size(); ++i) {
    EXPECT_TRUE(texts[i].rect.left >= plate.left && texts[i].rect.right <= plate.right) << texts[i].name;
    EXPECT_TRUE(texts[i].rect.top >= plate.top && texts[i].rect.bottom <= plate.bottom) << texts[i].name;
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_FALSE(intersect(grown(texts[i].rect, 0.5F), texts[j].rect)) << texts[i].name << " / " << texts[j].name;
  }
}

TEST(Help, WithoutAnAdviceTheWordsSayThatTheStateMachineIsSilent) {
  DisplayInput input = testing::operating(Mode::rbm, 40.0);
  EXPECT_EQ(words_of_button(input, 13), "not known: state-machine is silent; start state-machine");
  input = advised(Mode::rbm);
  EXPECT_EQ(words_of_button(input, 13), "does what is number 13");
  input.state_machine_alive = false;
  EXPECT_EQ(words_of_button(input, 13), "not known: state-machine is silent; start state-machine");
}

TEST(Help, LabelsOfPointsStandWhereTheyStoodWhenTheHelpIsGone) {
  DisplayInput input = advised(Mode::rbm);
  testing::add_point(input, "7.", radar::PointKind::target, testing::at(40.0, 20.0));
  const radar::RadarConfiguration configuration;
  const PlanView view(configuration.view);
  LabelMemory labels;
  DrawList before, during, after;
  const auto frame = present_frame(input, nullptr);
  draw_symbology(input, configuration, view, frame, labels, before);
  input.help = true;
  draw_symbology(input, configuration, view, frame, labels, during);
  input.help = false;
  draw_symbology(input, configuration, view, frame, labels, after);
  EXPECT_EQ(before, after);
  EXPECT_NE(before, during);
}

TEST(Remedy, ItStandsBelowTheMessageInSmallerLetters) {
  DisplayInput input = testing::operating(Mode::rbm, 40.0);
  testing::set_text(input.state.message, "MIN RANGE");
  testing::set_text(input.advice.remedy, "move the cursor out to 10.0 NM or more, or take window 4.7: acq aft (PgDn)");
  const DrawList list = testing::drawn(input);
  const auto box = [&](const std::string& part) {
    for (const OccupiedBox& one : list.occupied())
      if (one.name.find(part) != std::string::npos) return one.rect;
    ADD_FAILURE() << part;
    return Rect{};
  };
  const Rect message = box("MIN RANGE"), first = box("MOVE THE CURSOR"), second = box("(PGDN)");
  EXPECT_LT(message.bottom, first.top);
  EXPECT_LT(first.bottom, second.top);
  EXPECT_LT(first.bottom - first.top, message.bottom - message.top);
  input.state.message[0] = '\0';
  for (const std::string& words : testing::words(input))
    EXPECT_FALSE(words.starts_with("MOVE")) << "no remedy without a message";
}

TEST(Remedy, TheLongestStandsWhole) {
  DisplayInput input = testing::operating(Mode::rbm, 40.0);
  testing::set_text(input.state.message, "MAX RANGE");
  const std::string remedy =
      "move the cursor in to 160.0 NM or less, or take window 4.7: acq aft (PgDn) 7 times, or more words to fill it up";
  testing::set_text(input.advice.remedy, remedy);
  std::string joined;
  for (const std::string& line : wrapped(in_capitals(remedy), 270.0F / 8.0F)) {
    EXPECT_THAT(testing::words(input), Contains(line));
    joined += line + ' ';
  }
  EXPECT_EQ(joined, in_capitals(remedy) + ' ');
  testing::expect_no_overlap(testing::drawn(input), "three lines");
  input.state_machine_alive = false;
  EXPECT_THAT(testing::words(input), Not(Contains("MAX RANGE"))) << "a message without a state machine is out of date";
}

TEST(Remedy, ASilentPartOfTheSetHasOneOnTheDisplay) {
  DisplayInput input = testing::operating(Mode::rbm, 40.0);
  input.ownship_fresh = input.model_alive = input.state_machine_alive = false;
  for (const char* remedy : {"SEE YARS STATUS, OR START A FLIGHT-MODEL", "START RADAR-MODEL; YARS STATUS SAYS MORE",
                             "START STATE-MACHINE; YARS STATUS SAYS MORE"})
    EXPECT_THAT(testing::words(input), Contains(remedy));
  input.state_machine_alive = true;
  testing::set_text(input.state.message, "NO OWNSHIP");
  const auto texts = testing::words(input);
  EXPECT_EQ(std::ranges::count(texts, "NO OWNSHIP"), 1) << "the message is the same";
}

TEST(States, OffIsDarkInACockpitAndSaysInAWindowHowToSwitchOn) {
  DisplayInput input = testing::operating(Mode::rbm, 40.0);
  input.state.power = static_cast<std::uint8_t>(radar::Power::off);
  EXPECT_THAT(testing::words(input), IsEmpty());
  input.hints = true;
  const DrawList list = testing::drawn(input);
  EXPECT_THAT(testing::words(list), Contains("SWITCH ON: POWER OPR (O)"));
  for (const Segment& stroke : list.content(Layer::symbols).strokes) EXPECT_EQ(stroke.ink, Ink::dim);
}

TEST(States, StatesWithoutAPictureSayWhatTheyAreAndWithHintsHowToGetBack) {
  const struct {
    Mode mode;
    const char *name, *back;
  } cases[] = {{Mode::air_to_air, "AIR-TO-AIR", "BACK TO A/G: MODE AG (F5)"},
               {Mode::ranging, "A/G RANGING", "BACK TO A/G: MODE AG (F5)"},
               {Mode::menu, "MAIN MENU", "BACK TO THE RADAR: PB 6 (6)"},
               {Mode::pvu, "PVU", "NEXT MODE: PB 6 (6)"}};
  for (const auto& one : cases) {
    DisplayInput input = testing::operating(one.mode, 40.0);
    EXPECT_THAT(testing::words(input), Contains(one.name));
    EXPECT_THAT(testing::words(input), Not(Contains(one.back))) << "a cockpit has no such keys";
    input.hints = true;
    EXPECT_THAT(testing::words(input), Contains(one.back));
  }
}

TEST(Text, ProseIsDrawnInCapitalsAndWrappedAtBlanks) {
  EXPECT_EQ(in_capitals("move up v^"), "MOVE UP V^");
  const auto lines = wrapped("turn 5 deg or more left", text_width("turn 5 deg or"));
  EXPECT_EQ(lines, (std::vector<std::string>{"turn 5 deg", "or more left"}));
  EXPECT_TRUE(wrapped("", 10.0F).empty());
  EXPECT_EQ(first_words("turn 5 deg or more left", text_width("turn 5 deg")), "turn 5 deg");
  EXPECT_EQ(first_words("", 10.0F), "");
}

TEST(Text, NumberAndUnitEventAndKeyStayTogetherAndNoLineIsOneShortWord) {
  const char* const remedies[] = {
      "turn 8 deg or more left, or move the cursor 1.4 NM right",
      "move the cursor out to 10.0 NM or more, or take window 4.7: acq aft (PgDn)",
      "move the cursor in to 20.0 NM or less, or take window 1.3: acq fwd (PgUp) 2 times",
      "descend 12300 ft or more, or move the cursor out to 6.3 NM or more",
      "by the cursor's range, here 3.3 NM; back to 0.67 NM: acq fwd (PgUp)",
      "start one: Record in the browser, or yars record FILE",
  };
  for (const std::string remedy : remedies) {
    for (float width = 20.0F; width <= 45.0F; width += 0.5F) {
      const auto lines = wrapped(in_capitals(remedy), width);
      std::string joined;
      for (const std::string& line : lines) {
        joined += (joined.empty() ? "" : " ") + line;
        EXPECT_LE(text_width(line), width) << line;
        const bool single = line.find(' ') == std::string::npos;
        EXPECT_FALSE(single && line.size() <= 7 && lines.size() > 1) << line << " of " << remedy << " at " << width;
        for (const char* part : {"NM", "DEG", "FT", "(PGUP)", "(PGDN)", "FWD", "AFT"})
          EXPECT_FALSE(line.starts_with(part)) << line << " of " << remedy << " at " << width;
      }
      EXPECT_EQ(joined, in_capitals(remedy));
    }
  }
}

}  // namespace
}  // namespace yars::display
