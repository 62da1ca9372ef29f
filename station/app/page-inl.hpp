// Page, a template over the stream of a connection: an open WebSocket.
// Inputs: messages of the page; states, frames and answers for it.
// Outputs: see take_message().
// Errors: see take_message(). Too many messages close the connection, with a line in the log.
// Threads: that of the server.
#pragma once

#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <utility>

#include "lib/log/log.hpp"
#include "station/app/page_shell.hpp"
#include "station/app/visit_shell.hpp"

namespace yars::station {

template <class Stream>
class Page final : public OpenPage, public std::enable_shared_from_this<Page<Stream>> {
 public:
  Page(Site& site, std::shared_ptr<SessionFeed> feed, PageWish wish, Stream stream, Counted counted)
      : site_(site), feed_(std::move(feed)), wish_(wish), counted_(std::move(counted)), socket_(std::move(stream)) {
    ++shown();
  }

  ~Page() override {
    --shown();
    for (const databuffer::InputEvent& event : pilot_.release_all()) feed_->display->send(event);
  }

  void begin(boost::beast::http::request<boost::beast::http::empty_body> request) {
    namespace websocket = boost::beast::websocket;
    request_ = std::move(request);
    boost::beast::get_lowest_layer(socket_).expires_never();
    socket_.set_option(websocket::stream_base::timeout::suggested(boost::beast::role_type::server));
    socket_.read_message_max(kMaxMessageBytes);
    socket_.async_accept(request_, [self = this->shared_from_this()](Problem problem) {
      if (problem) return;
      self->open_ = true;
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
    socket_.async_write(bytes,
                        [self = this->shared_from_this(), owner = std::move(owner)](Problem problem, std::size_t) {
                          self->writing_ = false;
                          if (problem)
                            self->open_ = false;
                          else
                            self->pump();
                        });
  }

  void read() {
    socket_.async_read(buffer_, [self = this->shared_from_this()](Problem problem, std::size_t) {
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
    return take_message(site_, *feed_, pilot_, this->shared_from_this(), wish_.right, message);
  }

  Site& site_;
  std::shared_ptr<SessionFeed> feed_;
  PageWish wish_;
  Counted counted_;
  boost::beast::websocket::stream<Stream, false> socket_;  // without compression: pictures are PNG
  boost::beast::http::request<boost::beast::http::empty_body> request_;
  boost::beast::flat_buffer buffer_;
  PagePilot pilot_;
  std::deque<Text> texts_;
  bool open_ = false, writing_ = false;
  std::uint64_t state_sent_ = 0, frame_sent_ = 0;
  std::chrono::steady_clock::time_point second_began_{};
  int messages_ = 0;
};

template <class Stream>
void open_page(Site& site, Upgrade upgrade, Stream stream, Counted counted, Request request) {
  const auto page = std::make_shared<Page<Stream>>(site, std::move(upgrade.feed), upgrade.wish, std::move(stream),
                                                   std::move(counted));
  site.pages.push_back(page);
  page->begin(std::move(request));
}

}  // namespace yars::station
