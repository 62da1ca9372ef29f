// Programs of the set: installed files, options, exit codes, log.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "lib/error/error.hpp"

namespace yars::databuffer {

// Files that are installed beside the programs: configurations, routes, scripts. They are found from where the program
// lies (PREFIX/bin), so that an installation may be moved. A bare name that is no file here and stands in
// PREFIX/share/yars/config or its folders is that file; anything else stays as it is.
std::string installed_file(const std::string& name, const std::filesystem::path& programs);

// The same for this program.
std::string installed_file(const std::string& name);

// What all programs of the set share: options, exit codes.
struct ProgramOptions {
  std::string session = "default";  // --session, else YARS_SESSION, else "default"
  std::string config;               // --config; empty = built-in defaults
  std::string log_level = "info";
  std::string lockstep;  // --lockstep ROLE,ROLE,...[@END_TICK]; empty = live
  std::string log_dir;   // --log-dir DIR: the log also goes to DIR/PROGRAM.log; empty = no file
  bool realtime = false;
  std::string cpus;  // --cpus 2,3: empty = all
};

inline constexpr int kExitFailure = 1;
inline constexpr int kExitUsage = 2;

// Adds --session, --config, --log-level, --version (and for a role --lockstep, --log-dir, --realtime, --cpus). The
// application's name is the program's.
void add_common_options(CLI::App& app, ProgramOptions& options, bool is_role);

// Every option and argument of the application and its subcommands that takes a number with a fraction refuses NaN and
// infinity: they pass each comparison of a range. Call it when all options are added and before anything is parsed.
void require_finite_numbers(CLI::App& app);

// Parses, keeps what is written private, starts the log, installs the handlers of SIGINT and SIGTERM and runs the body;
// the body's error becomes one line on standard error and exit code 1. Bad usage is one line and exit code 2.
using ProgramBody = std::function<error::Expected<void>()>;
int run_program(int argc, char** argv, CLI::App& app, const ProgramOptions& options, const ProgramBody& body);

// The parts of run_program, for a program whose subcommands run while it parses.
int report_parse_outcome(const CLI::App& app, const CLI::ParseError& outcome);  // prints help or one line; exit code
// Log, CPUs and priority, signals.
std::optional<error::Error> begin_program(const std::string& name, const ProgramOptions& options);
void print_failure(const std::string& program, const std::string& message);  // into the log file too

}  // namespace yars::databuffer
