// What all connections of the server share: files, sessions, sets, map, rules, and the pages that are open.
// Inputs: names of sessions; looks at their segments. Outputs: feeds; messages to the pages that are open.
// Errors: a session that does not exist is an Error.
// Threads: one; answers of the map come to it by way of the context.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
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

using PlaceCounts = std::map<std::string, int>;  // taken places by right, and of viewers by address

// A place of a page, taken while it lives. It shares the counts, because the pages of a server outlive its Places: they
// end with its context.
class PagePlace {
 public:
  PagePlace(std::shared_ptr<PlaceCounts> counts, std::vector<std::string> names);
  PagePlace(PagePlace&&) noexcept = default;
  PagePlace(const PagePlace&) = delete;
  PagePlace& operator=(const PagePlace&) = delete;
  PagePlace& operator=(PagePlace&&) = delete;
  ~PagePlace();

 private:
  std::shared_ptr<PlaceCounts> counts_;  // nullptr: moved from
  std::vector<std::string> names_;
};

// Places for pages. Viewers cannot take those of instructors, and one computer not all those of viewers. An
// instructor's page of the display takes a place of viewers, and where there is none one of instructors.
class Places {
 public:
  static constexpr int kInstructors = 16;
  static constexpr int kViewers = 48;
  static constexpr int kViewersOfAddress = 32;

  // `is_instructors`: the page is that of instructors. nullopt: there is none for this right, or none for this address.
  std::optional<PagePlace> take(Right right, bool is_instructors, const std::string& address);
  // "at most 48 viewers, 32 of one address, and 16 instructors"
  static std::string text();

 private:
  std::shared_ptr<PlaceCounts> counts_ = std::make_shared<PlaceCounts>();
};

// A connection that is no page yet.
class OpenVisit {
 public:
  virtual ~OpenVisit() = default;
  virtual bool has_right() const = 0;
  virtual void close() = 0;
};

// The connections that are no pages yet. For a new one that would be too many an old one is closed: one without a right
// before one with a right, and the oldest of these. So nobody keeps others out with connections that only wait.
class Visits {
 public:
  static constexpr std::size_t kMost = 64;
  void add(const std::shared_ptr<OpenVisit>& visit);

 private:
  std::deque<std::weak_ptr<OpenVisit>> visits_;  // the oldest first
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
  Places places;
  Visits visits;
  std::vector<std::weak_ptr<OpenPage>> pages;
  std::map<std::string, std::weak_ptr<SessionFeed>> feeds;
  SetsShell sets;
  MapShell map;
};

// Text of the list of sets, for pages.
Text sets_message(const SetsShell& sets);

}  // namespace yars::station
