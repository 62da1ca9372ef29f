#include "runtime/program.hpp"

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <system_error>

#include "databuffer/session/session.hpp"
#include "lib/file/text_file.hpp"
#include "lib/log/log.hpp"
#include "lib/text/plain_text.hpp"
#include "runtime/process.hpp"

namespace yars::runtime {

namespace {

// Applies --cpus and --realtime. A refusal by the system is a warning; a malformed CPU list is a usage error.
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
    log::info("--realtime: SCHED_FIFO " + std::to_string(kRealtimePriority) + "; after " +
              std::to_string(kMaxBurst_ms) + " ms of computing without a wait the priority becomes normal");
  return std::nullopt;
}

}  // namespace

void add_common_options(CommandLine& app, ProgramOptions& options, ProgramKind kind) {
  options.kind = kind;
  const char* session = std::getenv("YARS_SESSION");
  const bool has_session = session != nullptr && *session != '\0';
  if (has_session) options.session = session;
  app.version(YARS_VERSION);
  Option session_option = app.option("--session", options.session, "session to join or create");
  session_option.value_name("SESSION").otherwise("$YARS_SESSION");
  if (!has_session) session_option.in_user_file();
  app.option("--config", options.config, "GUF configuration file")
      .value_name("FILE")
      .otherwise("the built-in APG-70")
      .transform([](const std::string& name) { return file::installed_file(name); })
      .in_user_file();
  app.option("--log-level", options.log_level, "lines of this level and above are logged")
      .one_of({"trace", "debug", "info", "warning", "error", "off"})
      .in_user_file();
  if (kind == ProgramKind::command) return;
  if (kind == ProgramKind::role)
    app.option("--lockstep", options.lockstep,
               "roles that step together on sim time, ROLE,ROLE,...[@END_TICK]; give all these roles the same value")
        .value_name("ROLES")
        .otherwise("live");
  app.option("--log-dir", options.log_dir, "folder for a rotated log file")
      .value_name("DIR")
      .otherwise("no file")
      .in_user_file();
  app.flag("--realtime", options.realtime, "lock memory, run the tick loop under SCHED_FIFO; a refusal is logged");
  app.option("--cpus", options.cpus, "CPUs to run on, as in 2,3 or 2-3").value_name("LIST").otherwise("all");
}

std::optional<error::Error> begin_program(const std::string& name, const ProgramOptions& options) {
  if (!log::start(name, options.log_level))
    return error::usage_error("--log-level", "trace, debug, info, warning, error or off",
                              "'" + options.log_level + "'");
  if (const auto valid = databuffer::check_session_name(options.session); !valid) return valid.error();
  if (!options.log_dir.empty()) log::start_file(name, options.log_dir);
  if (auto error = arrange_cpus(options)) return error;
  install_signal_handlers();
  return std::nullopt;
}

std::string message_of(const std::exception& problem) {
  if (dynamic_cast<const std::bad_alloc*>(&problem) != nullptr)
    return "expected enough memory, found none left; end other programs, ask for less, or raise the limit (ulimit -v)";
  return std::string("stopped by ") + problem.what();
}

int exit_code_after_output(const std::string& program, int exit_code) {
  const auto closed = close_standard_output();
  if (closed) return exit_code;
  print_failure(program, closed.error().message());
  return exit_code == 0 ? kExitFailure : exit_code;
}

namespace {

int run_body(CommandLine& app, const ProgramOptions& options, const ProgramBody& body) {
  try {
    set_private_umask();
    auto error = begin_program(app.name(), options);
    if (options.kind != ProgramKind::command) end_soon_after_signals();
    // SIGPIPE is ignored, so that a role continues when the reader of its log has closed the pipe.
    std::signal(SIGPIPE, SIG_IGN);
    if (!error) {
      if (auto outcome = body(); !outcome) error = outcome.error();
    }
    log::report_suppressed(log::SuppressedKinds::all);
    if (!error) return 0;
    print_failure(app.name(), error->message());
    return error->bad_usage() ? kExitUsage : kExitFailure;
  } catch (const std::exception& problem) {
    print_failure(app.name(), message_of(problem));
    return kExitFailure;
  }
}

}  // namespace

int run_program(int argc, char** argv, CommandLine& app, const ProgramOptions& options, const ProgramBody& body) {
  sanitize_terminal_output();
  auto exit_code = app.parse(argc, argv);
  if (!exit_code) exit_code = run_body(app, options, body);
  return exit_code_after_output(app.name(), *exit_code);
}

}  // namespace yars::runtime
