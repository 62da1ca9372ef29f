#include "station/app/server_shell.hpp"

#include <algorithm>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lib/file/text_file.hpp"
#include "lib/log/log.hpp"
#include "station/access.hpp"
#include "station/page_message.hpp"

namespace yars::station {

namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using boost::system::error_code;
using tcp = asio::ip::tcp;

constexpr std::chrono::milliseconds kLookInterval{5};  // at the segment
constexpr std::chrono::seconds kRequestTime{15};       // for a request to arrive and its answer to leave
constexpr std::uint32_t kMaxHeaderBytes = 8192;

std::string_view view_of(beast::string_view text) {
  return {text.data(), text.size()};
}

}  // namespace

class Client;

struct Server::Work {
  Work(StationFeed& given, std::map<std::string, std::string> read) : feed(given), files(std::move(read)) {}

  void accept();
  void look();
  void pump();

  StationFeed& feed;
  std::map<std::string, std::string> files;  // contents by name
  asio::io_context context{1};
  tcp::acceptor acceptor{context};
  asio::steady_timer timer{context};
  std::uint16_t port = 0;
  int connections = 0;
  std::vector<std::weak_ptr<Client>> clients;
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

// One page: its WebSocket.
class Client : public std::enable_shared_from_this<Client> {
 public:
  Client(Server::Work& work, beast::tcp_stream stream, Counted counted)
      : work_(work), counted_(std::move(counted)), socket_(std::move(stream)) {}

  ~Client() {
    for (const databuffer::InputEvent& event : pilot_.release_all()) work_.feed.send(event);
  }

  void begin(http::request<http::empty_body> request) {
    request_ = std::move(request);
    beast::get_lowest_layer(socket_).expires_never();
    socket_.set_option(websocket::stream_base::timeout::suggested(beast::role_type::server));
    socket_.read_message_max(kMaxMessageBytes);
    socket_.async_accept(request_, [self = shared_from_this()](error_code problem) {
      if (problem) return;
      self->open_ = true;
      self->read();
      self->pump();
    });
  }

  // Sends the newest state and frame, if nothing is on its way and the page has not got them yet.
  void pump() {
    if (!open_ || writing_) return;
    if (state_sent_ != work_.feed.state_number() && work_.feed.state()) {
      state_sent_ = work_.feed.state_number();
      write(work_.feed.state(), true);
    } else if (const Bytes message = work_.feed.frames().message_after(frame_sent_)) {
      frame_sent_ = work_.feed.frames().id();
      write(message, false);
    }
  }

 private:
  template <class Data>
  void write(Data data, bool text) {
    writing_ = true;
    socket_.text(text);
    const auto buffer = asio::buffer(*data);
    socket_.async_write(buffer, [self = shared_from_this(), data](error_code problem, std::size_t) {
      self->writing_ = false;
      if (problem)
        self->open_ = false;
      else
        self->pump();
    });
  }

  void read() {
    socket_.async_read(buffer_, [self = shared_from_this()](error_code problem, std::size_t) {
      if (!problem && self->take()) {
        self->read();
        return;
      }
      self->open_ = false;
      if (!problem) self->close(websocket::close_code::policy_error);
    });
  }

  void close(websocket::close_code code) {
    socket_.async_close(code, [self = shared_from_this()](error_code) {});
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
    const std::string message = beast::buffers_to_string(buffer_.data());
    buffer_.consume(buffer_.size());
    const auto events = pilot_.events_of(message);
    if (!events) {
      log::warning("a page is refused: " + events.error().message());
      return false;
    }
    for (const databuffer::InputEvent& event : *events) work_.feed.send(event);
    return true;
  }

  Server::Work& work_;
  Counted counted_;
  websocket::stream<beast::tcp_stream> socket_;
  http::request<http::empty_body> request_;
  beast::flat_buffer buffer_;
  PagePilot pilot_;
  bool open_ = false, writing_ = false;
  std::uint64_t state_sent_ = 0, frame_sent_ = 0;
  std::chrono::steady_clock::time_point second_began_{};
  int messages_ = 0;
};

// A connection that asks for files, until it becomes a Client or ends.
class Visit : public std::enable_shared_from_this<Visit> {
 public:
  Visit(Server::Work& work, tcp::socket socket) : work_(work), counted_(work.connections), stream_(std::move(socket)) {}

  void read() {
    parser_.emplace();
    parser_->header_limit(kMaxHeaderBytes);
    parser_->body_limit(0);
    stream_.expires_after(kRequestTime);
    http::async_read(stream_, buffer_, *parser_, [self = shared_from_this()](error_code problem, std::size_t) {
      if (!problem) self->answer(self->parser_->release());
    });
  }

 private:
  using Request = http::request<http::empty_body>;

  void answer(Request request) {
    const std::string host(view_of(request[http::field::host]));
    const std::string_view origin = view_of(request[http::field::origin]);
    const bool upgrade = websocket::is_upgrade(request);
    if (!is_local_host(host, work_.port)) {
      send(request, http::status::bad_request, "expected a Host of this computer\n");
    } else if ((upgrade || !origin.empty()) && !is_own_origin(origin, host)) {
      send(request, http::status::forbidden, "expected a page of this server\n");
    } else if (upgrade && request.target() == "/socket") {
      const auto client = std::make_shared<Client>(work_, std::move(stream_), std::move(counted_));
      work_.clients.push_back(client);
      client->begin(std::move(request));
    } else if (request.method() != http::verb::get && request.method() != http::verb::head) {
      send(request, http::status::method_not_allowed, "expected GET or HEAD\n");
    } else {
      send_file(request, host);
    }
  }

  void send_file(const Request& request, const std::string& host) {
    const std::string name = file_of_path(view_of(request.target()));
    const auto file = work_.files.find(name);
    if (file == work_.files.end()) return send(request, http::status::not_found, "expected a page of the station\n");
    send(request, http::status::ok, file->second, content_type_of(name), content_policy(host));
  }

  void send(const Request& request, http::status status, std::string body,
            std::string_view type = "text/plain; charset=utf-8", const std::string& policy = "default-src 'none'") {
    auto answer = std::make_shared<http::response<http::string_body>>(status, request.version());
    answer->set(http::field::content_type, beast::string_view(type.data(), type.size()));
    answer->set("Content-Security-Policy", policy);
    answer->set("X-Content-Type-Options", "nosniff");
    answer->set("Referrer-Policy", "no-referrer");
    answer->set("Cross-Origin-Resource-Policy", "same-origin");
    answer->set(http::field::cache_control, "no-cache");
    answer->keep_alive(request.keep_alive());
    answer->body() = std::move(body);
    answer->prepare_payload();
    if (request.method() == http::verb::head) answer->body().clear();
    http::async_write(stream_, *answer, [self = shared_from_this(), answer](error_code problem, std::size_t) {
      if (!problem && answer->keep_alive()) return self->read();
      error_code ignored;
      self->stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
    });
  }

  Server::Work& work_;
  Counted counted_;
  beast::tcp_stream stream_;
  beast::flat_buffer buffer_{kMaxHeaderBytes + kMaxMessageBytes};
  std::optional<http::request_parser<http::empty_body>> parser_;
};

void Server::Work::accept() {
  acceptor.async_accept([this](error_code problem, tcp::socket socket) {
    if (problem == asio::error::operation_aborted) return;
    if (!problem && connections < kMaxConnections) {
      error_code ignored;
      socket.set_option(tcp::no_delay(true), ignored);
      std::make_shared<Visit>(*this, std::move(socket))->read();
    }
    accept();
  });
}

void Server::Work::look() {
  timer.expires_after(kLookInterval);
  timer.async_wait([this](error_code problem) {
    if (problem) return;
    std::erase_if(clients, [](const std::weak_ptr<Client>& client) { return client.expired(); });
    if (!clients.empty() && feed.refresh()) pump();
    look();
  });
}

void Server::Work::pump() {
  for (const std::weak_ptr<Client>& entry : clients)
    if (const auto client = entry.lock()) client->pump();
}

error::Expected<Server> Server::listen(StationFeed& feed, const std::filesystem::path& pages, std::uint16_t port) {
  std::map<std::string, std::string> files;
  std::error_code code;
  for (std::filesystem::directory_iterator entry(pages, code), end; !code && entry != end; entry.increment(code)) {
    if (!entry->is_regular_file(code)) continue;
    auto text = file::read_text_file(entry->path());
    if (!text) return tl::unexpected(text.error());
    files[entry->path().filename().string()] = std::move(*text);
  }
  if (!files.contains("display.html"))
    return error::fail("pages", "a folder with display.html", pages.string(),
                       "give --pages the folder share/yars/station of an installation");
  auto work = std::make_unique<Work>(feed, std::move(files));
  error_code problem;
  const tcp::endpoint address(asio::ip::address_v4::loopback(), port);
  work->acceptor.open(address.protocol(), problem);
  if (!problem) work->acceptor.set_option(tcp::acceptor::reuse_address(true), problem);
  if (!problem) work->acceptor.bind(address, problem);
  if (!problem) work->acceptor.listen(asio::socket_base::max_listen_connections, problem);
  if (problem)
    return error::fail("--port", "a free port", std::to_string(port) + " (" + problem.message() + ")",
                       "choose another, or 0 for any free one");
  work->port = work->acceptor.local_endpoint().port();
  work->accept();
  work->look();
  return Server(std::move(work));
}

Server::Server(std::unique_ptr<Work> work) : work_(std::move(work)) {}
Server::Server(Server&&) noexcept = default;
Server::~Server() = default;

std::uint16_t Server::port() const {
  return work_->port;
}

void Server::step() {
  work_->context.run_one();
}

}  // namespace yars::station
