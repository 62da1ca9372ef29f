#include "runtime/user_defaults.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <vector>

#include "lib/file/text_file.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::runtime {

namespace {

std::string quoted(std::string_view text) {
  std::string result = "'";
  return result.append(text).append("'");
}

enum class Value {
  text,
  path,          // of a file or folder
  path_or_name,  // or the name of an installed file
};

struct Name {
  std::string_view name;
  Value value;
};

constexpr std::array<Name, 6> kNames{{{"session", Value::text},
                                      {"config", Value::path_or_name},
                                      {"terrain", Value::path},
                                      {"log-dir", Value::path},
                                      {"log-level", Value::text},
                                      {"size", Value::text}}};

error::Error unknown_name(const std::string& location, std::string_view name) {
  std::vector<std::string> known;
  std::string list;
  for (const Name& each : kNames) {
    known.emplace_back(each.name);
    list += (list.empty() ? "" : ", ") + std::string(each.name);
  }
  return {location, "one of " + list, quoted(name), text::did_you_mean(name, known)};
}

// The value as programs use it, or what was expected in its place.
error::Expected<std::string> usable_value(const std::string& location, const Name& name, std::string_view value,
                                          const std::string& home) {
  if (value.empty())
    return error::fail(location, "a value of " + std::string(name.name), "none", "remove the line, or add the value");
  if (name.value == Value::text) return std::string(value);
  if (value.starts_with("~/") && !home.empty()) return home + std::string(value.substr(1));
  if (value.starts_with('/')) return std::string(value);
  if (name.value == Value::path_or_name && value.find('/') == std::string_view::npos) return std::string(value);
  return error::fail(location, "for " + std::string(name.name) + " a path that begins with / or ~/", quoted(value),
                     "programs are called from any folder");
}

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? std::string() : std::string(value);
}

}  // namespace

error::Expected<UserDefaults> parse_user_defaults(std::string_view text, const std::string& file,
                                                  const std::string& home) {
  UserDefaults defaults;
  defaults.file = file;
  for (const text::NumberedLine& line : text::numbered_lines(text)) {
    const std::string location = file::line_location(file, line.number);
    const std::size_t equals = line.text.find('=');
    const std::string_view key = text::trimmed(line.text.substr(0, equals));
    const auto name = std::ranges::find(kNames, key, &Name::name);
    if (name == kNames.end()) return tl::unexpected(unknown_name(location, key));
    if (equals == std::string_view::npos)
      return error::fail(location, std::string(key) + " = VALUE", quoted(line.text));
    const auto value = usable_value(location, *name, text::trimmed(line.text.substr(equals + 1)), home);
    if (!value) return tl::unexpected(value.error());
    if (!defaults.values.emplace(key, UserDefault{*value, line.number}).second)
      return error::fail(location, std::string(key) + " once", "it twice", "remove one of the lines");
  }
  return defaults;
}

std::string user_defaults_path() {
  if (std::getenv("YARS_USER_CONFIG") != nullptr) return environment("YARS_USER_CONFIG");
  // The XDG Base Directory Specification ignores relative paths.
  const std::string xdg = environment("XDG_CONFIG_HOME"), home = environment("HOME");
  if (xdg.starts_with('/')) return xdg + "/yars/yars.conf";
  return home.empty() ? std::string() : home + "/.config/yars/yars.conf";
}

error::Expected<UserDefaults> read_user_defaults() {
  const std::string path = user_defaults_path();
  std::error_code problem;
  const bool is_named = std::getenv("YARS_USER_CONFIG") != nullptr;
  if (path.empty() || (!is_named && !std::filesystem::exists(path, problem))) return UserDefaults{};
  const auto text = file::read_text_file(path);
  if (!text) return tl::unexpected(text.error());
  return parse_user_defaults(*text, path, environment("HOME"));
}

}  // namespace yars::runtime
