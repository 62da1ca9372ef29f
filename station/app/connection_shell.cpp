#include "station/app/connection_shell.hpp"

#include <boost/asio/post.hpp>
#include <boost/beast/ssl/ssl_stream.hpp>
#include <boost/beast/websocket/ssl.hpp>
#include <boost/beast/websocket/teardown.hpp>
#include <type_traits>

namespace yars::station {

namespace {
using PlainStream = boost::beast::tcp_stream;
using TlsStream = boost::beast::ssl_stream<PlainStream>;
}  // namespace

class Connection::Transport {
 public:
  virtual ~Transport() = default;
  virtual PlainStream& tcp() = 0;
  virtual void read(std::vector<boost::asio::mutable_buffer> buffers, Moved handler) = 0;
  virtual void write(std::vector<boost::asio::const_buffer> buffers, Moved handler) = 0;
  virtual void begin(Done done) = 0;
  virtual void end(Done done) = 0;
};

template <class Stream>
class Connection::TransportOver final : public Transport {
 public:
  template <class... Arguments>
  explicit TransportOver(Arguments&&... arguments) : stream_(std::forward<Arguments>(arguments)...) {}

  PlainStream& tcp() override { return boost::beast::get_lowest_layer(stream_); }
  void read(std::vector<boost::asio::mutable_buffer> buffers, Moved handler) override {
    stream_.async_read_some(buffers, std::move(handler));
  }
  void write(std::vector<boost::asio::const_buffer> buffers, Moved handler) override {
    stream_.async_write_some(buffers, std::move(handler));
  }
  void begin(Done done) override {
    if constexpr (std::is_same_v<Stream, TlsStream>)
      stream_.async_handshake(boost::asio::ssl::stream_base::server, std::move(done));
    else
      boost::asio::post(stream_.get_executor(), [done = std::move(done)] { done({}); });
  }
  void end(Done done) override {
    using boost::beast::websocket::async_teardown;
    if constexpr (std::is_same_v<Stream, TlsStream>)
      async_teardown(boost::beast::role_type::server, stream_, std::move(done));
    else
      async_teardown(boost::beast::role_type::server, stream_.socket(), std::move(done));
  }

 private:
  Stream stream_;
};

Connection::Connection(boost::asio::ip::tcp::socket socket)
    : transport_(std::make_unique<TransportOver<PlainStream>>(std::move(socket))) {}
Connection::Connection(boost::asio::ip::tcp::socket socket, boost::asio::ssl::context& tls)
    : transport_(std::make_unique<TransportOver<TlsStream>>(PlainStream(std::move(socket)), tls)) {}
Connection::Connection(Connection&&) noexcept = default;
Connection::~Connection() = default;

boost::beast::tcp_stream& Connection::tcp() {
  return transport_->tcp();
}

void Connection::begin(Done done) {
  transport_->begin(std::move(done));
}

void Connection::end(Done done) {
  transport_->end(std::move(done));
}

void Connection::read(std::vector<boost::asio::mutable_buffer> buffers, Moved handler) {
  transport_->read(std::move(buffers), std::move(handler));
}

void Connection::write(std::vector<boost::asio::const_buffer> buffers, Moved handler) {
  transport_->write(std::move(buffers), std::move(handler));
}

}  // namespace yars::station
