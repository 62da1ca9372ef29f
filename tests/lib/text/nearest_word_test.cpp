// Distances between words, and the valid word that a misspelled word means.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "lib/text/plain_text.hpp"

namespace yars::text {
namespace {

TEST(EditDistance, EachEditCountsOnce) {
  EXPECT_EQ(edit_distance("status", "status"), 0);
  EXPECT_EQ(edit_distance("stats", "status"), 1) << "missing";
  EXPECT_EQ(edit_distance("statuss", "status"), 1) << "inserted";
  EXPECT_EQ(edit_distance("statos", "status"), 1) << "wrong";
  EXPECT_EQ(edit_distance("stauts", "status"), 1) << "transposed";
  EXPECT_EQ(edit_distance("", "abc"), 3);
  EXPECT_EQ(edit_distance("abc", ""), 3);
}

// Where the restricted distance (optimal string alignment) gives 3: a character may stand between transposed ones.
TEST(EditDistance, CharactersBetweenTransposedOnesCount) {
  EXPECT_EQ(edit_distance("ca", "abc"), 2);
}

TEST(EditDistance, IsSymmetric) {
  const std::vector<std::string> words{"", "a", "ab", "ba", "freeze", "freze", "elevation", "altimeter"};
  for (const std::string& one : words)
    for (const std::string& other : words) EXPECT_EQ(edit_distance(one, other), edit_distance(other, one));
}

const std::vector<std::string> kCommands{"scan", "patch", "status", "watch", "sim"};

TEST(NearestWord, IsAtMostAThirdOfTheLengthAway) {
  EXPECT_EQ(nearest_word("stauts", kCommands), "status");
  EXPECT_EQ(nearest_word("sttu", kCommands), std::nullopt) << "two edits in four characters";
  EXPECT_EQ(nearest_word("statxx", kCommands), "status") << "two edits in six characters";
  EXPECT_EQ(nearest_word("staxxx", kCommands), std::nullopt);
  EXPECT_EQ(nearest_word("zz", kCommands), std::nullopt);
  EXPECT_EQ(nearest_word("", kCommands), std::nullopt);
}

TEST(NearestWord, IgnoresCaseAndTakesTheNearest) {
  EXPECT_EQ(nearest_word("STATUS", kCommands), "status");
  const std::vector<std::string> near{"patches", "patch", "latch"};
  EXPECT_EQ(nearest_word("pacth", near), "patch");
  const std::vector<std::string> equally_near{"band", "bank"};
  EXPECT_EQ(nearest_word("bant", equally_near), "band") << "the first of equally near words";
}

TEST(NearestWord, OfAVeryLongWordIsNone) {
  EXPECT_EQ(nearest_word(std::string(100'000, 'a'), kCommands), std::nullopt);
  const std::vector<std::string> long_words{std::string(100'000, 'a')};
  EXPECT_EQ(nearest_word("aaaaaa", long_words), std::nullopt);
}

TEST(DidYouMean, IsAPartOfAMessage) {
  EXPECT_EQ(did_you_mean("pathc", kCommands), "did you mean 'patch'?");
  EXPECT_EQ(did_you_mean("nonsense", kCommands), "");
}

TEST(NearestWord, ABeginOfFourCharactersMeansTheShortestWordThatItBegins) {
  const std::vector<std::string> valid{"statistics", "status", "sim"};
  EXPECT_EQ(nearest_word("stat", valid), "status");
  EXPECT_EQ(nearest_word("sta", valid), std::nullopt);
  EXPECT_EQ(nearest_word("--window", std::vector<std::string>{"--windows-of-another", "--window-nm"}), "--window-nm");
}

}  // namespace
}  // namespace yars::text
