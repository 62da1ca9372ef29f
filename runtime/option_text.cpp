#include "runtime/option_text.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "lib/error/error.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::runtime {

namespace {

constexpr std::size_t kColumn = 30;  // where the description of an entry begins

// Kind and limit of a value: "NUMBER" and "0.1 to 1000". The limit may be empty. CLI11 joins the kind and all limits by
// colons. The last limit is the narrowest.
std::pair<std::string, std::string> kind_and_limit(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::size_t colon = type.find(':');
  if (colon == std::string::npos) return {type, {}};
  return {type.substr(0, colon), type.substr(type.rfind(':') + 1)};
}

std::string kind_of(const CLI::Option& option) {
  return kind_and_limit(option).first;
}

}  // namespace

std::string joined_by_or(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) text += i + 1 < words.size() ? ", " : " or ";
    text += words[i];
  }
  return text;
}

std::string kind_of_fixed_values(const std::vector<std::string>& values) {
  std::string kind;
  for (const std::string& value : values) kind += (kind.empty() ? "{" : ",") + value;
  return kind + "}";
}

std::vector<std::string> fixed_values(const CLI::Option& option) {
  const std::string kind = kind_of(option);
  if (!kind.starts_with('{')) return {};
  std::vector<std::string> values;
  for (const std::string_view value : text::fields_of(std::string_view(kind).substr(1, kind.size() - 2), ','))
    values.emplace_back(value);
  return values;
}

std::string limit_text(double limit) {
  constexpr double kMaxDigits = 1e15;
  if (limit == std::round(limit) && std::abs(limit) < kMaxDigits) return std::to_string(std::llround(limit));
  return text::text_of_number(limit);
}

std::string expected_value(const CLI::Option& option) {
  static constexpr std::array<std::pair<const char*, const char*>, 6> kKinds{{{kNumber, "a number"},
                                                                              {kInteger, "a whole number"},
                                                                              {kText, "a text"},
                                                                              {"FILE", "a file"},
                                                                              {"DIR", "a folder"},
                                                                              {"SESSION", "the name of a session"}}};
  if (const auto values = fixed_values(option); !values.empty()) return joined_by_or(values);
  const auto [kind, limit] = kind_and_limit(option);
  std::string text = kind;
  for (const auto& [name, words] : kKinds)
    if (kind == name) text = words;
  if (limit.empty()) return text;
  return text + (limit.find(" to ") == std::string::npos ? ", " : " from ") + limit;
}

namespace {

// Names in the order of the alphabet: CLI11 has options in the order of their addresses.
std::string names_of(const std::set<CLI::Option*>& options) {
  std::set<std::string> names;
  for (const CLI::Option* option : options) names.insert(option->get_name());
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

// What --help says in parentheses: limit, relations to other options, default.
std::vector<std::string> facts_of(const CLI::Option& option, bool is_positional) {
  std::vector<std::string> facts;
  const auto [kind, limit] = kind_and_limit(option);
  if (!limit.empty()) facts.push_back(limit);
  if (!option.get_needs().empty()) facts.push_back("needs " + names_of(option.get_needs()));
  if (!option.get_excludes().empty()) facts.push_back("not with " + names_of(option.get_excludes()));
  const bool in_two_ways = option.get_positional() && option.nonpositional();
  if (option.get_required())
    facts.push_back(in_two_ways ? "required, " +
                                      (is_positional ? "or as " + option.get_name() : "or as " + option.get_name(true))
                                : "required");
  if (!option.get_option_text().empty()) facts.push_back("else " + option.get_option_text());
  if (!option.get_default_str().empty() && !option.get_required())
    facts.push_back("default " + option.get_default_str());
  return facts;
}

// Formatter of --help in the form that option_text.hpp describes.
class HelpFormatter : public CLI::Formatter {
 public:
  HelpFormatter() { column_width(kColumn); }

  // Versions of CLI11 differ in the empty lines at the end; here there is none.
  std::string make_help(const CLI::App* command, std::string name, CLI::AppFormatMode mode) const override {
    std::string text = CLI::Formatter::make_help(command, std::move(name), mode);
    while (text.ends_with("\n\n")) text.pop_back();
    return text;
  }
  std::string make_option(const CLI::Option* option, bool is_positional) const override {
    return entry(head(*option, is_positional), description(*option, is_positional));
  }
  std::string make_subcommand(const CLI::App* command) const override {
    return entry(command->get_name(), command->get_description());
  }

 private:
  static std::string entry(const std::string& head, const std::string& description) {
    const std::string margin(kColumn, ' ');
    std::string text = "  " + head;
    if (!description.empty()) {
      // Two blanks at least, so that a reader of this text finds the end of the head.
      if (text.size() + 2 > kColumn) text += "\n";
      text.resize(text.ends_with('\n') ? text.size() + kColumn : kColumn, ' ');
    }
    for (const char character : description) {
      text += character;
      if (character == '\n') text += margin;
    }
    return text + "\n";
  }

  // Names of an option, or of an argument its one name; then the kind of the value, unless it is that name.
  static std::string head(const CLI::Option& option, bool is_positional) {
    std::string text = is_positional ? option.get_name(true) : names(option);
    if (option.get_items_expected_max() == 0) return text;
    if (const std::string kind = kind_of(option); kind != text) text += " " + kind;
    if (option.get_expected_max() >= CLI::detail::expected_max_vector_size) return text + " ...";
    return option.get_expected_min() > 1 ? text + " x " + std::to_string(option.get_expected_min()) : text;
  }
  static std::string names(const CLI::Option& option) {
    std::string text;
    for (const std::string& name : option.get_snames()) text += (text.empty() ? "-" : ",-") + name;
    for (const std::string& name : option.get_lnames()) text += (text.empty() ? "--" : ",--") + name;
    return text;
  }

  static std::string description(const CLI::Option& option, bool is_positional) {
    const std::string& help = option.get_description();
    std::string facts;
    for (const std::string& fact : facts_of(option, is_positional)) facts += (facts.empty() ? "(" : "; ") + fact;
    if (facts.empty()) return help;
    if (help.empty()) return facts + ")";
    return help + (help.find('\n') == std::string::npos ? " " : "\n") + facts + ")";
  }
};

}  // namespace

std::shared_ptr<CLI::FormatterBase> help_formatter() {
  return std::make_shared<HelpFormatter>();
}

namespace {

using error::Error;

// The commands of the command line: the program, its subcommand, and so on.
std::vector<const CLI::App*> chain_of(const CLI::App& app) {
  std::vector<const CLI::App*> chain{&app};
  while (!chain.back()->get_subcommands().empty()) chain.push_back(chain.back()->get_subcommands().front());
  return chain;
}

// "yars terrain info"
std::string path_of(const CLI::App* command) {
  const CLI::App* parent = command->get_parent();
  return parent == nullptr ? command->get_name() : path_of(parent) + " " + command->get_name();
}

std::vector<const CLI::App*> commands_below(const CLI::App& command) {
  return command.get_subcommands([](const CLI::App*) { return true; });
}

std::vector<std::string> names_below(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::App* below : commands_below(command)) names.push_back(below->get_name());
  return names;
}

bool is_option_like(const std::string& word) {
  return word.size() > 1 && word.starts_with('-') && !text::finite_number(word);
}

// The message, with the command whose help has more.
UsageMessage message_with_help(const CLI::App* command, const std::string& text) {
  const std::string path = path_of(command);
  return {path, text + (text.ends_with('?') ? " See " : "; see ") + path + " --help"};
}
UsageMessage message_with_help(const CLI::App* command, const Error& error) {
  return message_with_help(command, error.message());
}

UsageMessage unknown_command(const CLI::App* command, const std::string& word) {
  const auto names = names_below(*command);
  const std::string meant = text::did_you_mean(word, names);
  return message_with_help(command, {"", meant.empty() ? "a command: " + joined_by_or(names) : "a command",
                                     "'" + word + "'", meant, ErrorCode::argument});
}

// Words that no command has taken, in the order of the command line.
std::vector<std::string> words_left(const CLI::App& app) {
  std::vector<std::string> words = app.remaining(true);
  std::erase(words, "--");
  return words;
}

UsageMessage unknown_option(const std::vector<const CLI::App*>& chain, const std::string& word) {
  std::vector<std::string> names;
  for (auto command = chain.rbegin(); command != chain.rend(); ++command)
    for (const CLI::Option* option : (*command)->get_options())
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  const std::string name = word.substr(0, word.find('='));
  return message_with_help(chain.back(),
                           {"", "an option", "'" + name + "'", text::did_you_mean(name, names), ErrorCode::argument});
}

UsageMessage about_word_left(const std::vector<const CLI::App*>& chain, const std::string& word) {
  if (is_option_like(word)) return unknown_option(chain, word);
  if (!commands_below(*chain.back()).empty()) return unknown_command(chain.back(), word);
  return message_with_help(chain.back(), {"", "no further argument", "'" + word + "'", "", ErrorCode::argument});
}

// "--out FILE", "DIR or --terrain DIR", "LAT".
std::string name_with_value(const CLI::Option& option) {
  const std::string kind = option.get_type_name().substr(0, option.get_type_name().find(':'));
  const std::string named = option.nonpositional() ? option.get_name() + " " + kind : "";
  const std::string argument = option.get_positional() ? option.get_name(true) : "";
  return argument + (named.empty() || argument.empty() ? "" : " or ") + named;
}

std::optional<UsageMessage> about_what_is_required(const std::vector<const CLI::App*>& chain) {
  std::string names;
  for (const CLI::App* command : chain)
    for (const CLI::Option* option : command->get_options())
      if (option->get_required() && option->count() == 0)
        names += (names.empty() ? "" : ", ") + name_with_value(*option);
  if (!names.empty()) return message_with_help(chain.back(), {"", names, "none", "", ErrorCode::argument});
  const CLI::App* command = chain.back();
  if (command->get_require_subcommand_min() == 0) return std::nullopt;
  return message_with_help(command,
                           {"", "a command: " + joined_by_or(names_below(*command)), "none", "", ErrorCode::argument});
}

std::optional<UsageMessage> about_relations(const std::vector<const CLI::App*>& chain) {
  for (const CLI::App* command : chain)
    for (const CLI::Option* option : command->get_options()) {
      if (option->count() == 0) continue;
      for (const CLI::Option* other : option->get_needs())
        if (other->count() == 0)
          return message_with_help(
              chain.back(), {option->get_name(), other->get_name() + " with it", "none", "", ErrorCode::argument});
      for (const CLI::Option* other : option->get_excludes())
        if (other->count() > 0)
          return message_with_help(chain.back(), {option->get_name(), "no " + other->get_name() + " with it", "both",
                                                  "", ErrorCode::argument});
    }
  return std::nullopt;
}

const CLI::Option* option_named(const std::vector<const CLI::App*>& chain, const std::string& name) {
  for (auto command = chain.rbegin(); command != chain.rend(); ++command)
    if (const CLI::Option* option = (*command)->get_option_no_throw(name)) return option;
  return nullptr;
}

std::string values_text(int count) {
  return text::counted(count, "value");
}

std::optional<Error> too_many_values(const std::vector<const CLI::App*>& chain) {
  for (const CLI::App* command : chain)
    for (const CLI::Option* option : command->get_options()) {
      const int max = option->get_items_expected_max();
      const int found = static_cast<int>(option->count());
      if (max <= 0 || found <= max) continue;
      return Error{option->get_name(), max == 1 ? "the option once" : values_text(max),
                   max == 1 ? "it " + text::counted(found, "time") : std::to_string(found), "", ErrorCode::argument};
    }
  return std::nullopt;
}

// A flag with a value, as in --force=no.
std::optional<Error> flag_with_value(const std::vector<const CLI::App*>& chain, const std::vector<std::string>& words) {
  for (const std::string& word : words) {
    const std::size_t equals = word.find('=');
    if (!is_option_like(word) || equals == std::string::npos) continue;
    const CLI::Option* option = option_named(chain, word.substr(0, equals));
    if (option == nullptr || option->get_items_expected_max() > 0) continue;
    return Error{word.substr(0, equals), "no value", "'" + word.substr(equals + 1) + "'", "", ErrorCode::argument};
  }
  return std::nullopt;
}

// An option of text that took the name of another option as its value.
std::optional<Error> option_as_value(const std::vector<const CLI::App*>& chain) {
  for (const CLI::App* command : chain)
    for (const CLI::Option* option : command->get_options())
      for (const std::string& value : option->results())
        if (option->nonpositional() && is_option_like(value) && option_named(chain, value) != nullptr)
          return Error{option->get_name(), expected_value(*option), "the option '" + value + "'", "",
                       ErrorCode::argument};
  return std::nullopt;
}

// The last option of the command line, after which there are too few words.
std::optional<Error> missing_value(const std::vector<const CLI::App*>& chain, const std::vector<std::string>& words) {
  for (std::size_t after = 0; after < words.size(); ++after) {
    std::string word = words[words.size() - 1 - after];
    if (word.ends_with('=')) word.pop_back();
    const CLI::Option* option = is_option_like(word) ? option_named(chain, word) : nullptr;
    if (option == nullptr) continue;
    const int min = option->get_items_expected_min();
    if (min == 1) return Error{word, expected_value(*option), "nothing", "", ErrorCode::argument};
    return Error{word, values_text(min), std::to_string(after), "", ErrorCode::argument};
  }
  return std::nullopt;
}

std::optional<UsageMessage> about_count(const std::vector<const CLI::App*>& chain,
                                        const std::vector<std::string>& words) {
  auto error = too_many_values(chain);
  if (!error) error = flag_with_value(chain, words);
  if (!error) error = missing_value(chain, words);
  if (!error) return std::nullopt;
  return message_with_help(chain.back(), *error);
}

}  // namespace

bool has_unknown_command(const CLI::App& app) {
  const auto words = words_left(app);
  return !words.empty() && !is_option_like(words.front()) && !commands_below(*chain_of(app).back()).empty();
}

const CLI::App* command_below(const CLI::App& command, const std::string& name) {
  for (const CLI::App* below : commands_below(command))
    if (below->get_name() == name) return below;
  if (commands_below(command).empty())
    throw message_with_help(&command, {"", "no further argument", "'" + name + "'", "", ErrorCode::argument});
  throw unknown_command(&command, name);
}

UsageMessage usage_message(const CLI::App& app, const CLI::ParseError& outcome, const std::vector<std::string>& words) {
  const auto chain = chain_of(app);
  // Only command_line.cpp makes errors of this type: their text is "OPTION: expected ..., found ...".
  if (dynamic_cast<const CLI::ValidationError*>(&outcome) != nullptr)
    return message_with_help(chain.back(), outcome.what());
  std::optional<UsageMessage> message;
  if (const auto error = option_as_value(chain)) return message_with_help(chain.back(), *error);
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&outcome) != nullptr) message = about_count(chain, words);
  // A misspelled word is also the reason why another is missing.
  if (!message && !words_left(app).empty()) message = about_word_left(chain, words_left(app).front());
  if (!message) message = about_what_is_required(chain);
  if (!message) message = about_relations(chain);
  if (message) return *message;
  std::string all;
  for (const std::string& word : words) all += (all.empty() ? "'" : " ") + word;
  return message_with_help(chain.back(), {"", "a command line as in its help", all + "'", "", ErrorCode::argument});
}

}  // namespace yars::runtime
