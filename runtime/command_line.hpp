// Command line of a program: options, flags, subcommands. Only this unit, option_text and usage_message include CLI11,
// because CLI11 adds seconds of compile time to each unit that includes it.
// Inputs: argc, argv; the user's file of defaults (user_defaults.hpp).
// Outputs: values in the targets of options and flags; calls of the callbacks of the given subcommands.
// Errors: a usage error is one line on standard error and exit code 2; a fault in the user's file is one line and exit
// code 1. --help and --version give exit code 0.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace yars::runtime {

inline constexpr int kExitFailure = 1;
inline constexpr int kExitUsage = 2;

// Writes the reason for the end of a program as one line to standard error and to the log file.
void print_failure(const std::string& program, const std::string& message);

// Handle of an option or a flag, which the command line owns. --help shows the value that the target has when the
// option is added as its default, unless the target is a vector, a std::optional or an empty text.
class Option {
 public:
  explicit Option(CLI::Option* option) : option_(option) {}

  Option& required();
  // Kind of the value in --help: FILE and DIR, which shells complete, or another word in capitals.
  Option& value_name(const std::string& name);
  // What holds without the option, for --help: "the configuration's". For options without a default to show.
  Option& otherwise(const std::string& text);
  // Both limits are valid values.
  Option& range(int min, int max);
  Option& range(double min, double max);
  Option& range(std::uint64_t min, std::uint64_t max);
  Option& one_of(const std::vector<std::string>& values);
  Option& values(int count);  // takes exactly `count` values
  Option& repeatable();       // may occur several times, with one value each; the target is a vector
  // Replaces the text of the value by change(text) before the value is parsed and checked.
  Option& transform(const std::function<std::string(const std::string&)>& change);
  Option& needs(const Option& other);
  Option& excludes(const Option& other);
  // The user's file may set the default of this option, under its long name. A required option then need not be given.
  Option& in_user_file();
  bool is_given() const;  // on the command line

 private:
  CLI::Option* option_;
};

// Handle of a command or subcommand, which the command line owns.
class Command {
 public:
  // `names` in the form of CLI11: "--out", "-o,--out", or "FILE" for an argument. T: std::string, int, double,
  // std::int64_t, std::uint64_t, std::optional of a number, std::vector of std::string or double.
  template <class T>
  Option option(const std::string& names, T& target, const std::string& help = {});
  Option flag(const std::string& names, bool& target, const std::string& help = {});
  Command subcommand(const std::string& name, const std::string& help);
  void require_subcommand();
  void callback(const std::function<void()>& call);
  // True if any subcommand, or the one with this name, was given. Valid after parse().
  bool has_subcommand() const;
  bool has_subcommand(const std::string& name) const;
  Option find(const std::string& name) const;  // option of this command by its name

 protected:
  explicit Command(CLI::App* app) : app_(app) {}
  CLI::App* app_;
};

class CommandLine : public Command {
 public:
  CommandLine(const std::string& description, const std::string& name);
  ~CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  const std::string& name() const { return name_; }
  void version(const std::string& text);
  // Accepts the options of this command also after a subcommand.
  void accept_options_after_subcommands();
  // Adds the subcommand `help COMMAND...`, which prints the help of a command. Without any word, parse() then prints
  // the help of the program with exit code 0.
  void add_help_command();
  // Sets a function that parse() calls after parsing and before the callbacks of subcommands.
  void before_callbacks(const std::function<void()>& call);
  // Parses the arguments and runs the callbacks. Returns the exit code if the program is to end: after an error,
  // --help or --version. A number that is NaN or infinite and an empty text are usage errors. Exceptions of callbacks
  // are not caught.
  std::optional<int> parse(int argc, char** argv);

 private:
  std::string name_;
  std::unique_ptr<CLI::App> owned_;
  std::vector<std::string> help_words_;  // the command of `help COMMAND...`
};

}  // namespace yars::runtime
