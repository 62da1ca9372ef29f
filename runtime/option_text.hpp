// Texts about an option: what its value is, in --help and in messages.
// Inputs: options of CLI11 whose type name is a kind of value: NUMBER, INTEGER, TEXT, FILE, DIR, another word in
// capitals, or the valid values as {a,b}. Descriptions of their validators are limits: "1 to 8".
// Outputs: the help of a program, one entry for each option:
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
