#include "runtime/option_text.hpp"

#include <CLI/CLI.hpp>
#include <array>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

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

}  // namespace yars::runtime
