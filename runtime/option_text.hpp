// Texts about an option: what its value is, in --help and in messages. Message about a wrong command line, in the form
// of all messages: "expected ..., found ...; did you mean '...'?".
// Inputs: options of CLI11 whose type name is a kind of value: NUMBER, INTEGER, TEXT, FILE, DIR, another word in
// capitals, or the valid values as {a,b}. Descriptions of their validators are limits: "1 to 8". The state of CLI11
// after a failed parse, the words of the command line. Outputs: the command in which the fault lies, and one line about
// it that names option and value. The help of a program, one entry for each option:
//   --ticks INTEGER             number of ticks (1 to 8; default 2)
// At least two blanks separate an entry's head from what it does; packaging/help/help_text.py reads this form.
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace CLI {
class FormatterBase;
class Option;
}  // namespace CLI

namespace yars::runtime {

// Kinds of values whose names programs know.
inline constexpr const char* kNumber = "NUMBER";
inline constexpr const char* kInteger = "INTEGER";
inline constexpr const char* kText = "TEXT";

// The valid values of an option, for messages: "a number from 0.1 to 1000", "green or gray", "a folder".
std::string expected_value(const CLI::Option& option);

// The words joined by commas, the last two by "or".
std::string joined_by_or(const std::vector<std::string>& words);

// "{a,b}" and back: a kind of value with fixed values. Empty for another kind.
std::string kind_of_fixed_values(const std::vector<std::string>& values);
std::vector<std::string> fixed_values(const CLI::Option& option);

// Text of a limit: whole numbers below 1e15 as digits, others as short as possible.
std::string limit_text(double limit);

// Makes the text of --help.
std::shared_ptr<CLI::FormatterBase> help_formatter();

}  // namespace yars::runtime

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace yars::runtime {

struct UsageMessage {
  std::string command;  // "yars terrain"
  std::string text;     // "expected a command, found 'inof'; did you mean 'info'? See yars terrain --help"
};

// `words`: the command line without the program's name. CLI11's own text is used only for refusals of a value, which
// command_line.cpp words.
UsageMessage usage_message(const CLI::App& app, const CLI::ParseError& outcome, const std::vector<std::string>& words);

// True if a word stands where a command was expected, and is none.
bool has_unknown_command(const CLI::App& app);

// The subcommand of this name. Throws UsageMessage if there is none.
const CLI::App* command_below(const CLI::App& command, const std::string& name);

}  // namespace yars::runtime
