#include "databuffer/runtime/program.hpp"

#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <system_error>

#include "databuffer/runtime/process.hpp"
#include "databuffer/session/session.hpp"
#include "lib/log/log.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::databuffer {

namespace fs = std::filesystem;

std::string installed_file(const std::string& name, const fs::path& programs) {
  std::error_code problem;
  // A path with a folder, or an existing file, is used as it is.
  if (name.empty() || name.find('/') != std::string::npos || fs::exists(name, problem)) return name;
  const fs::path installed = programs.parent_path() / "share/yars/config";
  for (const char* folder : {"", "routes", "scripts"})
    if (const fs::path file = installed / folder / name; fs::is_regular_file(file, problem)) return file.string();
  return name;
}

std::string installed_file(const std::string& name) {
  std::error_code problem;
  const fs::path program = fs::read_symlink("/proc/self/exe", problem);
  return problem ? name : installed_file(name, program.parent_path());
}

namespace {

// Applies --cpus and --realtime. If the operating system refuses, it logs a warning. Error: a malformed CPU list.
std::optional<error::Error> arrange_cpus(const ProgramOptions& options) {
  const auto warn = [](const std::optional<std::string>& refusal) {
    if (refusal) log::warning(*refusal);
    return !refusal;
  };
  if (!options.cpus.empty()) {
    const auto cpus = parse_cpu_list(options.cpus);
    if (!cpus) return cpus.error();
    warn(bind_to_cpus(*cpus));
  }
  if (!options.realtime) return std::nullopt;
  if (warn(lock_memory())) log::info("--realtime: memory is locked");
  if (warn(take_realtime_priority()))
    log::info("--realtime: SCHED_FIFO " + std::to_string(kRealtimePriority) + ", at most " +
              std::to_string(kMaxBurst_ms) + " ms without a wait");
  return std::nullopt;
}

}  // namespace

void add_common_options(CLI::App& app, ProgramOptions& options, bool is_role) {
  if (const char* session = std::getenv("YARS_SESSION"); session != nullptr && *session != '\0')
    options.session = session;
  app.set_version_flag("--version", std::string(YARS_VERSION));
  app.add_option("--session", options.session, "session to join or make (else $YARS_SESSION, else 'default')");
  app.add_option("--config", options.config, "GUF configuration file (else the built-in APG-70)")
      ->transform([](const std::string& name) { return installed_file(name); });
  app.add_option("--log-level", options.log_level, "trace, debug, info, warning, error or off");
  if (!is_role) return;
  app.add_option("--lockstep", options.lockstep,
                 "roles that step together on sim time, ROLE,ROLE,...[@END_TICK]; the same for all of them");
  app.add_option("--log-dir", options.log_dir, "folder in which the log is kept too, rotated (else no file)");
  app.add_flag("--realtime", options.realtime, "locked memory and SCHED_FIFO for the tick; says what is refused");
  app.add_option("--cpus", options.cpus, "CPUs to run on, as in 2,3 or 2-3 (else all)");
}

void require_finite_numbers(CLI::App& app) {
  const CLI::Validator finite(
      [](std::string& text) {
        char* end = nullptr;
        const double value = std::strtod(text.c_str(), &end);
        const bool number = end != text.c_str() && *end == '\0';  // other text is refused by the option itself
        return !number || std::isfinite(value) ? std::string() : "expected a finite number, found " + text;
      },
      "");
  // A transform() runs before the range check of its option.
  for (CLI::Option* option :
       app.get_options([](const CLI::Option* any) { return any->get_type_name().starts_with("FLOAT"); }))
    option->transform(finite);
  for (CLI::App* subcommand : app.get_subcommands([](const CLI::App*) { return true; }))
    require_finite_numbers(*subcommand);
}

void print_failure(const std::string& program, const std::string& message) {
  std::fprintf(stderr, "%s: %s\n", program.c_str(), text::printable(message).c_str());
  log::to_file(message);
}

int report_parse_outcome(const CLI::App& app, const CLI::ParseError& outcome) {
  if (outcome.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) return app.exit(outcome);
  print_failure(app.get_name(), std::string(outcome.what()) + "; see " + app.get_name() + " --help");
  return kExitUsage;
}

std::optional<error::Error> begin_program(const std::string& name, const ProgramOptions& options) {
  if (!log::start(name, options.log_level))
    return error::usage_error("--log-level", "trace, debug, info, warning, error or off",
                              "'" + options.log_level + "'");
  if (const auto valid = check_session_name(options.session); !valid) return valid.error();
  if (!options.log_dir.empty()) log::start_file(name, options.log_dir);
  if (auto error = arrange_cpus(options)) return error;
  install_signal_handlers();
  return std::nullopt;
}

int run_program(int argc, char** argv, CLI::App& app, const ProgramOptions& options, const ProgramBody& body) {
  sanitize_terminal_output();
  try {
    require_finite_numbers(app);
    app.parse(argc, argv);
  } catch (const CLI::ParseError& outcome) {
    return report_parse_outcome(app, outcome);
  }
  try {
    set_private_umask();
    auto error = begin_program(app.get_name(), options);
    // A write to a closed pipe returns an error instead of ending the program.
    std::signal(SIGPIPE, SIG_IGN);
    if (!error) {
      if (auto outcome = body(); !outcome) error = outcome.error();
    }
    log::suppressed_text(log::Suppressed::all);
    if (!error) return 0;
    print_failure(app.get_name(), error->message());
    return error->bad_usage ? kExitUsage : kExitFailure;
  } catch (const std::exception& problem) {
    print_failure(app.get_name(), std::string("stopped by ") + problem.what());
    return kExitFailure;
  }
}

}  // namespace yars::databuffer
