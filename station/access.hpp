// Which requests of browsers are answered, with which rights and headers.
// Inputs: headers Host, Origin and Cookie of a request, its path; the rules of the server.
// Outputs: whether the request is allowed, and what it may do; the file that a path names.
// Errors: none.
// Source: docs/station.md#security. RFC 9110 (Host), RFC 6454 (Origin), RFC 6265 (cookies), Content Security Policy
// Level 3.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace yars::station {

// What a page may do: nothing; look; look, fly and change the set.
enum class Right : std::uint8_t { none, viewer, instructor };

struct AccessRules {
  std::uint16_t port = 0;
  bool loopback = true;            // the server listens at the loopback address alone
  bool tls = false;                // pages come by https
  std::vector<std::string> names;  // of this computer, for a header Host; besides addresses in numbers
  // Without tokens each page has the right `instructor`. A server that does not listen at loopback alone has both.
  std::string viewer_token, instructor_token;
};

// True if a header Host names this computer and this port: at loopback by 127.0.0.1, localhost or [::1]; else by an
// address in numbers or one of the names. A page of another site that has its name lead here (DNS rebinding) sends its
// own name.
bool is_allowed_host(std::string_view host, const AccessRules& rules);

// True if a header Origin is that of a page of this server, http://HOST or https://HOST. A browser sends one with each
// WebSocket.
bool is_own_origin(std::string_view origin, std::string_view host, const AccessRules& rules);

// Right that a token gives.
Right right_of_token(std::string_view token, const AccessRules& rules);
// Right of a request by its header Cookie: the highest that one of its cookies gives.
Right right_of_cookies(std::string_view cookies, const AccessRules& rules);
// Header Set-Cookie with which a browser sends the token along: to this server only, not to scripts. It replaces no
// cookie of another right. A link on a foreign page opens a page with it (SameSite=Lax); what a foreign page loads or
// sends by itself comes without it.
std::string cookie_of_token(std::string_view token, const AccessRules& rules);

// Name of the file of a path: "display.html" for "/" and "/display.html?x"; empty for a path that names none.
std::string file_of_path(std::string_view path);

// Value of a parameter in the query of a path: "a" for NAME in "/x?NAME=a&y=b". Only letters, digits, `-` and `_`
// count; nullopt without the parameter or with other characters.
std::optional<std::string> parameter_of(std::string_view path, std::string_view name);

// Value of Content-Type by a file's ending.
std::string_view content_type_of(std::string_view file);

// Value of Content-Security-Policy: scripts, styles and pictures from the server `host` alone, no frames around it.
std::string content_policy(std::string_view host, const AccessRules& rules);

}  // namespace yars::station
