// Tests of the keyboard: the events of each key, and KeyboardState, which tracks the keys that are down.
#include "databuffer/messages/key_map.hpp"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "databuffer/messages/input_event.hpp"
#include "databuffer/messages/validation.hpp"

namespace yars::databuffer {
namespace {

std::string texts_of(const std::vector<InputEvent>& events) {
  std::string texts;
  for (const InputEvent& event : events) texts += (texts.empty() ? "" : ", ") + text_of(event);
  return texts;
}

// Texts of the events of a key's press and, behind a slash, of its release.
std::string typed(Key key) {
  KeyboardState keyboard;
  const std::string down = texts_of(keyboard.change(key, true));
  const std::string up = texts_of(keyboard.change(key, false));
  return up.empty() ? down : down + " / " + up;
}

TEST(KeyMap, DigitsAndLettersAreTheButtonsOfTheirRow) {
  const std::string keys = "23456789abcdefghijk";
  for (std::size_t index = 0; index < keys.size(); ++index)
    EXPECT_EQ(typed(key_of_character(keys[index])), "pb " + std::to_string(index + 2)) << keys[index];
}

TEST(KeyMap, EachNamedKeyGivesItsEvents) {
  EXPECT_EQ(typed(Key::enter), "tdc press / tdc release");
  EXPECT_EQ(typed(Key::tab), "coolie up");
  EXPECT_EQ(typed(Key::page_up), "acq fwd");
  EXPECT_EQ(typed(Key::page_down), "acq aft");
  EXPECT_EQ(typed(Key::space), "freeze");
  EXPECT_EQ(typed(key_of_character('[')), "elevation down");
  EXPECT_EQ(typed(key_of_character(']')), "elevation up");
  EXPECT_EQ(typed(key_of_character('n')), "next");
  EXPECT_EQ(typed(Key::f4), "nav toggle");
  EXPECT_EQ(typed(Key::f5), "mode ag");
  EXPECT_EQ(typed(Key::f6), "mode aa");
  EXPECT_EQ(typed(Key::f7), "mode agr");
  EXPECT_EQ(typed(key_of_character('O')), "power opr");
  EXPECT_EQ(typed(key_of_character('s')), "power stby");
  EXPECT_EQ(typed(Key::up), "tdc 0 1 / tdc 0 0");
  EXPECT_EQ(typed(Key::down), "tdc 0 -1 / tdc 0 0");
  EXPECT_EQ(typed(Key::left), "tdc -1 0 / tdc 0 0");
  EXPECT_EQ(typed(Key::right), "tdc 1 0 / tdc 0 0");
}

TEST(KeyMap, UnassignedKeysGiveNoEvent) {
  for (const char character : std::string("01lmzx-=")) EXPECT_EQ(typed(key_of_character(character)), "") << character;
  for (const Key key : {Key::escape, Key::f1, Key{'?'}, Key::f8, Key::f11}) EXPECT_EQ(typed(key), "");
  EXPECT_EQ(typed(Key::none), "");
}

TEST(KeyMap, QuestionMarkAndF1AskForHelp) {
  EXPECT_TRUE(is_help(key_of_character('?')));
  EXPECT_TRUE(is_help(Key::f1));
  EXPECT_FALSE(is_help(Key::f4));
}

TEST(KeyMap, LettersAndDigitsWithoutAnEventAreDead) {
  for (const char character : std::string("01lmz")) EXPECT_TRUE(is_dead_letter(key_of_character(character)));
  for (const char character : std::string("2kos?[ ")) EXPECT_FALSE(is_dead_letter(key_of_character(character)));
  EXPECT_FALSE(is_dead_letter(Key::none));
}

TEST(KeyMap, TheNameOfAButtonsKeyIsTheKeyThatPressesIt) {
  EXPECT_EQ(key_of_button(1), "");
  for (int button = 2; button <= 20; ++button)
    EXPECT_EQ(typed(key_of_character(key_of_button(button).front())), "pb " + std::to_string(button));
  EXPECT_EQ(key_of_button(21), "");
}

TEST(KeyMap, CapitalLettersAreTheSameKeys) {
  EXPECT_EQ(key_of_character('K'), key_of_character('k'));
  EXPECT_EQ(key_of_character('\x1b'), Key::none);
  EXPECT_EQ(key_of_character('\xe9'), Key::none);
}

TEST(KeyboardState, TwoArrowsCombineAndReleaseOneByOne) {
  KeyboardState keyboard;
  EXPECT_EQ(texts_of(keyboard.change(Key::up, true)), "tdc 0 1");
  EXPECT_EQ(texts_of(keyboard.change(Key::right, true)), "tdc 1 1");
  EXPECT_EQ(texts_of(keyboard.change(Key::up, false)), "tdc 1 0");
  EXPECT_EQ(texts_of(keyboard.change(Key::right, false)), "tdc 0 0");
}

TEST(KeyboardState, OppositeArrowsCancel) {
  KeyboardState keyboard;
  keyboard.change(Key::left, true);
  EXPECT_EQ(texts_of(keyboard.change(Key::right, true)), "tdc 0 0");
  EXPECT_EQ(texts_of(keyboard.change(Key::left, false)), "tdc 1 0");
}

TEST(KeyboardState, AutoRepeatGivesNoEvent) {
  KeyboardState keyboard;
  EXPECT_EQ(texts_of(keyboard.change(Key::space, true)), "freeze");
  EXPECT_EQ(texts_of(keyboard.change(Key::space, true)), "");
  EXPECT_EQ(texts_of(keyboard.change(Key::space, false)), "");
  EXPECT_EQ(texts_of(keyboard.change(Key::space, true)), "freeze");
}

TEST(KeyboardState, AReleaseWithoutAPressGivesNoEvent) {
  KeyboardState keyboard;
  EXPECT_EQ(texts_of(keyboard.change(Key::enter, false)), "");
  EXPECT_EQ(texts_of(keyboard.change(Key::up, false)), "");
}

TEST(KeyboardState, LosingTheKeyboardReleasesTheTdcAndItsSwitch) {
  KeyboardState keyboard;
  keyboard.change(Key::up, true);
  keyboard.change(Key::enter, true);
  EXPECT_EQ(texts_of(keyboard.release_all()), "tdc 0 0, tdc release");
  EXPECT_EQ(texts_of(keyboard.release_all()), "");
  EXPECT_EQ(texts_of(keyboard.change(Key::enter, true)), "tdc press");
}

TEST(KeyboardState, RandomKeysGiveValidEventsAndEndAtRest) {
  const unsigned seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  KeyboardState keyboard;
  InputEvent deflection{};
  int presses = 0;
  const auto follow = [&](const std::vector<InputEvent>& events) {
    for (const InputEvent& event : events) {
      ASSERT_FALSE(validate(event)) << *validate(event);
      if (event.kind == static_cast<std::uint16_t>(EventKind::tdc)) deflection = event;
      if (event.kind == static_cast<std::uint16_t>(EventKind::tdc_press)) ++presses;
      if (event.kind == static_cast<std::uint16_t>(EventKind::tdc_release)) --presses;
      ASSERT_TRUE(presses == 0 || presses == 1);
    }
  };
  for (int round = 0; round < 20'000; ++round)
    follow(keyboard.change(static_cast<Key>(random() % 256), random() % 2 == 0));
  follow(keyboard.release_all());
  EXPECT_EQ(deflection.x, 0.0);
  EXPECT_EQ(deflection.y, 0.0);
  EXPECT_EQ(presses, 0);
}

}  // namespace
}  // namespace yars::databuffer
