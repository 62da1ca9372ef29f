// Which requests of browsers are answered, with which rights and headers.
// Inputs: headers Host, Origin and Cookie of a request, those of a proxy, its path; the rules of the server.
// Outputs: whether the request is allowed, and what it may do; the file that a path names.
// Errors: none.
// Source: docs/station.md#security. RFC 9110 (Host), RFC 6454 (Origin), RFC 6265 (cookies), Content Security Policy
// Level 3; X-Forwarded-Host, -Proto and -For as nginx, Apache and Caddy send them.
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
  bool tls = false;                // the server itself has a certificate
  bool behind_proxy = false;       // headers of a proxy are believed
  std::vector<std::string> names;  // of this computer, in lower case, for a header Host
  // Without tokens each page has the right `instructor`. A server that does not listen at loopback alone has both.
  std::string viewer_token, instructor_token;
};

// Where a browser says that its request goes to.
struct Origins {
  std::string host;     // of the address in the browser, in lower case, with its port if that is not the usual one
  bool https = false;   // the browser's way begins with TLS
  std::string visitor;  // address of the browser's computer
};

// Headers of a proxy; empty where there are none.
struct Forwarded {
  std::string_view host, proto, visitors;  // X-Forwarded-Host, -Proto, -For
};

// `host`: header Host. `peer`: address of the other end of the connection. Of several values of a proxy's header the
// last counts, which the nearest proxy has written.
Origins origins_of(std::string_view host, std::string_view peer, const Forwarded& forwarded, const AccessRules& rules);

// True if a name may lead to this server: localhost, an address in numbers, or one of the names, with any port. A
// tunnel or a container maps ports. A page of another site that has its name lead here (DNS rebinding) sends its own
// name, which is none of them.
bool is_allowed_host(std::string_view host, const AccessRules& rules);

// True if a header Origin is that of a page of this server. A browser sends one with each WebSocket. A proxy may have
// ended TLS without saying so: https is right also where it was not seen.
bool is_own_origin(std::string_view origin, const Origins& origins);

// The text with A to Z in lower case, as host names are compared.
std::string lower_case(std::string_view text);

// True for a name as a header Host can have it: letters, digits, `.` and `-`, 253 at most.
bool is_host_name(std::string_view name);

// Right that a token gives.
Right right_of_token(std::string_view token, const AccessRules& rules);
// Right of a request by its header Cookie: the highest that one of its cookies gives.
Right right_of_cookies(std::string_view cookies, const AccessRules& rules);
// Header Set-Cookie with which a browser sends the token along: to this server only, not to scripts. It replaces no
// cookie of another right. A link on a foreign page opens a page with it (SameSite=Lax); what a foreign page loads or
// sends by itself comes without it.
std::string cookie_of_token(std::string_view token, const Origins& origins, const AccessRules& rules);

// Name of the file of a path: "display.html" for "/" and "/display.html?x"; empty for a path that names none.
std::string file_of_path(std::string_view path);

// Value of a parameter in the query of a path: "a" for NAME in "/x?NAME=a&y=b". Only letters, digits, `-` and `_`
// count; nullopt without the parameter or with other characters.
std::optional<std::string> parameter_of(std::string_view path, std::string_view name);

// Value of Content-Type by a file's ending.
std::string_view content_type_of(std::string_view file);

// Value of Content-Security-Policy: scripts, styles and pictures from this server alone, no frames around it.
std::string content_policy(const Origins& origins);

}  // namespace yars::station
