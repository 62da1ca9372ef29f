// Command line of a program: options, flags, subcommands. Only command_line.cpp includes CLI11, which takes seconds of
// compile time in every unit that does.
// Inputs: argc, argv. Outputs: the targets of options and flags; callbacks of the subcommands that were given.
// Errors: bad usage is one line on standard error and exit code 2; --help and --version end with 0.
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

namespace yars::databuffer {

inline constexpr int kExitFailure = 1;
inline constexpr int kExitUsage = 2;

// Writes the end of a program as one line to standard error and to the log file.
void print_failure(const std::string& program, const std::string& message);

// Handle of an option or a flag; its command owns it.
class Option {
 public:
  explicit Option(CLI::Option* option) : option_(option) {}

  Option& required();
  Option& show_default();  // in --help
  // Both ends included.
  Option& range(int least, int most);
  Option& range(double least, double most);
  Option& range(std::uint64_t least, std::uint64_t most);
  Option& not_negative();
  Option& one_of(const std::vector<std::string>& values);
  Option& values(int count);  // exactly so many
  Option& repeatable();       // of a vector: one value behind each occurrence
  Option& transform(const std::function<std::string(const std::string&)>& change);
  Option& needs(const Option& other);
  Option& excludes(const Option& other);
  bool is_given() const;

 private:
  CLI::Option* option_;
};

// Handle of a command or subcommand; its command line owns it.
class Command {
 public:
  // `names` as CLI11 writes them: "--out", "-o,--out", or "FILE" for an argument. T: std::string, bool, int, double,
  // std::uint64_t, std::optional of a number, std::vector of std::string or double (command_line.cpp has the list).
  template <class T>
  Option option(const std::string& names, T& target, const std::string& help = {});
  Option flag(const std::string& names, bool& target, const std::string& help = {});
  Command subcommand(const std::string& name, const std::string& help);
  void require_subcommand();
  void callback(const std::function<void()>& call);
  // After the parse: whether a subcommand was given; the one of this name.
  bool has_subcommand() const;
  bool has_subcommand(const std::string& name) const;
  Option find(const std::string& name) const;  // an option of this command

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
  // Options of this command are also understood behind a subcommand.
  void accept_behind_subcommands();
  // Called when all is parsed and before the callbacks of subcommands.
  void before_callbacks(const std::function<void()>& call);
  // Parses and runs the callbacks. The program's exit code where it ends here: bad usage, --help, --version. NaN and
  // infinity are refused for every number: they pass each comparison of a range. Exceptions of callbacks pass through.
  std::optional<int> parse(int argc, char** argv);

 private:
  std::string name_;
  std::unique_ptr<CLI::App> owned_;
};

}  // namespace yars::databuffer
