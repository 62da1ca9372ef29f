#include "station/app/page_shell.hpp"

#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <cstdint>
#include <deque>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "lib/log/log.hpp"
#include "station/page_message.hpp"

namespace yars::station {

namespace {

using nlohmann::ordered_json;

Text text_of(const ordered_json& message) {
  return std::make_shared<const std::string>(message.dump(-1, ' ', true, ordered_json::error_handler_t::replace));
}

void answer(OpenPage& page, std::int64_t id, const std::optional<std::string>& problem) {
  page.tell(std::make_shared<const std::string>(answer_to(id, problem)));
}

void answer_outcome(OpenPage& page, std::int64_t id, const error::Expected<void>& outcome) {
  answer(page, id, outcome ? std::nullopt : std::optional(outcome.error().message()));
}

// Answers with the name of the session that was started.
void answer_session(OpenPage& page, std::int64_t id, const error::Expected<std::string>& session) {
  if (!session) return answer(page, id, session.error().message());
  page.tell(text_of({{"answer", id}, {"problem", nullptr}, {"session", *session}}));
}

void carry_out(Site& site, SessionFeed& feed, const std::shared_ptr<OpenPage>& page, const InstructorMessage& message) {
  const auto id = message.id;
  if (const auto* play = std::get_if<PlayRecording>(&message.command))
    return answer_session(*page, id, site.sets.play(play->file, play->at_s));
  if (const auto* out = std::get_if<FlyOut>(&message.command))
    return answer_session(*page, id, site.sets.fly_out(out->file, out->at_s));
  if (std::holds_alternative<StartRecorder>(message.command)) {
    const auto own = site.feed_of(site.own_session);
    const bool one_runs = own && (*own)->session.role_is_held(databuffer::Role::recorder);
    return answer_outcome(*page, id, site.sets.record(one_runs));
  }
  if (const auto* end = std::get_if<EndSet>(&message.command))
    return answer_outcome(*page, id, site.sets.end(end->session));
  if (std::holds_alternative<ListRecordings>(message.command))
    return site.sets.list_recordings([id, waiting = std::weak_ptr(page)](ordered_json list) {
      const auto there = waiting.lock();
      if (!there) return;
      if (list.contains("problem")) return answer(*there, id, list["problem"].get<std::string>());
      there->tell(text_of(
          {{"answer", id}, {"problem", nullptr}, {"recordings", list["recordings"]}, {"left_out", list["left_out"]}}));
    });
  feed.instructor.execute(message.command, [id, waiting = std::weak_ptr(page)](const error::Expected<void>& outcome) {
    if (const auto there = waiting.lock()) answer_outcome(*there, id, outcome);
  });
}

// Takes a message of a page: events for the session, or a command. Returns false if the connection is to be closed.
bool take_message(Site& site, SessionFeed& feed, PagePilot& pilot, const std::shared_ptr<OpenPage>& page, Right right,
                  const std::string& message) {
  const auto object =
      message.size() > kMaxMessageBytes ? nlohmann::json() : nlohmann::json::parse(message, nullptr, false);
  const bool commands = object.is_object() && object.contains("do");
  const auto command = commands ? instructor_message(object) : error::Expected<InstructorMessage>();
  const auto events = commands ? error::Expected<std::vector<databuffer::InputEvent>>() : pilot.events_of(message);
  if (commands && !command) {
    const auto id = object.find("id");
    answer(*page, id != object.end() && is_id(*id) ? id->get<std::int64_t>() : 0, command.error().message());
    return true;
  }
  if (!events) {
    log::warning("a page is refused: " + events.error().message());
    return false;
  }
  if (right != Right::instructor) {
    if (commands || !events->empty())
      answer(*page, commands ? command->id : 0, "expected the token of an instructor, found that of a viewer");
    return true;
  }
  for (const databuffer::InputEvent& event : *events) feed.display->send(event);
  if (commands) carry_out(site, feed, page, *command);
  return true;
}

class Page final : public OpenPage, public std::enable_shared_from_this<Page> {
 public:
  Page(Site& site, std::shared_ptr<SessionFeed> feed, PageWish wish, Connection connection, PagePlace place)
      : site_(site), feed_(std::move(feed)), wish_(wish), place_(std::move(place)), socket_(std::move(connection)) {
    ++shown();
  }

  ~Page() override {
    --shown();
    for (const databuffer::InputEvent& event : pilot_.release_all()) feed_->display->send(event);
  }

  void begin(Request request) {
    namespace websocket = boost::beast::websocket;
    request_ = std::move(request);
    socket_.next_layer().tcp().expires_never();
    socket_.set_option(websocket::stream_base::timeout::suggested(boost::beast::role_type::server));
    socket_.read_message_max(kMaxMessageBytes);
    socket_.async_accept(request_, [self = shared_from_this()](Problem problem) {
      if (problem) return;
      self->open_ = true;
      self->tell(text_of({{"right", self->wish_.right == Right::instructor ? "instructor" : "viewer"}}));
      self->tell(sets_message(self->site_.sets));
      self->read();
      self->pump();
    });
  }

  void pump() override {
    if (!open_ || writing_) return;
    if (!texts_.empty()) {
      const Text text = texts_.front();
      texts_.pop_front();
      return write(text, boost::asio::buffer(*text), true);
    }
    const std::uint64_t newest = wish_.instructor ? feed_->instructor.state_number() : feed_->display->state_number();
    const Text& state = wish_.instructor ? feed_->instructor.state() : feed_->display->state();
    if (state_sent_ != newest && state) {
      state_sent_ = newest;
      write(state, boost::asio::buffer(*state), true);
    } else if (const Bytes message = feed_->display->frames().message_after(frame_sent_)) {
      frame_sent_ = feed_->display->frames().id();
      write(message, boost::asio::buffer(*message), false);
    }
  }

  void tell(Text text) override {
    constexpr std::size_t kMostTexts = 64;  // a page that does not read them loses the oldest
    texts_.push_back(std::move(text));
    if (texts_.size() > kMostTexts) texts_.pop_front();
    pump();
  }

 private:
  using Problem = boost::system::error_code;

  int& shown() { return wish_.instructor ? feed_->instructors : feed_->displays; }

  // `owner` keeps the bytes until they are sent.
  void write(std::shared_ptr<const void> owner, boost::asio::const_buffer bytes, bool text) {
    writing_ = true;
    socket_.text(text);
    socket_.async_write(bytes, [self = shared_from_this(), owner = std::move(owner)](Problem problem, std::size_t) {
      self->writing_ = false;
      if (problem)
        self->open_ = false;
      else
        self->pump();
    });
  }

  void read() {
    socket_.async_read(buffer_, [self = shared_from_this()](Problem problem, std::size_t) {
      if (!problem && self->take()) return self->read();
      self->open_ = false;
      if (!problem) self->socket_.async_close(boost::beast::websocket::close_code::policy_error, [self](Problem) {});
    });
  }

  // Takes the message in the buffer. False: the connection is to be closed.
  bool take() {
    const auto now = std::chrono::steady_clock::now();
    if (now - second_began_ >= std::chrono::seconds{1}) {
      second_began_ = now;
      messages_ = 0;
    }
    if (++messages_ > kMaxMessagesPerSecond) {
      log::warning("a page sent more than " + std::to_string(kMaxMessagesPerSecond) + " messages in a second: closed");
      return false;
    }
    const std::string message = boost::beast::buffers_to_string(buffer_.data());
    buffer_.consume(buffer_.size());
    return take_message(site_, *feed_, pilot_, shared_from_this(), wish_.right, message);
  }

  Site& site_;
  std::shared_ptr<SessionFeed> feed_;
  PageWish wish_;
  PagePlace place_;
  boost::beast::websocket::stream<Connection, false> socket_;  // without compression: pictures are PNG
  Request request_;
  boost::beast::flat_buffer buffer_;
  PagePilot pilot_;
  std::deque<Text> texts_;
  bool open_ = false, writing_ = false;
  std::uint64_t state_sent_ = 0, frame_sent_ = 0;
  std::chrono::steady_clock::time_point second_began_{};
  int messages_ = 0;
};

}  // namespace

void begin_page(Site& site, std::shared_ptr<SessionFeed> feed, PageWish wish, Connection connection, PagePlace place,
                Request request) {
  const auto page = std::make_shared<Page>(site, std::move(feed), wish, std::move(connection), std::move(place));
  site.pages.push_back(page);
  page->begin(std::move(request));
}

}  // namespace yars::station
