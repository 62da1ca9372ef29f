#include "runtime/usage_message.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <optional>

#include "lib/error/error.hpp"
#include "lib/text/nearest_word.hpp"
#include "lib/text/plain_text.hpp"
#include "runtime/option_text.hpp"

namespace yars::runtime {

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
UsageMessage message_of(const CLI::App* command, const std::string& text) {
  const std::string path = path_of(command);
  return {path, text + (text.ends_with('?') ? " See " : "; see ") + path + " --help"};
}
UsageMessage message_of(const CLI::App* command, const Error& error) {
  return message_of(command, error.message());
}

UsageMessage unknown_command(const CLI::App* command, const std::string& word) {
  const auto names = names_below(*command);
  const std::string meant = text::did_you_mean(word, names);
  return message_of(command, {"", meant.empty() ? "a command: " + joined_by_or(names) : "a command", "'" + word + "'",
                              meant, ErrorCode::argument});
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
  return message_of(chain.back(),
                    {"", "an option", "'" + name + "'", text::did_you_mean(name, names), ErrorCode::argument});
}

UsageMessage about_word_left(const std::vector<const CLI::App*>& chain, const std::string& word) {
  if (is_option_like(word)) return unknown_option(chain, word);
  if (!commands_below(*chain.back()).empty()) return unknown_command(chain.back(), word);
  return message_of(chain.back(), {"", "no further argument", "'" + word + "'", "", ErrorCode::argument});
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
  if (!names.empty()) return message_of(chain.back(), {"", names, "none", "", ErrorCode::argument});
  const CLI::App* command = chain.back();
  if (command->get_require_subcommand_min() == 0) return std::nullopt;
  return message_of(command,
                    {"", "a command: " + joined_by_or(names_below(*command)), "none", "", ErrorCode::argument});
}

std::optional<UsageMessage> about_relations(const std::vector<const CLI::App*>& chain) {
  for (const CLI::App* command : chain)
    for (const CLI::Option* option : command->get_options()) {
      if (option->count() == 0) continue;
      for (const CLI::Option* other : option->get_needs())
        if (other->count() == 0)
          return message_of(chain.back(),
                            {option->get_name(), other->get_name() + " with it", "none", "", ErrorCode::argument});
      for (const CLI::Option* other : option->get_excludes())
        if (other->count() > 0)
          return message_of(chain.back(), {option->get_name(), "no " + other->get_name() + " with it", "both", "",
                                           ErrorCode::argument});
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
  return message_of(chain.back(), *error);
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
    throw message_of(&command, {"", "no further argument", "'" + name + "'", "", ErrorCode::argument});
  throw unknown_command(&command, name);
}

UsageMessage usage_message(const CLI::App& app, const CLI::ParseError& outcome, const std::vector<std::string>& words) {
  const auto chain = chain_of(app);
  // Only command_line.cpp makes errors of this type: their text is "OPTION: expected ..., found ...".
  if (dynamic_cast<const CLI::ValidationError*>(&outcome) != nullptr) return message_of(chain.back(), outcome.what());
  std::optional<UsageMessage> message;
  if (const auto error = option_as_value(chain)) return message_of(chain.back(), *error);
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&outcome) != nullptr) message = about_count(chain, words);
  // A misspelled word is also the reason why another is missing.
  if (!message && !words_left(app).empty()) message = about_word_left(chain, words_left(app).front());
  if (!message) message = about_what_is_required(chain);
  if (!message) message = about_relations(chain);
  if (message) return *message;
  std::string all;
  for (const std::string& word : words) all += (all.empty() ? "'" : " ") + word;
  return message_of(chain.back(), {"", "a command line as in its help", all + "'", "", ErrorCode::argument});
}

}  // namespace yars::runtime
