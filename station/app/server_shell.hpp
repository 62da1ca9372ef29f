// Server of the pages: HTTP for the files, pictures and tiles, one WebSocket for each page that is open; over TLS if a
// certificate is given.
// Inputs: a folder of files; requests and messages of browsers; sessions and their sets.
// Outputs: files, frames, states, answers; events of the pilot and commands of the instructor for the sessions.
// Errors: a port that is taken, a certificate that cannot be read are Errors. A request that is not allowed gets a
//   status from 400 to 431; a bad message closes its connection. Neither reaches others.
// Limits: those of Places and Visits; each client has one message on its way and then the newest frame and state,
// whatever was
//   between; kMaxMessagesPerSecond from a client.
// Threads: one, and that of the map.
// Source: docs/station.md; RFC 9112 (HTTP/1.1), RFC 6455 (WebSocket), by Boost.Beast.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "lib/error/error.hpp"
#include "station/access.hpp"
#include "station/app/sets_shell.hpp"

namespace yars::model::terrain {
class TerrainStore;
}  // namespace yars::model::terrain

namespace yars::station {

struct ServerSettings {
  std::filesystem::path pages;
  std::string address = "127.0.0.1";  // to listen at; a port in `access`, 0: any free one
  AccessRules access;                 // `port` and `loopback` are filled in by the server
  std::string certificate, key;       // files in PEM; empty: without TLS
  SetSettings sets;
  std::string theatre;  // text of theatre_json()
};

class Server {
 public:
  // Reads the files and listens. `terrain`: of the instructor's map.
  static error::Expected<Server> listen(ServerSettings settings, std::unique_ptr<model::terrain::TerrainStore> terrain);
  Server(Server&&) noexcept;
  ~Server();

  std::uint16_t port() const;
  // Waits for requests and serves them, at most until the next look at the segment.
  void step();

 private:
  struct Work;  // of server_shell.cpp
  explicit Server(std::unique_ptr<Work> work);
  std::unique_ptr<Work> work_;
};

}  // namespace yars::station
