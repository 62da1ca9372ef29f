// Which requests of browsers are answered, and with which headers.
// Inputs: headers Host and Origin of a request, its path; the port of the server.
// Outputs: whether the request is allowed; the file that a path names.
// Errors: none.
// Source: docs/station.md#security. RFC 9110 (Host), RFC 6454 (Origin), Content Security Policy Level 3.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace yars::station {

// True if a header Host names this computer by its loopback address and this port. A page of another site that has its
// name lead here (DNS rebinding) sends its own name.
bool is_local_host(std::string_view host, std::uint16_t port);

// True if a header Origin is that of a page of this server, http://HOST. A browser sends one with each WebSocket.
bool is_own_origin(std::string_view origin, std::string_view host);

// Name of the file of a path: "display.html" for "/" and "/display.html?x"; empty for a path that names none.
std::string file_of_path(std::string_view path);

// Value of Content-Type by a file's ending.
std::string_view content_type_of(std::string_view file);

// Value of Content-Security-Policy: scripts, styles and pictures from the server `host` alone, no frames around it.
std::string content_policy(std::string_view host);

}  // namespace yars::station
