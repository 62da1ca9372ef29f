// Message about a wrong command line, in the form of all messages: "expected ..., found ...; did you mean '...'?".
// Inputs: the state of CLI11 after a failed parse, the words of the command line.
// Outputs: the command in which the fault lies; one line about it that names option and value.
#pragma once

#include <string>
#include <vector>

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
