// Command lines: numbers as they are written, messages about wrong words, and the text of --help.
#include "runtime/command_line.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#include "runtime/program.hpp"

namespace yars::runtime {
namespace {

using ::testing::HasSubstr;

// A program with the command `draw`, and what its options got.
class Program : public ::testing::Test {
 protected:
  Program() : line_("a program", "prog") {
    ::setenv("YARS_USER_CONFIG", "", 1);
    line_.require_subcommand();
    line_.accept_options_after_subcommands();
    line_.add_help_command();
    line_.option("--session", session_, "session").value_name("SESSION");
    Command draw = line_.subcommand("draw", "draw a picture");
    draw.option("--width", width_, "[pixels] width").range(1, 4096);
    draw.option("--scale", scale_, "[m] scale").range(0.5, 2.0).otherwise("as it fits");
    draw.option("--seed", seed_, "seed");
    draw.option("--color", color_, "colours").one_of({"green", "gray"});
    draw.option("--corner", corner_, "[m] corner").values(2).otherwise("the origin");
    Option shade = draw.flag("--shade", shade_, "shades");
    draw.option("--light", light_, "[deg] direction of the light").needs(shade);
    draw.option("FILE", file_, "picture").value_name("FILE").required();
    draw.callback([this] { drawn_ = true; });
  }

  std::optional<int> run(std::vector<std::string> words) {
    words.insert(words.begin(), "prog");
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    ::testing::internal::CaptureStderr();
    ::testing::internal::CaptureStdout();
    const auto code = line_.parse(static_cast<int>(arguments.size()), arguments.data());
    std::fflush(stdout);
    errors_ = ::testing::internal::GetCapturedStderr();
    output_ = ::testing::internal::GetCapturedStdout();
    return code;
  }
  void expect_refused(const std::vector<std::string>& words, const std::string& message) {
    EXPECT_EQ(run(words), kExitUsage);
    EXPECT_EQ(errors_, message + "\n");
    EXPECT_FALSE(drawn_);
  }

  std::string session_ = "default", color_ = "green", file_;
  int width_ = 640;
  std::optional<double> scale_;
  std::uint64_t seed_ = 1;
  std::vector<double> corner_;
  double light_ = 45.0;
  bool shade_ = false, drawn_ = false;
  CommandLine line_;
  std::string errors_, output_;
};

TEST_F(Program, TakesNumbersAsTheyAreWritten) {
  EXPECT_EQ(run({"draw", "a.png", "--width", "0100", "--scale", "1.5e0", "--seed", "+18446744073709551615", "--corner",
                 "-3", "4.5"}),
            std::nullopt)
      << errors_;
  EXPECT_EQ(width_, 100) << "no octal number";
  EXPECT_EQ(scale_, 1.5);
  EXPECT_EQ(seed_, 18446744073709551615U);
  EXPECT_EQ(corner_, (std::vector<double>{-3.0, 4.5}));
  EXPECT_TRUE(drawn_);
}

TEST_F(Program, ANumberOutOfRangeNamesOptionRangeAndValue) {
  expect_refused({"draw", "a.png", "--width", "5000"},
                 "prog draw: --width: expected a whole number from 1 to 4096, found '5000'; see prog draw --help");
  expect_refused({"draw", "a.png", "--width", "99999999999999999999"},
                 "prog draw: --width: expected a whole number from 1 to 4096, found '99999999999999999999'; see prog "
                 "draw --help");
  expect_refused({"draw", "a.png", "--scale", "nan"},
                 "prog draw: --scale: expected a number from 0.5 to 2, found 'nan'; see prog draw --help");
  expect_refused({"draw", "a.png", "--seed", "-1"},
                 "prog draw: --seed: expected a whole number, 0 or more, found '-1'; see prog draw --help");
}

TEST_F(Program, AMisspelledWordIsSaid) {
  expect_refused({"darw"}, "prog: expected a command, found 'darw'; did you mean 'draw'? See prog --help");
  expect_refused({"paint"}, "prog: expected a command: help or draw, found 'paint'; see prog --help");
  expect_refused({"draw", "a.png", "--widht", "3"},
                 "prog draw: expected an option, found '--widht'; did you mean '--width'? See prog draw --help");
  expect_refused({"draw", "a.png", "--color", "grey"},
                 "prog draw: --color: expected green or gray, found 'grey'; did you mean 'gray'? See prog draw --help");
}

TEST_F(Program, WithoutAWordItPrintsItsHelp) {
  EXPECT_EQ(run({"--help"}), 0);
  const std::string help = output_;
  EXPECT_EQ(run({}), 0);
  EXPECT_EQ(output_, help);
}

TEST_F(Program, WhatIsMissingIsSaid) {
  expect_refused({"draw"}, "prog draw: expected FILE, found none; see prog draw --help");
  expect_refused({"draw", "a.png", "--width"},
                 "prog draw: --width: expected a whole number from 1 to 4096, found nothing; see prog draw --help");
  expect_refused({"draw", "a.png", "--corner", "1"},
                 "prog draw: --corner: expected 2 values, found 1; see prog draw --help");
  expect_refused({"draw", "a.png", "--light", "3"},
                 "prog draw: --light: expected --shade with it, found none; see prog draw --help");
  expect_refused(
      {"draw", "a.png", "--session", "--width", "3"},
      "prog draw: --session: expected the name of a session, found the option '--width'; see prog draw --help");
}

TEST_F(Program, WhatIsTooMuchIsSaid) {
  expect_refused({"draw", "a.png", "b.png"},
                 "prog draw: expected no further argument, found 'b.png'; see prog draw --help");
  expect_refused({"draw", "a.png", "--width", "1", "--width", "2"},
                 "prog draw: --width: expected the option once, found it 2 times; see prog draw --help");
  expect_refused({"draw", "a.png", "--shade=no"},
                 "prog draw: --shade: expected no value, found 'no'; see prog draw --help");
}

TEST_F(Program, HelpHasKindLimitsAndDefaultOfEachOption) {
  EXPECT_EQ(run({"draw", "--help"}), 0);
  EXPECT_EQ(output_,
            "draw a picture\n"
            "Usage: prog draw [OPTIONS] FILE\n"
            "\nPositionals:\n"
            "  FILE                        picture (required)\n"
            "\nOptions:\n"
            "  -h,--help                   print this help\n"
            "  --width INTEGER             [pixels] width (1 to 4096; default 640)\n"
            "  --scale NUMBER              [m] scale (0.5 to 2; else as it fits)\n"
            "  --seed INTEGER              seed (0 or more; default 1)\n"
            "  --color {green,gray}        colours (default green)\n"
            "  --corner NUMBER x 2         [m] corner (else the origin)\n"
            "  --shade                     shades\n"
            "  --light NUMBER              [deg] direction of the light (needs --shade; default 45)\n");
}

TEST_F(Program, HelpOfACommandIsTheTextOfItsOption) {
  run({"draw", "--help"});
  const std::string text = output_;
  EXPECT_EQ(run({"help", "draw"}), std::nullopt);
  EXPECT_EQ(output_, text);
  expect_refused({"help", "drwa"}, "prog: expected a command, found 'drwa'; did you mean 'draw'? See prog --help");
  expect_refused({"drwa", "--help"}, "prog: expected a command, found 'drwa'; did you mean 'draw'? See prog --help");
  expect_refused({"help", "draw", "more"},
                 "prog draw: expected no further argument, found 'more'; see prog draw --help");
}

TEST(MessageOf, AnExceptionSaysWhatToDo) {
  EXPECT_THAT(message_of(std::bad_alloc()), HasSubstr("expected enough memory, found none left; end other programs"));
  EXPECT_EQ(message_of(std::runtime_error("a riddle")), "stopped by a riddle");
}

}  // namespace
}  // namespace yars::runtime
