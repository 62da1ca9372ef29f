#include "station/app/server_shell.hpp"

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <map>
#include <optional>
#include <utility>

#include "lib/file/text_file.hpp"
#include "lib/log/log.hpp"
#include "station/app/visit_shell.hpp"

namespace yars::station {

namespace {

namespace asio = boost::asio;
using boost::system::error_code;
using tcp = asio::ip::tcp;

constexpr std::chrono::milliseconds kLookInterval{5};   // at the segments
constexpr std::chrono::milliseconds kAcceptPause{100};  // after a connection that could not be taken

// Contents of the files of a folder by their names.
error::Expected<std::map<std::string, std::string>> read_pages(const std::filesystem::path& pages) {
  std::map<std::string, std::string> files;
  std::error_code code;
  for (std::filesystem::directory_iterator entry(pages, code), end; !code && entry != end; entry.increment(code)) {
    if (!entry->is_regular_file(code)) continue;
    auto text = file::read_text_file(entry->path());
    if (!text) return tl::unexpected(text.error());
    files[entry->path().filename().string()] = std::move(*text);
  }
  if (!files.contains("display.html"))
    return error::fail("pages", "a folder with display.html", pages.empty() ? "none" : pages.string(),
                       "give --pages the folder share/yars/station of an installation");
  return files;
}

error::Expected<void> use_certificate(asio::ssl::context& tls, const ServerSettings& settings) {
  error_code problem;
  tls.set_options(asio::ssl::context::default_workarounds | asio::ssl::context::no_sslv2 |
                  asio::ssl::context::no_sslv3 | asio::ssl::context::no_tlsv1 | asio::ssl::context::no_tlsv1_1);
  const auto certificate = file::read_text_file(settings.certificate);
  if (!certificate) return tl::unexpected(certificate.error());
  const auto key = file::read_text_file(settings.key);
  if (!key) return tl::unexpected(key.error());
  tls.use_certificate_chain(asio::buffer(*certificate), problem);
  if (problem)
    return error::fail("--certificate", "a certificate in PEM", settings.certificate + " (" + problem.message() + ")");
  tls.use_private_key(asio::buffer(*key), asio::ssl::context::pem, problem);
  if (problem)
    return error::fail("--key", "the private key of the certificate, in PEM",
                       settings.key + " (" + problem.message() + ")");
  return {};
}

}  // namespace

struct Server::Work {
  Work(ServerSettings given, std::unique_ptr<model::terrain::TerrainStore> terrain)
      : settings(std::move(given)), site(context, settings.sets, std::move(terrain)) {}

  error::Expected<void> open();
  void accept();
  void accept_later(const error_code& problem);
  void look();

  ServerSettings settings;
  asio::io_context context{1};
  Site site;
  std::optional<asio::ssl::context> tls;
  tcp::acceptor acceptor{context};
  asio::steady_timer timer{context}, pause{context};
  std::shared_ptr<SessionFeed> own_feed;  // present while no page is open, too
};

error::Expected<void> Server::Work::open() {
  if (!settings.certificate.empty()) {
    tls.emplace(asio::ssl::context::tls_server);
    if (auto used = use_certificate(*tls, settings); !used) return used;
  }
  error_code problem;
  const auto address = asio::ip::make_address(settings.address, problem);
  if (problem) return error::fail("--listen", "an address in numbers", settings.address, "0.0.0.0 stands for all");
  const tcp::endpoint place(address, settings.access.port);
  acceptor.open(place.protocol(), problem);
  if (!problem) acceptor.set_option(tcp::acceptor::reuse_address(true), problem);
  if (!problem) acceptor.bind(place, problem);
  if (!problem) acceptor.listen(asio::socket_base::max_listen_connections, problem);
  if (problem)
    return error::fail("--port", "a free port", std::to_string(place.port()) + " (" + problem.message() + ")",
                       "choose another (--web-port of the start script), or 0 for any free one");
  site.access = settings.access;
  site.access.port = acceptor.local_endpoint().port();
  site.access.tls = tls.has_value();
  auto feed = site.feed_of(site.own_session);
  if (!feed) return tl::unexpected(feed.error());
  own_feed = std::move(*feed);
  return {};
}

void Server::Work::accept() {
  acceptor.async_accept([this](error_code problem, tcp::socket socket) {
    if (problem == asio::error::operation_aborted) return;
    if (problem) return accept_later(problem);
    error_code ignored;
    socket.set_option(tcp::no_delay(true), ignored);
    begin_visit(site, tls ? Connection(std::move(socket), *tls) : Connection(std::move(socket)));
    accept();
  });
}

// Such as without free descriptors: the waiting connection would fail again at once.
void Server::Work::accept_later(const error_code& problem) {
  log::warning("a connection could not be taken: " + problem.message());
  pause.expires_after(kAcceptPause);
  pause.async_wait([this](error_code stopped) {
    if (!stopped) accept();
  });
}

void Server::Work::look() {
  timer.expires_after(kLookInterval);
  timer.async_wait([this](error_code problem) {
    if (problem) return;
    site.look();
    look();
  });
}

error::Expected<Server> Server::listen(ServerSettings settings, std::unique_ptr<model::terrain::TerrainStore> terrain) {
  auto files = read_pages(settings.pages);
  if (!files) return tl::unexpected(files.error());
  auto work = std::make_unique<Work>(std::move(settings), std::move(terrain));
  work->site.files = std::move(*files);
  work->site.files["theatre.json"] = work->settings.theatre;
  if (auto opened = work->open(); !opened) return tl::unexpected(opened.error());
  work->accept();
  work->look();
  return Server(std::move(work));
}

Server::Server(std::unique_ptr<Work> work) : work_(std::move(work)) {}
Server::Server(Server&&) noexcept = default;
Server::~Server() = default;

std::uint16_t Server::port() const {
  return work_->site.access.port;
}

void Server::step() {
  work_->context.run_one();
}

}  // namespace yars::station
