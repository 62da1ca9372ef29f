// What all connections of the server share: files, sessions, sets, map, rules, and the pages that are open.
// Inputs: names of sessions; looks at their segments. Outputs: feeds; messages to the pages that are open.
// Errors: a session that does not exist is an Error.
// Threads: one; answers of the map come to it by way of the context.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "databuffer/session/session.hpp"
#include "station/access.hpp"
#include "station/app/feed_shell.hpp"
#include "station/app/instructor_shell.hpp"
#include "station/app/map_shell.hpp"
#include "station/app/sets_shell.hpp"

namespace boost::asio {
class io_context;
}  // namespace boost::asio

namespace yars::station {

inline constexpr int kMaxConnections = 64;
inline constexpr int kMaxMessagesPerSecond = 200;

// One session: its display and its instructor.
struct SessionFeed {
  SessionFeed(databuffer::Session opened, const std::string& name)
      : session(std::move(opened)), instructor(session, name) {}
  databuffer::Session session;
  std::unique_ptr<StationFeed> display;
  InstructorShell instructor;
  int displays = 0, instructors = 0;  // pages that show them
};

// A page that is open.
class OpenPage {
 public:
  virtual ~OpenPage() = default;
  // Sends the newest state and frame, if nothing is on its way and the page has not got them yet.
  virtual void pump() = 0;
  // Sends a text, in the order of the calls.
  virtual void tell(Text text) = 0;
};

// Counts a connection while it lives.
class Counted {
 public:
  explicit Counted(int& count) : count_(&count) { ++count; }
  Counted(Counted&& other) noexcept : count_(std::exchange(other.count_, nullptr)) {}
  Counted(const Counted&) = delete;
  Counted& operator=(const Counted&) = delete;
  ~Counted() {
    if (count_ != nullptr) --*count_;
  }

 private:
  int* count_;
};

struct Site {
  Site(boost::asio::io_context& given, SetSettings settings, std::unique_ptr<model::terrain::TerrainStore> terrain)
      : context(given), own_session(settings.session), sets(given, std::move(settings)), map(std::move(terrain)) {}

  // Feed of a session: the station's own, or one of its sets. It lives as long as someone holds it.
  error::Expected<std::shared_ptr<SessionFeed>> feed_of(const std::string& session);
  // Looks at the segments of the sessions that are shown, and has the pages send what is new.
  void look();
  void tell_all(const Text& text);

  boost::asio::io_context& context;
  std::string own_session;
  std::map<std::string, std::string> files;  // contents by name
  AccessRules access;
  int connections = 0;
  std::vector<std::weak_ptr<OpenPage>> pages;
  std::map<std::string, std::weak_ptr<SessionFeed>> feeds;
  SetsShell sets;
  MapShell map;
};

// Text of the list of sets, for pages.
Text sets_message(const SetsShell& sets);

}  // namespace yars::station
