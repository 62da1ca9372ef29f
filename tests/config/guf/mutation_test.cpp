// Tests of the configuration reader with random changes of valid texts. Each changed text gives a configuration, or an
// error that names the file. The reader never crashes; the sanitizers of the dev build check its use of memory.
#include <gmock/gmock.h>

#include <array>
#include <cstdlib>
#include <random>
#include <span>

#include "config/schema/load.hpp"
#include "config/schema/slot_text.hpp"
#include "tests/config/support.hpp"

namespace yars::config {
namespace {

using testing::fields;

constexpr std::array kGufTexts{
    std::string_view(
        "( Radar :display ( Window width: 480 mode: \"doublebuffer\" ) :modes `( ( RealBeamMode :scanWidths "
        "{ 100, 50, 25 } :Display ( RbmDisplay width: `( -0.6, 0.6 ) ) ) ) )"),
    std::string_view(
        "( def-form New is= RbmAntenna 'x `y ) ( Apg70 :antenna ( New :scanWidths ( guf 90 60 30 ) :x 1 ) )"),
    std::string_view("; comment\n( AntennaServo '( -60 60 ) :3 `( 1e2 +.5e3 ) :4 `( 2.5 2.5 ) ) // end\n"),
    std::string_view("( Route `( ( Point \"1.\" ( lat-long N 35 44 51 ) ( lat-long W 121 30 2 ) 500 ) ) )"),
    std::string_view(
        "( Apg70 :fidelity ( Fidelity :preset 1996 :noise true ) :seed 1 :name \"a\\\"b\\n\" ) ( include \"x\" )"),
    std::string_view("( Window :colors `( ( rgb 0 1 0 ) ( hsva 360 1 1 0.5 ) ) :cmode rgb )")};

constexpr std::array kMessageTexts{
    std::string_view("Sea: { state: 3 } // calm"),
    std::string_view("my := Radar: { rate: 20 }"),
    std::string_view("myRadar := Radar: { latitude: N37@30.5 rate: 20 Display: { width: 480 mode: \"doublebuffer\" "
                     "colors: { rgb: { 0, 1, 0 } } } Antenna: { maxRates: { 60.0, 60.0 } // az, el\n } }"),
    std::string_view(
        "Radar: { MgDmaDatabase: { longitude: W122@00.0 } MgDmaDatabase: { } modes: { one := RealBeamMode: "
        "{ scanWidths: {100, 50, 25} list := ranges: {4.7, 10} scanBars: { 1, 2 } samplesPerSweep: 128 "
        "Display: { width: {-0.6, 0.6} } } } }"),
    std::string_view("/* a */ Fidelity: { preset: draft noise: true samples: 100 } Terrain: { directory: \"d/e\" }"),
    std::string_view("Apg70: { name: \"a\\\"b\" What: { is: this } pulseWidths: { 1 .5 2e-1 } } Sea: { }")};

constexpr std::array kFragments{std::string_view("("),        std::string_view(")"),
                                std::string_view("`("),       std::string_view("{"),
                                std::string_view("}"),        std::string_view(":1 "),
                                std::string_view("\""),       std::string_view("\\"),
                                std::string_view("is="),      std::string_view("1e308"),
                                std::string_view("-"),        std::string_view(";"),
                                std::string_view("def-form"), std::string_view("guf"),
                                std::string_view(":9999"),    std::string_view("\xFF\x00", 2),
                                std::string_view(":="),       std::string_view("@"),
                                std::string_view("a: "),      std::string_view("#include \"x\""),
                                std::string_view("/*")};

class Mutator {
 public:
  Mutator(std::span<const std::string_view> texts, std::uint64_t seed) : texts_(texts), random_(seed) {}

  std::string next() {
    std::string text(texts_[random_() % texts_.size()]);
    const std::size_t changes = 1 + random_() % 6;
    for (std::size_t i = 0; i < changes; ++i) change(text);
    return text;
  }

 private:
  void change(std::string& text) {
    const std::size_t position = random_() % (text.size() + 1);
    const std::size_t length = std::min<std::size_t>(random_() % 12, text.size() - position);
    switch (random_() % 5) {
      case 0:
        text.erase(position, length);
        break;
      case 1:
        text.insert(position, std::string(text.substr(random_() % (text.size() + 1), 20)));
        break;
      case 2:
        text.insert(position, kFragments[random_() % kFragments.size()]);
        break;
      case 3:
        if (position < text.size()) text[position] = static_cast<char>(random_());
        break;
      default:
        text.replace(position, length, kFragments[random_() % kFragments.size()]);
    }
  }

  std::span<const std::string_view> texts_;
  std::mt19937_64 random_;
};

void expect_read_or_refused(Mutator mutator) {
  const int texts = std::getenv("YARS_TEST_FULL") != nullptr ? 25'000 : 5'000;
  int accepted = 0;
  int refused = 0;
  for (int i = 0; i < texts; ++i) {
    const std::string text = mutator.next();
    const auto configuration = load_configuration_text(text, "m.guf");
    ++(configuration ? accepted : refused);
    if (configuration) continue;
    ASSERT_TRUE(configuration.error().subject.starts_with("m.guf:")) << "input " << i << ": " << text;
  }
  EXPECT_GT(accepted, texts / 25);
  EXPECT_GT(refused, texts / 25);
}

// Each of the two tests reads 5,000 texts for each seed; 25,000 with YARS_TEST_FULL.
class Mutations : public ::testing::TestWithParam<std::uint64_t> {};
INSTANTIATE_TEST_SUITE_P(Seeds, Mutations, ::testing::Values(1996, 70, 15, 7));

TEST_P(Mutations, AreReadOrRefusedWithAPosition) {
  SCOPED_TRACE("seed " + std::to_string(GetParam()));
  expect_read_or_refused({kGufTexts, GetParam()});
}

TEST_P(Mutations, OfMessagesAreReadOrRefusedWithAPosition) {
  SCOPED_TRACE("seed " + std::to_string(GetParam()));
  expect_read_or_refused({kMessageTexts, GetParam()});
}

// A configuration that was read prints as a text that reads back equal.
TEST(PrintOfMutations, ReadsBackEqual) {
  const std::uint64_t seed = 4;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Mutator mutator(kGufTexts, seed);
  for (int i = 0; i < 2'000; ++i) {
    const auto configuration = load_configuration_text(mutator.next(), "m.guf");
    if (!configuration) continue;
    const auto again = load_configuration_text(print_configuration(configuration->radar), "again.guf");
    ASSERT_TRUE(again) << "input " << i << ": " << again.error().message();
    ASSERT_EQ(fields(again->radar), fields(configuration->radar)) << "input " << i;
  }
}

// convert accepts every text that the reader accepts, and its output gives the same configuration.
TEST(ConvertOfMutations, ReadsBackAsTheSameConfiguration) {
  const std::uint64_t seed = 36;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Mutator of_messages(kMessageTexts, seed);
  Mutator of_guf(kGufTexts, seed);
  int converted = 0;
  for (int i = 0; i < 6'000; ++i) {
    const std::string text = (i % 2 == 0 ? of_messages : of_guf).next();
    const auto configuration = load_configuration_text(text, "m.guf");
    if (!configuration) continue;
    const auto modern = convert_configuration_text(text, "m.guf");
    ASSERT_TRUE(modern) << "input " << i << ": " << modern.error().message() << "\n" << text;
    const auto again = load_configuration_text(modern->text, "again.guf");
    ASSERT_TRUE(again) << "input " << i << ": " << again.error().message() << "\n" << text << "\n" << modern->text;
    ASSERT_EQ(fields(again->radar), fields(configuration->radar)) << "input " << i << ": " << text;
    ++converted;
  }
  EXPECT_GT(converted, 200);
}

}  // namespace
}  // namespace yars::config
