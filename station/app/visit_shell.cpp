#include "station/app/visit_shell.hpp"

#include <boost/asio/post.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <charconv>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "lib/text/plain_text.hpp"
#include "station/app/page_shell.hpp"

namespace yars::station {

namespace {

namespace http = boost::beast::http;

struct Answer {
  boost::beast::http::status status = boost::beast::http::status::ok;
  std::string body;
  std::string type = "text/plain; charset=utf-8";
  std::string policy = "default-src 'none'";
  std::string cookie, location;  // headers Set-Cookie and Location; empty: none
};

std::string_view view_of(boost::beast::string_view text) {
  return {text.data(), text.size()};
}

Answer refusal(http::status status, std::string body) {
  return {status, std::move(body) + '\n', "text/plain; charset=utf-8", "default-src 'none'", {}, {}};
}

// Answer to a request of a foreign host or origin: what is wrong, and what to do. nullopt: the request is allowed.
std::optional<Answer> foreign(const Site& site, const Request& request, const Origins& origins) {
  const std::string_view origin = view_of(request[http::field::origin]);
  const auto quoted = [](std::string_view text) { return "'" + text::shortened(text::printable(text)) + "'"; };
  if (!is_allowed_host(origins.host, site.access))
    return refusal(http::status::bad_request,
                   "expected localhost, an address in numbers or a name of this computer as host, found " +
                       quoted(origins.host) +
                       "; start yars-station with --names NAME (--web-names of the start script)");
  const bool must_tell = boost::beast::websocket::is_upgrade(request);
  if ((must_tell || !origin.empty()) && !is_own_origin(origin, origins))
    return refusal(http::status::forbidden,
                   "expected a page of this server, " + quoted(origins.host) + ", found one of " + quoted(origin) +
                       "; a proxy has to pass on the header Host, or X-Forwarded-Host with --behind-proxy");
  return std::nullopt;
}

Right right_of(const Site& site, const Request& request) {
  return right_of_cookies(view_of(request[http::field::cookie]), site.access);
}

// The path /patch/SESSION/ID.png: a map of the session.
std::optional<Answer> patch_of(Site& site, std::string_view path) {
  constexpr std::string_view kBegin = "/patch/", kEnd = ".png";
  if (!path.starts_with(kBegin) || !path.ends_with(kEnd)) return std::nullopt;
  path = path.substr(kBegin.size(), path.size() - kBegin.size() - kEnd.size());
  const std::size_t slash = path.find('/');
  if (slash == std::string_view::npos) return std::nullopt;
  std::uint64_t id = 0;
  const std::string_view digits = path.substr(slash + 1);
  const auto [end, problem] = std::from_chars(digits.data(), digits.data() + digits.size(), id);
  if (problem != std::errc() || end != digits.data() + digits.size()) return std::nullopt;
  const auto feed = site.feed_of(std::string(path.substr(0, slash)));
  std::string png = feed ? (*feed)->instructor.patch_png(id) : std::string();
  if (png.empty()) return std::nullopt;
  return Answer{http::status::ok, std::move(png), "image/png", "default-src 'none'", {}, {}};
}

// The page again, without the token in its address, and with a cookie that has it. Its place is relative: a proxy may
// have put the pages below a path of its own.
Answer with_cookie(const Site& site, const Origins& origins, const std::string& name, const std::string& token) {
  Answer answer = refusal(http::status::see_other, "the page follows");
  answer.cookie = cookie_of_token(token, origins, site.access);
  answer.location = name;
  return answer;
}

// A tile of the map, later.
std::optional<Answer> tile_later(Site& site, const MapTile& tile, std::function<void(Answer)> later) {
  const bool taken = site.map.request(tile, [&site, later = std::move(later)](std::shared_ptr<const std::string> png) {
    boost::asio::post(site.context,
                      [later, png] { later({http::status::ok, *png, "image/png", "default-src 'none'", {}, {}}); });
  });
  if (taken) return std::nullopt;
  return refusal(http::status::service_unavailable, "too many tiles are waited for");
}

// What a request gets. nullopt: it is answered later, by `later`, in the thread of the server.
// 400: a Host that is not this server's, or no request of HTTP; 401: no token; 403: the page of another server; 404;
// 405; 413: a body; 431: too many headers; 503: too many tiles or pages.
std::optional<Answer> answer_of(Site& site, const Request& request, const Origins& origins,
                                std::function<void(Answer)> later) {
  if (auto no = foreign(site, request, origins)) return no;
  if (request.method() != http::verb::get && request.method() != http::verb::head)
    return refusal(http::status::method_not_allowed, "expected GET or HEAD");
  const std::string_view path = view_of(request.target());
  const std::string name = file_of_path(path);
  if (const auto token = parameter_of(path, "token");
      token && right_of_token(*token, site.access) != Right::none && !name.empty())
    return with_cookie(site, origins, name, *token);
  const auto file = site.files.find(name);
  // Files that are no pages hold nothing of the session.
  const bool is_open = file != site.files.end() && !name.ends_with(".html") && !name.ends_with(".json");
  if (!is_open && right_of(site, request) == Right::none)
    return refusal(http::status::unauthorized,
                   "expected the address with its token, as yars-station printed it when it started");
  if (file != site.files.end())
    return Answer{http::status::ok, file->second, std::string(content_type_of(name)), content_policy(origins), {}, {}};
  if (const auto tile = tile_of_path(path)) return tile_later(site, *tile, std::move(later));
  if (auto patch = patch_of(site, path)) return patch;
  return refusal(http::status::not_found, "expected a page of the station");
}

// The feed and the rights for a request that wants to become a WebSocket; an answer if it may not.
struct Upgrade {
  std::shared_ptr<SessionFeed> feed;
  std::optional<PagePlace> place;
  PageWish wish;
  std::optional<Answer> refusal;
};

Upgrade upgrade_of(Site& site, const Request& request, const Origins& origins) {
  Upgrade upgrade;
  const std::string_view path = view_of(request.target());
  upgrade.refusal = foreign(site, request, origins);
  if (upgrade.refusal) return upgrade;
  upgrade.wish.right = right_of(site, request);
  if (upgrade.wish.right == Right::none) {
    upgrade.refusal = refusal(http::status::unauthorized, "expected a page that was opened with its token");
  } else if (path.substr(0, path.find('?')) != "/socket") {
    upgrade.refusal = refusal(http::status::not_found, "expected /socket");
  } else {
    upgrade.wish.instructor = parameter_of(path, "page") == "instructor";
    if (auto place = site.places.take(upgrade.wish.right, upgrade.wish.instructor, origins.visitor))
      upgrade.place.emplace(std::move(*place));
    auto feed = site.feed_of(parameter_of(path, "session").value_or(site.own_session));
    if (!feed)
      upgrade.refusal = refusal(http::status::not_found, feed.error().message());
    else if (!upgrade.place)
      upgrade.refusal = refusal(http::status::service_unavailable,
                                "expected a free place for a page, found none; " + site.places.text());
    else
      upgrade.feed = std::move(*feed);
  }
  return upgrade;
}

// A connection that asks for files and pictures, until it becomes a page or ends.
class Visit : public OpenVisit, public std::enable_shared_from_this<Visit> {
 public:
  Visit(Site& site, Connection connection) : site_(site), connection_(std::move(connection)) {}

  bool has_right() const override { return has_right_; }
  void close() override { connection_.tcp().close(); }

  void begin() {
    connection_.tcp().expires_after(kRequestTime);
    connection_.begin([self = shared_from_this()](Problem problem) {
      if (!problem) self->read();
    });
  }

 private:
  using Problem = boost::system::error_code;
  static constexpr std::chrono::seconds kRequestTime{15};  // for a request to arrive and its answer to leave
  static constexpr std::uint32_t kMaxHeaderBytes = 8192;

  void read() {
    parser_.emplace();
    parser_->header_limit(kMaxHeaderBytes);
    parser_->body_limit(0);
    connection_.tcp().expires_after(kRequestTime);
    http::async_read(connection_, buffer_, *parser_, [self = shared_from_this()](Problem problem, std::size_t) {
      if (!problem) return self->take(self->parser_->release());
      if (const auto answer = malformed(problem)) self->send(*answer, 11, false, false);
    });
  }

  // The answer to what is no request; nullopt: the connection has ended.
  static std::optional<Answer> malformed(const Problem& problem) {
    const Problem ended[] = {http::error::end_of_stream, http::error::partial_message};
    const bool of_http = problem.category() == Problem(http::error::bad_method).category();
    if (!of_http || problem == ended[0] || problem == ended[1]) return std::nullopt;
    if (problem == http::error::header_limit || problem == http::error::buffer_overflow)
      return refusal(http::status::request_header_fields_too_large,
                     "expected at most " + std::to_string(kMaxHeaderBytes) + " bytes of headers, found more");
    if (problem == http::error::body_limit)
      return refusal(http::status::payload_too_large, "expected a request without a body, found one");
    return refusal(http::status::bad_request, "expected a request of HTTP/1.1, found a fault: " + problem.message());
  }

  // The address of the browser's computer.
  std::string peer() {
    Problem problem;
    const auto end = connection_.tcp().socket().remote_endpoint(problem);
    return problem ? std::string() : end.address().to_string();
  }

  void take(Request request) {
    const bool head = request.method() == boost::beast::http::verb::head;
    const bool keep = request.keep_alive();
    const unsigned version = request.version();
    const Origins origins = origins_of(view_of(request[http::field::host]), peer(),
                                       {view_of(request["X-Forwarded-Host"]), view_of(request["X-Forwarded-Proto"]),
                                        view_of(request["X-Forwarded-For"])},
                                       site_.access);
    has_right_ = has_right_ || right_of(site_, request) != Right::none;
    if (boost::beast::websocket::is_upgrade(request)) {
      Upgrade upgrade = upgrade_of(site_, request, origins);
      if (upgrade.refusal) return send(*upgrade.refusal, version, keep, head);
      return begin_page(site_, std::move(upgrade.feed), upgrade.wish, std::move(connection_), std::move(*upgrade.place),
                        std::move(request));
    }
    auto later = [self = shared_from_this(), version, keep, head](Answer answer) {
      self->send(std::move(answer), version, keep, head);
    };
    if (auto answer = answer_of(site_, request, origins, later)) send(std::move(*answer), version, keep, head);
  }

  void send(Answer given, unsigned version, bool keep_alive, bool head) {
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
    http::async_write(connection_, *answer, [self = shared_from_this(), answer](Problem problem, std::size_t) {
      if (!problem && answer->keep_alive()) return self->read();
      Problem ignored;
      self->connection_.tcp().socket().shutdown(boost::asio::ip::tcp::socket::shutdown_send, ignored);
    });
  }

  Site& site_;
  bool has_right_ = false;  // a request had a token
  Connection connection_;
  boost::beast::flat_buffer buffer_{kMaxHeaderBytes + kMaxMessageBytes};
  std::optional<boost::beast::http::request_parser<boost::beast::http::empty_body>> parser_;
};

}  // namespace

void begin_visit(Site& site, Connection connection) {
  const auto visit = std::make_shared<Visit>(site, std::move(connection));
  site.visits.add(visit);
  visit->begin();
}

}  // namespace yars::station
