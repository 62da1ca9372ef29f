// What all connections of the server share: files, sessions, sets, map, rules, open pages. A feed between segment and
// pages. The map draws tiles in its own thread, so that frames do not wait for terrain.
// Inputs: names of sessions, and their records; events of the pages; the configured terrain; requests of tiles.
// Outputs: feeds; messages to the open pages; input events in an input lane; tiles as PNG.
// Errors: a session that does not exist is an Error. Invalid records are refused and noted; the last valid one stays. A
// full input lane drops the event, with a warning. Problems of the terrain are logged at level debug: radar-model
// reports them. Ground without a file is drawn as sea or absent, as configured.
// Limits: kMaxWaiting requests of tiles wait; more are refused. The newest kKept tiles are kept.
// Threads: one; the map answers in its own thread, and the site by way of the context.
// Source: docs/station.md#messages.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "databuffer/session/receivers.hpp"
#include "databuffer/session/session.hpp"
#include "display/symbology/plan_view.hpp"
#include "runtime/claims.hpp"
#include "station/access.hpp"
#include "station/app/instructor_shell.hpp"
#include "station/app/sets_shell.hpp"
#include "station/instructor_map.hpp"
#include "station/page_message.hpp"

namespace yars::station {

using Text = std::shared_ptr<const std::string>;

class StationFeed {
 public:
  // Error: no input lane is free.
  static error::Expected<StationFeed> create(databuffer::Session& session);

  // Looks for news in the segment. True if there are any.
  bool refresh();
  FrameStream& frames() { return frames_; }
  // The newest state as a message; its number counts up with each new text.
  const Text& state() const { return state_text_; }
  std::uint64_t state_number() const { return state_number_; }
  void send(const databuffer::InputEvent& event) { lane_.send(event); }

 private:
  StationFeed(databuffer::Session& session, runtime::InputLane lane) : session_(&session), lane_(std::move(lane)) {}
  bool refresh_frame(std::int64_t now_ns);
  bool refresh_state(std::int64_t now_ns);
  std::string state_message() const;

  databuffer::Session* session_;
  runtime::InputLane lane_;
  FrameStream frames_;
  std::uint64_t frame_id_ = 0;  // of the last frame that was read, valid or not
  std::vector<std::uint8_t> pixels_;
  std::int64_t frame_ns_ = 0;  // CLOCK_MONOTONIC when the newest frame was read; 0: none
  display::DisplayInput input_;
  databuffer::Validated<databuffer::RadarState> state_;
  databuffer::Validated<databuffer::ModelStatus> model_;
  databuffer::Validated<databuffer::PilotAdvice> advice_;
  Text state_text_;
  std::uint64_t state_number_ = 0;
  std::int64_t next_state_ns_ = 0;
};

}  // namespace yars::station

namespace yars::model::terrain {
class TerrainStore;
}  // namespace yars::model::terrain

namespace yars::station {

class MapShell {
 public:
  using Answer = std::function<void(std::shared_ptr<const std::string> png)>;

  explicit MapShell(std::unique_ptr<model::terrain::TerrainStore> store);
  ~MapShell();
  MapShell(const MapShell&) = delete;
  MapShell& operator=(const MapShell&) = delete;

  // Calls `answer` in another thread, or at once for a tile that is kept. False: too many requests wait.
  bool request(const MapTile& tile, Answer answer);

 private:
  static constexpr std::size_t kMaxWaiting = 512, kKept = 256;
  void serve();
  std::shared_ptr<const std::string> drawn(const MapTile& tile);

  struct Request {
    MapTile tile;
    Answer answer;
  };
  std::unique_ptr<model::terrain::TerrainStore> store_;
  std::mutex mutex_;  // guards the members below, except thread_
  std::condition_variable wake_;
  std::deque<Request> waiting_;
  std::map<MapTile, std::shared_ptr<const std::string>> kept_;
  std::deque<MapTile> order_;  // of kept_, the oldest first
  bool ending_ = false;
  std::thread thread_;
};

}  // namespace yars::station

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
