// Start and end of every program: installed files, common options, log, exit codes.
// Inputs: command line; YARS_SESSION.
// Outputs: exit code 0, kExitFailure or kExitUsage; errors as one line on standard error.
// Threads: call from the first thread.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "databuffer/runtime/command_line.hpp"
#include "lib/error/error.hpp"

namespace yars::databuffer {

// Resolves the name of an installed file (configuration, route, script). A bare name that does not exist in the current
// folder is searched in PREFIX/share/yars/config, its routes and its scripts. PREFIX/bin is the folder of the program,
// so that an installation can be moved. Other names are returned unchanged.
std::string installed_file(const std::string& name, const std::filesystem::path& programs);

// The same, relative to the running program.
std::string installed_file(const std::string& name);

// Common options of all programs.
struct ProgramOptions {
  std::string session = "default";  // --session, else YARS_SESSION, else "default"
  std::string config;               // --config; empty: built-in defaults
  std::string log_level = "info";
  std::string lockstep;  // --lockstep ROLE,ROLE,...[@END_TICK]; empty: live
  std::string log_dir;   // --log-dir DIR: the log also goes to DIR/PROGRAM.log; empty: no file
  bool realtime = false;
  std::string cpus;  // --cpus 2,3; empty: all
};

inline constexpr int kExitFailure = 1;
inline constexpr int kExitUsage = 2;

// Adds --session, --config, --log-level and --version; for a role also --lockstep, --log-dir, --realtime and --cpus.
// The application's name is the program's name.
void add_common_options(CommandLine& app, ProgramOptions& options, bool is_role);

// Parses the command line, makes files private, starts the log, installs signal handlers and runs the body. An error of
// the body becomes one line on standard error and exit code 1. Bad usage is one line and exit code 2.
using ProgramBody = std::function<error::Expected<void>()>;
int run_program(int argc, char** argv, CommandLine& app, const ProgramOptions& options, const ProgramBody& body);

// Parts of run_program(), for a program whose subcommands run during parsing.

// Starts the log, applies CPUs and priority, installs signal handlers.
std::optional<error::Error> begin_program(const std::string& name, const ProgramOptions& options);
void print_failure(const std::string& program, const std::string& message);  // also into the log file

}  // namespace yars::databuffer
