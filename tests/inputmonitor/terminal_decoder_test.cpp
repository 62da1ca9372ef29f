// TerminalDecoder: presses and releases of keys from the bytes of a terminal, with their times.
#include <gtest/gtest.h>

#include <map>
#include <random>
#include <string>
#include <vector>

#include "inputmonitor/keyboard_source.hpp"

namespace yars::inputmonitor {
namespace {

using databuffer::Key;

constexpr std::int64_t kMillisecond = 1'000'000;

std::string name_of(Key key) {
  static const std::map<Key, std::string> kNames{{Key::up, "up"},        {Key::down, "down"},      {Key::left, "left"},
                                                 {Key::right, "right"},  {Key::enter, "enter"},    {Key::tab, "tab"},
                                                 {Key::page_up, "pgup"}, {Key::page_down, "pgdn"}, {Key::f1, "f1"},
                                                 {Key::f2, "f2"},        {Key::f3, "f3"},          {Key::f4, "f4"},
                                                 {Key::f5, "f5"},        {Key::f7, "f7"},          {Key::f11, "f11"},
                                                 {Key::escape, "esc"},   {Key::space, "space"}};
  const auto name = kNames.find(key);
  return name != kNames.end() ? name->second : std::string(1, static_cast<char>(key));
}

// "+up -up": the key "up" was pressed, then released.
std::string text_of(const std::vector<KeyChange>& changes) {
  std::string text;
  for (const KeyChange& change : changes)
    text.append(text.empty() ? "" : " ").append(change.pressed ? "+" : "-").append(name_of(change.key));
  return text;
}

// Feeds bytes at time 0 and advances by 1 s, after which nothing is pending.
std::string typed(const std::string& bytes) {
  TerminalDecoder decoder;
  std::string text = text_of(decoder.feed(bytes, 0));
  const std::string later = text_of(decoder.advance(1'000 * kMillisecond));
  return text.empty() || later.empty() ? text + later : text + " " + later;
}

TEST(TerminalDecoder, CharacterKeysArePressedAndReleasedAtOnce) {
  EXPECT_EQ(typed("2"), "+2 -2");
  EXPECT_EQ(typed("K"), "+k -k");
  EXPECT_EQ(typed("["), "+[ -[");
  EXPECT_EQ(typed(" "), "+space -space");
  EXPECT_EQ(typed("\t"), "+tab -tab");
  EXPECT_EQ(typed("\r"), "+enter -enter");
  EXPECT_EQ(typed("\n"), "+enter -enter");
  EXPECT_EQ(typed("2a"), "+2 -2 +a -a");
}

TEST(TerminalDecoder, BytesWithoutAKeyAreDropped) {
  EXPECT_EQ(typed(std::string("\0\x01\x7f\xc3\xa9", 5)), "");
}

TEST(TerminalDecoder, ArrowSequencesOfAllKindsAreDecoded) {
  for (const char* introducer : {"\x1b[", "\x1bO", "\x1b[1;5"}) {
    EXPECT_EQ(typed(introducer + std::string("A")), "+up -up");
    EXPECT_EQ(typed(introducer + std::string("B")), "+down -down");
    EXPECT_EQ(typed(introducer + std::string("C")), "+right -right");
    EXPECT_EQ(typed(introducer + std::string("D")), "+left -left");
  }
}

TEST(TerminalDecoder, FunctionKeysOfXtermVt220AndTheLinuxConsoleAreDecoded) {
  EXPECT_EQ(typed("\x1bOP\x1bOQ\x1bOR\x1bOS"), "+f1 -f1 +f2 -f2 +f3 -f3 +f4 -f4");
  EXPECT_EQ(typed("\x1b[11~\x1b[12~\x1b[13~\x1b[14~"), "+f1 -f1 +f2 -f2 +f3 -f3 +f4 -f4");
  EXPECT_EQ(typed("\x1b[[A\x1b[[B\x1b[[C\x1b[[D"), "+f1 -f1 +f2 -f2 +f3 -f3 +f4 -f4");
  EXPECT_EQ(typed("\x1b[15~\x1b[18~\x1b[23~\x1b[[E"), "+f5 -f5 +f7 -f7 +f11 -f11 +f5 -f5");
  EXPECT_EQ(typed("\x1b[1;2P"), "+f1 -f1");
  EXPECT_EQ(typed("\x1b[5~\x1b[6;3~"), "+pgup -pgup +pgdn -pgdn");
  EXPECT_EQ(typed("\x1bOM"), "+enter -enter");
}

TEST(TerminalDecoder, UnknownSequencesAreDroppedAsAWhole) {
  EXPECT_EQ(typed("\x1b[3~2"), "+2 -2");
  EXPECT_EQ(typed("\x1b[200~2"), "+2 -2");
  EXPECT_EQ(typed("\x1b[Z2"), "+2 -2");
  EXPECT_EQ(typed("\x1b[[F2"), "+2 -2");
  EXPECT_EQ(typed("\x1b[2A2"), "+2 -2");
  EXPECT_EQ(typed("\x1b"
                  "a2"),
            "+2 -2");
}

TEST(TerminalDecoder, EscapeAloneIsTheKeyAfterFiftyMilliseconds) {
  TerminalDecoder decoder;
  EXPECT_EQ(text_of(decoder.feed("\x1b", 0)), "");
  EXPECT_EQ(decoder.deadline_ns(), 50 * kMillisecond);
  EXPECT_EQ(text_of(decoder.advance(50 * kMillisecond - 1)), "");
  EXPECT_EQ(text_of(decoder.advance(50 * kMillisecond)), "+esc -esc");
  EXPECT_EQ(decoder.deadline_ns(), std::nullopt);
}

TEST(TerminalDecoder, ASequenceInFragmentsIsNoEscapeKey) {
  TerminalDecoder decoder;
  std::string text = text_of(decoder.feed("\x1b", 0));
  text += text_of(decoder.feed("[", 40 * kMillisecond));
  text += text_of(decoder.feed("5", 80 * kMillisecond));
  text += text_of(decoder.feed("~", 120 * kMillisecond));
  EXPECT_EQ(text, "+pgup -pgup");
}

TEST(TerminalDecoder, AnUnfinishedSequenceIsDroppedAfterFiftyMilliseconds) {
  TerminalDecoder decoder;
  decoder.feed("\x1b[", 0);
  EXPECT_EQ(text_of(decoder.advance(50 * kMillisecond)), "");
  EXPECT_EQ(text_of(decoder.feed("2", 51 * kMillisecond)), "+2 -2");
}

TEST(TerminalDecoder, EscapeAndAKeyMoreThanFiftyMillisecondsLaterAreTwoKeys) {
  TerminalDecoder decoder;
  decoder.feed("\x1b", 0);
  EXPECT_EQ(text_of(decoder.feed("2", 60 * kMillisecond)), "+esc -esc +2 -2");
}

TEST(TerminalDecoder, TwoEscapesAtOnceAreOneEscape) {
  EXPECT_EQ(typed("\x1b\x1b"), "+esc -esc");
  EXPECT_EQ(typed("\x1b\x1b[A"), "+up -up");
}

TEST(TerminalDecoder, AnArrowIsHeldForAHundredMilliseconds) {
  TerminalDecoder decoder;
  EXPECT_EQ(text_of(decoder.feed("\x1b[A", 0)), "+up");
  EXPECT_EQ(decoder.deadline_ns(), 100 * kMillisecond);
  EXPECT_EQ(text_of(decoder.advance(100 * kMillisecond - 1)), "");
  EXPECT_EQ(text_of(decoder.advance(100 * kMillisecond)), "-up");
}

TEST(TerminalDecoder, AnArrowThatRepeatsStaysHeld) {
  TerminalDecoder decoder;
  std::string text;
  for (int repeat = 0; repeat < 10; ++repeat) text += text_of(decoder.feed("\x1b[A", repeat * 33 * kMillisecond));
  EXPECT_EQ(text, "+up");
  EXPECT_EQ(text_of(decoder.advance((9 * 33 + 100) * kMillisecond)), "-up");
}

TEST(TerminalDecoder, TwoArrowsAreHeldTogether) {
  TerminalDecoder decoder;
  EXPECT_EQ(text_of(decoder.feed("\x1b[A", 0)), "+up");
  EXPECT_EQ(text_of(decoder.feed("\x1b[C", 30 * kMillisecond)), "+right");
  EXPECT_EQ(decoder.deadline_ns(), 100 * kMillisecond);
  EXPECT_EQ(text_of(decoder.advance(100 * kMillisecond)), "-up");
  EXPECT_EQ(text_of(decoder.advance(130 * kMillisecond)), "-right");
}

TEST(TerminalDecoder, AfterRandomBytesEveryKeyIsReleasedAndNothingIsPending) {
  const unsigned seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  const std::string alphabet = "\x1b\x1b\x1b[[OABCDPQRSM~;156 2az\r\t\x80";
  TerminalDecoder decoder;
  std::map<Key, int> held;
  std::int64_t now = 0;
  const auto follow = [&held](const std::vector<KeyChange>& changes) {
    for (const KeyChange& change : changes) {
      held[change.key] += change.pressed ? 1 : -1;
      ASSERT_TRUE(held[change.key] == 0 || held[change.key] == 1) << name_of(change.key);
    }
  };
  for (int round = 0; round < 50'000; ++round) {
    now += static_cast<std::int64_t>(random() % 70) * kMillisecond;
    std::string bytes;
    for (auto count = random() % 4; count > 0; --count) bytes += alphabet[random() % alphabet.size()];
    follow(decoder.feed(bytes, now));
    // The deadline is always in the future, so that a caller that waits for it does not loop without pause.
    ASSERT_GT(decoder.deadline_ns().value_or(now + 1), now);
  }
  follow(decoder.advance(now + 1'000 * kMillisecond));
  for (const auto& [key, count] : held) EXPECT_EQ(count, 0) << name_of(key);
  EXPECT_EQ(decoder.deadline_ns(), std::nullopt);
}

}  // namespace
}  // namespace yars::inputmonitor
