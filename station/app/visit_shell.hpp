// A connection of a browser that asks for files and pictures, until it becomes a page's WebSocket or ends.
// Inputs: requests. Outputs: answers with a status, and headers that keep a browser from doing more than it should.
// Errors: see answer_of().
// Threads: that of the server.
#pragma once

#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/status.hpp>
#include <boost/beast/ssl/ssl_stream.hpp>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "station/app/page_shell.hpp"

namespace yars::station {

using Request = boost::beast::http::request<boost::beast::http::empty_body>;

struct Answer {
  boost::beast::http::status status = boost::beast::http::status::ok;
  std::string body;
  std::string type = "text/plain; charset=utf-8";
  std::string policy = "default-src 'none'";
  std::string cookie, location;  // headers Set-Cookie and Location; empty: none
};

// What a request gets. nullopt: it is answered later, by `later`, in the thread of the server.
// 400: a Host that is not this server's; 401: no token; 403: the page of another server; 404; 405; 503: too many tiles.
std::optional<Answer> answer_of(Site& site, const Request& request, std::function<void(Answer)> later);

// The feed and the rights for a request that wants to become a WebSocket; an answer if it may not.
struct Upgrade {
  std::shared_ptr<SessionFeed> feed;
  PageWish wish;
  std::optional<Answer> refusal;
};
Upgrade upgrade_of(Site& site, const Request& request);

using PlainStream = boost::beast::tcp_stream;
using TlsStream = boost::beast::ssl_stream<PlainStream>;

// Makes a connection whose request was allowed to the WebSocket of a page.
void begin_page(Site& site, Upgrade upgrade, PlainStream stream, Counted counted, Request request);
void begin_page(Site& site, Upgrade upgrade, TlsStream stream, Counted counted, Request request);

// Serves a connection until it ends, beginning with the handshake of TLS, if there is any.
void begin_visit(Site& site, PlainStream stream);
void begin_visit(Site& site, TlsStream stream);

}  // namespace yars::station
