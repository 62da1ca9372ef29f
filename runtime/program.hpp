// Startup and exit of every program: common options, log, exit codes.
// Inputs: command line; YARS_SESSION.
// Outputs: exit code 0, kExitFailure or kExitUsage; errors as one line on standard error.
// Threads: main thread only.
#pragma once

#include <cstdint>
#include <exception>
#include <functional>
#include <optional>
#include <string>

#include "lib/error/error.hpp"
#include "runtime/command_line.hpp"

namespace yars::runtime {

// A command; a program that runs for the time of a session; such a program that also runs the tick loop.
enum class ProgramKind : std::uint8_t { command, service, role };

// Values of the options that all programs share; from `lockstep` on, of those that only roles have.
struct ProgramOptions {
  ProgramKind kind = ProgramKind::command;  // set by add_common_options()
  std::string session = "default";          // --session, else YARS_SESSION, else "default"
  std::string config;                       // --config; empty: built-in defaults
  std::string log_level = "info";
  std::string lockstep;   // --lockstep ROLE,ROLE,...[@END_TICK]; empty: no lockstep
  std::string log_dir;    // --log-dir DIR: also logs to DIR/PROGRAM.log; empty: no file
  bool realtime = false;  // --realtime: locked memory and SCHED_FIFO
  std::string cpus;       // --cpus 2,3: CPU affinity; empty: all
};

// Adds --session, --config, --log-level and --version; for services and roles also --log-dir, --realtime and --cpus;
// for roles --lockstep.
void add_common_options(CommandLine& app, ProgramOptions& options, ProgramKind kind);

// Main function of a program. Parses the command line, sets a private umask, starts the log, installs signal handlers
// and runs the body. A role or service ends within a second of SIGTERM, also in the midst of a body. Returns the exit
// code. An error or exception of the body is printed as one line on standard error. The exit code is then kExitUsage
// for a usage error, else kExitFailure. The name of `app` is the program's name.
using ProgramBody = std::function<error::Expected<void>()>;
int run_program(int argc, char** argv, CommandLine& app, const ProgramOptions& options, const ProgramBody& body);

// The one line that a program prints when an exception ends it.
std::string message_of(const std::exception& problem);

// Closes standard output at the end of main and returns the exit code of the program. If a write to standard output has
// failed, prints one line on standard error and returns kExitFailure in place of 0.
int exit_code_after_output(const std::string& program, int exit_code);

// Starts the log, applies --cpus and --realtime, and installs signal handlers. run_program() calls begin_program(). A
// program with subcommands that run during the parse of the command line calls begin_program() directly. Returns a
// usage error if the log level, the session name or the CPU list is not valid, else nullopt.
std::optional<error::Error> begin_program(const std::string& name, const ProgramOptions& options);

}  // namespace yars::runtime
