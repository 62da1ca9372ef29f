#include "runtime/command_line.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <concepts>
#include <cstdio>
#include <string_view>
#include <type_traits>

#include "lib/file/text_file.hpp"
#include "lib/log/log.hpp"
#include "lib/text/plain_text.hpp"
#include "runtime/option_text.hpp"
#include "runtime/user_defaults.hpp"

namespace yars::runtime {

void print_failure(const std::string& program, const std::string& message) {
  // The message of a subcommand begins with its name, as in "yars inject: expected ...".
  const std::string prefix = message.starts_with(program + ' ') ? "" : program + ": ";
  std::fprintf(stderr, "%s%s\n", prefix.c_str(), text::printable(message).c_str());
  log::to_file(message);
}

namespace {

// Message of a value that an option does not take.
std::string refusal(const CLI::Option& option, const std::string& found) {
  const auto values = fixed_values(option);
  const std::string shown = found.empty() && !values.empty() ? "an empty one" : "'" + text::shortened(found) + "'";
  std::string text = "expected " + expected_value(option) + ", found " + shown;
  if (const std::string meant = text::did_you_mean(found, values); !meant.empty()) text += "; " + meant;
  return text;
}

// Adds a check that a value fulfils `accepts`. `limit` describes the limit for --help and messages; it may be empty.
void add_check(CLI::Option* option, const std::string& limit, const std::function<bool(const std::string&)>& accepts) {
  const auto check = [option, accepts](std::string& value) {
    return accepts(value) ? std::string() : refusal(*option, value);
  };
  option->check(CLI::Validator(check, limit));
}

template <class Number>
void add_range(CLI::Option* option, Number min, Number max) {
  add_check(option, limit_text(static_cast<double>(min)) + " to " + limit_text(static_cast<double>(max)),
            [min, max](const std::string& value) {
              const auto number = text::finite_number(value);
              return number && *number >= static_cast<double>(min) && *number <= static_cast<double>(max);
            });
}

}  // namespace

Option& Option::required() {
  option_->required();
  return *this;
}
Option& Option::value_name(const std::string& name) {
  option_->type_name(name);
  return *this;
}
Option& Option::otherwise(const std::string& text) {
  option_->option_text(text);
  return *this;
}
Option& Option::range(int min, int max) {
  add_range(option_, min, max);
  return *this;
}
Option& Option::range(double min, double max) {
  add_range(option_, min, max);
  return *this;
}
Option& Option::range(std::uint64_t min, std::uint64_t max) {
  add_range(option_, min, max);
  return *this;
}
Option& Option::one_of(const std::vector<std::string>& values) {
  option_->type_name(kind_of_fixed_values(values));
  add_check(option_, "",
            [values](const std::string& value) { return std::ranges::find(values, value) != values.end(); });
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
Option& Option::in_user_file() {
  option_->configurable(true);
  return *this;
}
bool Option::is_given() const {
  return option_->count() > 0;
}

namespace {

// Type of one value of an option's target.
template <class T>
struct ValueOf {
  using Type = T;
};
template <class T>
struct ValueOf<std::optional<T>> {
  using Type = T;
};
template <class T>
struct ValueOf<std::vector<T>> {
  using Type = T;
};

// Makes an option take only numbers of its type, in the form that CLI11 converts: a sign '+' and leading zeros, which
// CLI11 takes for an octal number, are left out.
template <std::integral Whole>
void take_numbers(CLI::Option* option) {
  option->type_name(kInteger);
  option->transform(CLI::Validator(
      [option](std::string& value) {
        const std::string_view digits = value.starts_with('+') ? std::string_view(value).substr(1) : value;
        const auto number = text::whole_number<Whole>(digits);
        if (!number || digits.starts_with('+')) return refusal(*option, value);
        value = std::to_string(*number);
        return std::string();
      },
      std::is_unsigned_v<Whole> ? "0 or more" : ""));
}
template <std::floating_point Number>
void take_numbers(CLI::Option* option) {
  option->type_name(kNumber);
  option->transform(CLI::Validator(
      [option](std::string& value) {
        const auto number = text::finite_number(value);
        if (!number) return refusal(*option, value);
        value = text::text_of_number(*number);
        return std::string();
      },
      ""));
}

// True if this command or one above it has an option of this name.
bool has_option(const CLI::App* command, const std::string& name) {
  for (; command != nullptr; command = command->get_parent())
    if (command->get_option_no_throw(name) != nullptr) return true;
  return false;
}

// Makes an option refuse an empty text, and the name of another option, before which its own value is missing.
void take_texts(CLI::App* command, CLI::Option* option) {
  option->type_name(kText);
  option->transform(CLI::Validator(
      [command, option](std::string& value) {
        if (value.empty()) return "expected " + expected_value(*option) + ", found an empty one";
        if (!option->nonpositional() || !value.starts_with("--") || !has_option(command, value)) return std::string();
        return "expected " + expected_value(*option) + ", found the option '" + value + "'";
      },
      ""));
}

}  // namespace

template <class T>
Option Command::option(const std::string& names, T& target, const std::string& help) {
  using Value = typename ValueOf<T>::Type;
  CLI::Option* option = app_->add_option(names, target, help);
  option->configurable(false);
  if constexpr (std::is_same_v<Value, T>) option->capture_default_str();
  if constexpr (std::is_same_v<Value, std::string>)
    take_texts(app_, option);
  else
    take_numbers<Value>(option);
  return Option(option);
}
template Option Command::option(const std::string&, std::string&, const std::string&);
template Option Command::option(const std::string&, int&, const std::string&);
template Option Command::option(const std::string&, double&, const std::string&);
template Option Command::option(const std::string&, std::uint64_t&, const std::string&);
template Option Command::option(const std::string&, std::int64_t&, const std::string&);
template Option Command::option(const std::string&, std::optional<int>&, const std::string&);
template Option Command::option(const std::string&, std::optional<double>&, const std::string&);
template Option Command::option(const std::string&, std::optional<std::uint64_t>&, const std::string&);
template Option Command::option(const std::string&, std::vector<std::string>&, const std::string&);
template Option Command::option(const std::string&, std::vector<double>&, const std::string&);

Option Command::flag(const std::string& names, bool& target, const std::string& help) {
  CLI::Option* flag = app_->add_flag(names, target, help);
  flag->configurable(false)->disable_flag_override();
  return Option(flag);
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

CommandLine::CommandLine(const std::string& description, const std::string& name)
    : Command(nullptr), name_(name), owned_(std::make_unique<CLI::App>(description, name)) {
  app_ = owned_.get();
  app_->formatter(help_formatter());
  app_->set_help_flag("-h,--help", "print this help");
}
CommandLine::~CommandLine() = default;

void CommandLine::version(const std::string& text) {
  app_->set_version_flag("--version", text, "print the version");
}
void CommandLine::accept_options_after_subcommands() {
  app_->fallthrough();
}
void CommandLine::before_callbacks(const std::function<void()>& call) {
  app_->parse_complete_callback(call);
}

namespace {

constexpr const char* kHelpCommand = "help";

bool is_help_command(const CLI::App* command) {
  return command->get_name() == kHelpCommand;
}

// `path`: the command with those above it, as in "yars terrain info".
void print_help(const CLI::App& command, const std::string& path) {
  std::fputs(command.get_formatter()->make_help(&command, path, CLI::AppFormatMode::Normal).c_str(), stdout);
}

}  // namespace

void CommandLine::add_help_command() {
  Command help = subcommand(kHelpCommand, "print the help of a command");
  help.option("COMMAND", help_words_, "command, as in " + name_ + " help terrain info")
      .value_name("COMMAND")
      .otherwise("all commands");
  help.callback([this] {
    const CLI::App* command = app_;
    std::string path;
    for (const std::string& word : help_words_) {
      path += (path.empty() ? "" : " ") + command->get_name();
      command = command_below(*command, word);
    }
    print_help(*command, (path.empty() ? "" : path + " ") + command->get_name());
  });
}

namespace {

// Gives an option of the user's file the value that the file has for it. Returns the fault of the value as a message.
std::optional<std::string> use_default(CLI::Option& option, const UserDefaults& defaults) {
  if (!option.get_configurable() || option.get_lnames().empty()) return std::nullopt;
  const auto found = defaults.values.find(option.get_lnames().front());
  if (found == defaults.values.end()) return std::nullopt;
  try {
    option.default_val(found->second.value)->required(false)->option_text("");
  } catch (const CLI::ValidationError& fault) {
    return file::line_location(defaults.file, found->second.line) + ": " + fault.what();
  }
  return std::nullopt;
}

// Does so for the options of a command and of all commands below it.
std::optional<std::string> use_defaults(CLI::App& command, const UserDefaults& defaults) {
  for (CLI::Option* option : command.get_options())
    if (auto fault = use_default(*option, defaults)) return fault;
  for (CLI::App* below : command.get_subcommands([](const CLI::App*) { return true; }))
    if (auto fault = use_defaults(*below, defaults)) return fault;
  return std::nullopt;
}

// Gives options the values of the user's file. Returns the fault of that file as a message.
std::optional<std::string> use_user_file(CLI::App& app) {
  const auto defaults = read_user_defaults();
  return defaults ? use_defaults(app, *defaults) : defaults.error().message();
}

bool asks_for_help(const std::vector<std::string>& words) {
  const auto asks = [](const std::string& word) { return word == "--help" || word == "-h" || word == "--version"; };
  return std::ranges::any_of(words, asks) || (!words.empty() && words.front() == kHelpCommand);
}

}  // namespace

std::optional<int> CommandLine::parse(int argc, char** argv) {
  const std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
  if (words.empty() && !app_->get_subcommands(is_help_command).empty()) {
    print_help(*app_, name_);
    return 0;
  }
  // The fault waits: help does not depend on the file.
  if (const auto fault = use_user_file(*app_); fault && !asks_for_help(words)) {
    print_failure(name_, *fault);
    return kExitFailure;
  }
  try {
    app_->parse(argc, argv);
    return std::nullopt;
  } catch (const CLI::ParseError& outcome) {
    const bool is_success = outcome.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success);
    const bool is_version = dynamic_cast<const CLI::CallForVersion*>(&outcome) != nullptr;
    if (is_version || (is_success && !has_unknown_command(*app_))) return app_->exit(outcome);
    const UsageMessage message = usage_message(*app_, outcome, words);
    print_failure(message.command, message.text);
    return kExitUsage;
  } catch (const UsageMessage& message) {
    print_failure(message.command, message.text);
    return kExitUsage;
  }
}

}  // namespace yars::runtime
