// Connection of a browser: a TCP stream, plain or over TLS, behind one type. So HTTP and WebSocket are compiled once.
// It is an AsyncStream of Boost.Beast. It may be moved while no operation runs.
// Inputs: the socket of an accepted connection; for TLS the context with the certificate.
// Outputs: bytes that are read and written, through handlers. No handler is called within the call that began its
//   operation.
// Errors: those of the stream, for the handler.
// Threads: that of the server.
#pragma once

#include <boost/asio/async_result.hpp>
#include <boost/asio/buffer.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/beast/core/role.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace yars::station {

class Connection {
 public:
  using executor_type = boost::beast::tcp_stream::executor_type;
  using Problem = boost::system::error_code;
  using Moved = std::function<void(Problem, std::size_t)>;  // bytes that were read or written
  using Done = std::function<void(Problem)>;

  // Plain or over TLS.
  explicit Connection(boost::asio::ip::tcp::socket socket);
  Connection(boost::asio::ip::tcp::socket socket, boost::asio::ssl::context& tls);
  Connection(Connection&&) noexcept;
  ~Connection();

  executor_type get_executor() { return tcp().get_executor(); }
  // The TCP stream, which has the time limits of its operations.
  boost::beast::tcp_stream& tcp();
  // Handshake of TLS; of a plain stream there is none.
  void begin(Done done);
  // Closes the connection; over TLS after its close_notify.
  void end(Done done);

  template <class Buffers, class Token>
  BOOST_ASIO_INITFN_RESULT_TYPE(Token, void(Problem, std::size_t))
  async_read_some(const Buffers& buffers, Token&& token) {
    return boost::asio::async_initiate<Token, void(Problem, std::size_t)>(
        [this](auto&& handler, std::vector<boost::asio::mutable_buffer> list) {
          read(std::move(list), kept<Moved>(std::move(handler)));
        },
        token, list_of<boost::asio::mutable_buffer>(buffers));
  }
  template <class Buffers, class Token>
  BOOST_ASIO_INITFN_RESULT_TYPE(Token, void(Problem, std::size_t))
  async_write_some(const Buffers& buffers, Token&& token) {
    return boost::asio::async_initiate<Token, void(Problem, std::size_t)>(
        [this](auto&& handler, std::vector<boost::asio::const_buffer> list) {
          write(std::move(list), kept<Moved>(std::move(handler)));
        },
        token, list_of<boost::asio::const_buffer>(buffers));
  }

  // Boost.Beast calls the first at the end of a WebSocket, the second when its time is up.
  template <class Handler>
  friend void async_teardown(boost::beast::role_type, Connection& connection, Handler&& handler) {
    connection.end(kept<Done>(std::forward<Handler>(handler)));
  }
  friend void beast_close_socket(Connection& connection) { connection.tcp().close(); }

 private:
  class Transport;  // of connection_shell.cpp
  template <class Stream>
  class TransportOver;

  void read(std::vector<boost::asio::mutable_buffer> buffers, Moved handler);
  void write(std::vector<boost::asio::const_buffer> buffers, Moved handler);

  // A handler of Boost.Beast, which can only be moved, as a function that can be copied.
  template <class Function, class Handler>
  static Function kept(Handler handler) {
    auto owner = std::make_shared<Handler>(std::move(handler));
    return [owner](auto... results) { (std::move(*owner))(results...); };
  }
  template <class Buffer, class Buffers>
  static std::vector<Buffer> list_of(const Buffers& buffers) {
    return {boost::asio::buffer_sequence_begin(buffers), boost::asio::buffer_sequence_end(buffers)};
  }

  std::unique_ptr<Transport> transport_;
};

}  // namespace yars::station
