// Server of the pages: HTTP for the files, one WebSocket for each page that is open.
// Inputs: the feed; a folder of files; requests and messages of browsers on this computer.
// Outputs: files, frames, states; events of the pilot for the feed.
// Errors: a port that is taken is an Error. A request that is not allowed gets a status from 400 to 405; a bad message
//   closes its connection. Neither reaches others.
// Limits: kMaxConnections; each client has one message on its way and then the newest frame and state, whatever was
//   between; kMaxMessagesPerSecond from a client.
// Threads: one.
// Source: docs/station.md; RFC 9112 (HTTP/1.1), RFC 6455 (WebSocket), by Boost.Beast.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include "lib/error/error.hpp"
#include "station/app/feed_shell.hpp"

namespace yars::station {

inline constexpr int kMaxConnections = 64;
inline constexpr int kMaxMessagesPerSecond = 200;

class Server {
 public:
  // Reads the files and listens at 127.0.0.1. `port` 0: any free one.
  static error::Expected<Server> listen(StationFeed& feed, const std::filesystem::path& pages, std::uint16_t port);
  Server(Server&&) noexcept;
  ~Server();

  std::uint16_t port() const;
  // Waits for requests and serves them, at most until the next look at the segment.
  void step();

  struct Work;  // of server_shell.cpp

 private:
  explicit Server(std::unique_ptr<Work> work);
  std::unique_ptr<Work> work_;
};

}  // namespace yars::station
