// Visit, a template over the stream of a connection: it answers requests until the connection becomes a page or ends.
// Plain and TLS streams have a source each, and Page (page-inl.hpp) two others: together they take two gigabytes to
// compile. Inputs: requests. Outputs: answers with a status, and headers that keep a browser from doing more than it
// should. Errors: see answer_of(). Threads: that of the server.
#pragma once

#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "station/app/visit_shell.hpp"

namespace yars::station {

template <class Stream>
class Visit : public std::enable_shared_from_this<Visit<Stream>> {
 public:
  Visit(Site& site, Stream stream) : site_(site), counted_(site.connections), stream_(std::move(stream)) {}

  // Begins with the handshake of TLS, if there is any.
  void begin() {
    if constexpr (std::is_same_v<Stream, PlainStream>) {
      read();
    } else {
      boost::beast::get_lowest_layer(stream_).expires_after(kRequestTime);
      stream_.async_handshake(boost::asio::ssl::stream_base::server,
                              [self = this->shared_from_this()](Problem problem) {
                                if (!problem) self->read();
                              });
    }
  }

 private:
  using Problem = boost::system::error_code;
  static constexpr std::chrono::seconds kRequestTime{15};  // for a request to arrive and its answer to leave
  static constexpr std::uint32_t kMaxHeaderBytes = 8192;

  void read() {
    namespace http = boost::beast::http;
    parser_.emplace();
    parser_->header_limit(kMaxHeaderBytes);
    parser_->body_limit(0);
    boost::beast::get_lowest_layer(stream_).expires_after(kRequestTime);
    http::async_read(stream_, buffer_, *parser_, [self = this->shared_from_this()](Problem problem, std::size_t) {
      if (!problem) self->take(self->parser_->release());
    });
  }

  void take(Request request) {
    const bool head = request.method() == boost::beast::http::verb::head;
    const bool keep = request.keep_alive();
    const unsigned version = request.version();
    if (boost::beast::websocket::is_upgrade(request)) {
      Upgrade upgrade = upgrade_of(site_, request);
      if (upgrade.refusal) return send(*upgrade.refusal, version, keep, head);
      return begin_page(site_, std::move(upgrade), std::move(stream_), std::move(counted_), std::move(request));
    }
    auto later = [self = this->shared_from_this(), version, keep, head](Answer answer) {
      self->send(std::move(answer), version, keep, head);
    };
    if (auto answer = answer_of(site_, request, later)) send(std::move(*answer), version, keep, head);
  }

  void send(Answer given, unsigned version, bool keep_alive, bool head) {
    namespace http = boost::beast::http;
    auto answer = std::make_shared<http::response<http::string_body>>(given.status, version);
    answer->set(http::field::content_type, given.type);
    answer->set("Content-Security-Policy", given.policy);
    answer->set("X-Content-Type-Options", "nosniff");
    answer->set("Referrer-Policy", "no-referrer");
    answer->set("Cross-Origin-Resource-Policy", "same-origin");
    answer->set(http::field::cache_control, given.type == "image/png" ? "private, max-age=3600" : "no-cache");
    if (!given.cookie.empty()) answer->set(http::field::set_cookie, given.cookie);
    if (!given.location.empty()) answer->set(http::field::location, given.location);
    answer->keep_alive(keep_alive);
    answer->body() = std::move(given.body);
    answer->prepare_payload();
    if (head) answer->body().clear();
    http::async_write(stream_, *answer, [self = this->shared_from_this(), answer](Problem problem, std::size_t) {
      if (!problem && answer->keep_alive()) return self->read();
      Problem ignored;
      boost::beast::get_lowest_layer(self->stream_)
          .socket()
          .shutdown(boost::asio::ip::tcp::socket::shutdown_send, ignored);
    });
  }

  Site& site_;
  Counted counted_;
  Stream stream_;
  boost::beast::flat_buffer buffer_{kMaxHeaderBytes + kMaxMessageBytes};
  std::optional<boost::beast::http::request_parser<boost::beast::http::empty_body>> parser_;
};

}  // namespace yars::station
