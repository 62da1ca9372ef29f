#include "databuffer/runtime/command_line.hpp"

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "lib/log/log.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::databuffer {

void print_failure(const std::string& program, const std::string& message) {
  std::fprintf(stderr, "%s: %s\n", program.c_str(), text::printable(message).c_str());
  log::to_file(message);
}

Option& Option::required() {
  option_->required();
  return *this;
}
Option& Option::show_default() {
  option_->capture_default_str();
  return *this;
}
Option& Option::range(int min, int max) {
  option_->check(CLI::Range(min, max));
  return *this;
}
Option& Option::range(double min, double max) {
  option_->check(CLI::Range(min, max));
  return *this;
}
Option& Option::range(std::uint64_t min, std::uint64_t max) {
  option_->check(CLI::Range(min, max));
  return *this;
}
Option& Option::not_negative() {
  option_->check(CLI::NonNegativeNumber);
  return *this;
}
Option& Option::one_of(const std::vector<std::string>& values) {
  option_->check(CLI::IsMember(values));
  return *this;
}
Option& Option::values(int count) {
  option_->expected(count);
  return *this;
}
Option& Option::repeatable() {
  option_->allow_extra_args(false);
  return *this;
}
Option& Option::transform(const std::function<std::string(const std::string&)>& change) {
  option_->transform([change](const std::string& text) { return change(text); });
  return *this;
}
Option& Option::needs(const Option& other) {
  option_->needs(other.option_);
  return *this;
}
Option& Option::excludes(const Option& other) {
  option_->excludes(other.option_);
  return *this;
}
bool Option::is_given() const {
  return option_->count() > 0;
}

template <class T>
Option Command::option(const std::string& names, T& target, const std::string& help) {
  return Option(app_->add_option(names, target, help));
}
template Option Command::option(const std::string&, std::string&, const std::string&);
template Option Command::option(const std::string&, int&, const std::string&);
template Option Command::option(const std::string&, double&, const std::string&);
template Option Command::option(const std::string&, std::uint64_t&, const std::string&);
template Option Command::option(const std::string&, std::int64_t&, const std::string&);
template Option Command::option(const std::string&, std::optional<int>&, const std::string&);
template Option Command::option(const std::string&, std::optional<double>&, const std::string&);
template Option Command::option(const std::string&, std::vector<std::string>&, const std::string&);
template Option Command::option(const std::string&, std::vector<double>&, const std::string&);

Option Command::flag(const std::string& names, bool& target, const std::string& help) {
  return Option(app_->add_flag(names, target, help));
}
Command Command::subcommand(const std::string& name, const std::string& help) {
  return Command(app_->add_subcommand(name, help));
}
void Command::require_subcommand() {
  app_->require_subcommand(1);
}
void Command::callback(const std::function<void()>& call) {
  app_->callback(call);
}
bool Command::has_subcommand() const {
  return !app_->get_subcommands().empty();
}
bool Command::has_subcommand(const std::string& name) const {
  return app_->got_subcommand(name);
}
Option Command::find(const std::string& name) const {
  return Option(app_->get_option(name));
}

namespace {
// Makes all options and arguments, also those of subcommands, refuse values that CLI11 accepts and no command can use:
// NaN and infinity for a floating-point number, and an empty text.
void refuse_unusable_values(CLI::App& app) {
  const CLI::Validator not_empty(
      [](std::string& text) { return text.empty() ? "expected a text, found an empty one" : std::string(); }, "");
  const CLI::Validator finite(
      [](std::string& text) {
        char* end = nullptr;
        const double value = std::strtod(text.c_str(), &end);
        const bool number = end != text.c_str() && *end == '\0';  // CLI11 itself refuses a text that is not a number
        return !number || std::isfinite(value) ? std::string() : "expected a finite number, found " + text;
      },
      "");
  // transform() runs before the range check.
  for (CLI::Option* option : app.get_options()) {
    const std::string type = option->get_type_name();
    if (type.starts_with("FLOAT")) option->transform(finite);
    if (type.starts_with("TEXT")) option->transform(not_empty);
  }
  for (CLI::App* subcommand : app.get_subcommands([](const CLI::App*) { return true; }))
    refuse_unusable_values(*subcommand);
}
}  // namespace

CommandLine::CommandLine(const std::string& description, const std::string& name)
    : Command(nullptr), name_(name), owned_(std::make_unique<CLI::App>(description, name)) {
  app_ = owned_.get();
}
CommandLine::~CommandLine() = default;

void CommandLine::version(const std::string& text) {
  app_->set_version_flag("--version", text);
}
void CommandLine::accept_options_after_subcommands() {
  app_->fallthrough();
}
void CommandLine::before_callbacks(const std::function<void()>& call) {
  app_->parse_complete_callback(call);
}

std::optional<int> CommandLine::parse(int argc, char** argv) {
  try {
    refuse_unusable_values(*app_);
    app_->parse(argc, argv);
    return std::nullopt;
  } catch (const CLI::ParseError& outcome) {
    if (outcome.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) return app_->exit(outcome);
    print_failure(name_, std::string(outcome.what()) + "; see " + name_ + " --help");
    return kExitUsage;
  }
}

}  // namespace yars::databuffer
