#include "station/access.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace yars::station {

bool is_local_host(std::string_view host, std::uint16_t port) {
  constexpr std::array<std::string_view, 3> kNames{"127.0.0.1", "localhost", "[::1]"};
  return std::ranges::any_of(
      kNames, [&](std::string_view name) { return host == std::string(name) + ':' + std::to_string(port); });
}

bool is_own_origin(std::string_view origin, std::string_view host) {
  return origin == "http://" + std::string(host);
}

std::string file_of_path(std::string_view path) {
  path = path.substr(0, path.find('?'));
  if (path == "/") return "display.html";
  if (!path.starts_with('/')) return {};
  path.remove_prefix(1);
  const auto allowed = [](char character) {
    return (character >= 'a' && character <= 'z') || (character >= '0' && character <= '9') || character == '.' ||
           character == '_';
  };
  return !path.empty() && path.front() != '.' && std::ranges::all_of(path, allowed) ? std::string(path) : std::string();
}

std::string_view content_type_of(std::string_view file) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 5> kTypes{
      {{".html", "text/html; charset=utf-8"},
       {".js", "text/javascript; charset=utf-8"},
       {".css", "text/css; charset=utf-8"},
       {".svg", "image/svg+xml"},
       {".txt", "text/plain; charset=utf-8"}}};
  for (const auto& [ending, type] : kTypes)
    if (file.ends_with(ending)) return type;
  return "application/octet-stream";
}

std::string content_policy(std::string_view host) {
  return "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob:; connect-src 'self' ws://" +
         std::string(host) + "; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";
}

}  // namespace yars::station
