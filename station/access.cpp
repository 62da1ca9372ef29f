#include "station/access.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace yars::station {

namespace {

bool is_digit(char character) {
  return character >= '0' && character <= '9';
}

// An IPv4 address, or an IPv6 address in brackets. Browsers resolve no name for these.
bool is_numeric_address(std::string_view name) {
  const bool in_brackets = name.starts_with('[') && name.ends_with(']');
  if (in_brackets) name = name.substr(1, name.size() - 2);
  return !name.empty() && std::ranges::all_of(name, [in_brackets](char letter) {
    return is_digit(letter) || letter == '.' || (in_brackets && (letter == ':' || (letter >= 'a' && letter <= 'f')));
  });
}

// Compares in a time that does not tell how much of the text is right.
bool equals_secret(std::string_view given, std::string_view secret) {
  if (secret.empty() || given.size() != secret.size()) return false;
  unsigned difference = 0;
  for (std::size_t i = 0; i < secret.size(); ++i) difference |= static_cast<unsigned>(given[i] ^ secret[i]);
  return difference == 0;
}

// The last value of a list with commas, without blanks around it.
std::string_view last_of(std::string_view list) {
  const std::size_t comma = list.rfind(',');
  if (comma != std::string_view::npos) list.remove_prefix(comma + 1);
  while (list.starts_with(' ')) list.remove_prefix(1);
  while (list.ends_with(' ')) list.remove_suffix(1);
  return list;
}

// Cookies of a host are shared by all its ports. Each right has its own, so that a link of viewers replaces none of an
// instructor.
std::string cookie_name(Right right, const AccessRules& rules) {
  return "yars_station_" + std::to_string(rules.port) + (right == Right::instructor ? "_instructor" : "_viewer");
}

}  // namespace

std::string lower_case(std::string_view text) {
  std::string lower(text);
  std::ranges::transform(lower, lower.begin(), [](char letter) {
    return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter + 32) : letter;
  });
  return lower;
}

Origins origins_of(std::string_view host, std::string_view peer, const Forwarded& forwarded, const AccessRules& rules) {
  Origins origins{lower_case(host), rules.tls, std::string(peer)};
  if (!rules.behind_proxy) return origins;
  if (const auto given = last_of(forwarded.host); !given.empty()) origins.host = lower_case(given);
  if (const auto given = last_of(forwarded.proto); !given.empty()) origins.https = lower_case(given) == "https";
  if (const auto given = last_of(forwarded.visitors); !given.empty()) origins.visitor = given;
  return origins;
}

bool is_allowed_host(std::string_view host, const AccessRules& rules) {
  const std::size_t colon = host.rfind(':');
  std::string_view name = host;
  if (colon != std::string_view::npos && !host.ends_with(']')) {
    const std::string_view port = host.substr(colon + 1);
    if (port.empty() || port.size() > 5 || !std::ranges::all_of(port, is_digit)) return false;
    name = host.substr(0, colon);
  }
  return name == "localhost" || is_numeric_address(name) || std::ranges::find(rules.names, name) != rules.names.end();
}

bool is_own_origin(std::string_view origin, const Origins& origins) {
  return lower_case(origin) == "https://" + origins.host ||
         (!origins.https && lower_case(origin) == "http://" + origins.host);
}

bool is_host_name(std::string_view name) {
  const auto allowed = [](char letter) {
    return (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') || is_digit(letter) || letter == '.' ||
           letter == '-';
  };
  return !name.empty() && name.size() <= 253 && !name.starts_with('-') && !name.starts_with('.') &&
         name.find("..") == std::string_view::npos && std::ranges::all_of(name, allowed);
}

Right right_of_token(std::string_view token, const AccessRules& rules) {
  if (rules.instructor_token.empty()) return Right::instructor;
  if (equals_secret(token, rules.instructor_token)) return Right::instructor;
  return equals_secret(token, rules.viewer_token) ? Right::viewer : Right::none;
}

Right right_of_cookies(std::string_view cookies, const AccessRules& rules) {
  if (rules.instructor_token.empty()) return Right::instructor;
  const std::string viewer = cookie_name(Right::viewer, rules), instructor = cookie_name(Right::instructor, rules);
  Right right = Right::none;
  while (!cookies.empty()) {
    const std::string_view cookie = cookies.substr(0, cookies.find(';'));
    cookies.remove_prefix(std::min(cookies.size(), cookie.size() + 1));
    const std::string_view trimmed = cookie.substr(std::min(cookie.size(), cookie.find_first_not_of(' ')));
    const std::string_view name = trimmed.substr(0, trimmed.find('='));
    if (name.size() < trimmed.size() && (name == viewer || name == instructor))
      right = std::max(right, right_of_token(trimmed.substr(name.size() + 1), rules));
  }
  return right;
}

std::string cookie_of_token(std::string_view token, const Origins& origins, const AccessRules& rules) {
  return cookie_name(right_of_token(token, rules), rules) + '=' + std::string(token) +
         "; Path=/; HttpOnly; SameSite=Lax" + (origins.https ? "; Secure" : "");
}

std::string file_of_path(std::string_view path) {
  path = path.substr(0, path.find('?'));
  if (path == "/") return "display.html";
  if (!path.starts_with('/')) return {};
  path.remove_prefix(1);
  const auto allowed = [](char character) {
    return (character >= 'a' && character <= 'z') || is_digit(character) || character == '.' || character == '_';
  };
  return !path.empty() && path.front() != '.' && std::ranges::all_of(path, allowed) ? std::string(path) : std::string();
}

std::optional<std::string> parameter_of(std::string_view path, std::string_view name) {
  const std::size_t query = path.find('?');
  if (query == std::string_view::npos) return std::nullopt;
  path.remove_prefix(query + 1);
  const std::string begin = std::string(name) + '=';
  while (!path.empty()) {
    const std::string_view part = path.substr(0, path.find('&'));
    path.remove_prefix(std::min(path.size(), part.size() + 1));
    if (!part.starts_with(begin)) continue;
    const std::string_view value = part.substr(begin.size());
    const auto allowed = [](char character) {
      return (character >= 'a' && character <= 'z') || (character >= 'A' && character <= 'Z') || is_digit(character) ||
             character == '-' || character == '_';
    };
    if (value.empty() || !std::ranges::all_of(value, allowed)) return std::nullopt;
    return std::string(value);
  }
  return std::nullopt;
}

std::string_view content_type_of(std::string_view file) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 8> kTypes{
      {{".html", "text/html; charset=utf-8"},
       {".ico", "image/x-icon"},
       {".js", "text/javascript; charset=utf-8"},
       {".css", "text/css; charset=utf-8"},
       {".json", "application/json"},
       {".png", "image/png"},
       {".svg", "image/svg+xml"},
       {".txt", "text/plain; charset=utf-8"}}};
  for (const auto& [ending, type] : kTypes)
    if (file.ends_with(ending)) return type;
  return "application/octet-stream";
}

std::string content_policy(const Origins& origins) {
  return "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob:; connect-src 'self' ws://" +
         origins.host + " wss://" + origins.host + "; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";
}

}  // namespace yars::station
