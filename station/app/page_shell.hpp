// One page: its WebSocket.
// Inputs: messages of the page; states, frames and answers for it.
// Outputs: events of the pilot and commands of the instructor, as far as the page has the right.
// Errors: a message that is none, and too many messages, close the connection, with a line in the log. A command that
//   cannot be done is answered with the reason.
// Threads: that of the server.
#pragma once

#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/message.hpp>
#include <memory>
#include <string>

#include "station/app/connection_shell.hpp"
#include "station/app/site_shell.hpp"
#include "station/page_message.hpp"

namespace yars::station {

using Request = boost::beast::http::request<boost::beast::http::empty_body>;

// What a page wants and may do.
struct PageWish {
  bool instructor = false;  // the state of the instructor in place of the display's
  Right right = Right::none;
};

// Turns a connection into the WebSocket of a page. Its request must have been allowed. The page keeps its place.
void begin_page(Site& site, std::shared_ptr<SessionFeed> feed, PageWish wish, Connection connection, PagePlace place,
                Request request);

}  // namespace yars::station
