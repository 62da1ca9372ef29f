// Messages of a page.
// Inputs: the text of a message, and the right of the page.
// Outputs: events of the pilot and commands of the instructor, as far as the page has the right.
// Errors: a message that is none closes the connection, with a line in the log. A command that cannot be done is
//   answered with the reason.
// Threads: that of the server.
#pragma once

#include <memory>
#include <string>

#include "station/app/site_shell.hpp"
#include "station/page_message.hpp"

namespace yars::station {

// What a page wants and may do.
struct PageWish {
  bool instructor = false;  // the state of the instructor in place of the display's
  Right right = Right::none;
};

// Takes a message of a page: events for the session, or a command. Returns false if the connection is to be closed.
bool take_message(Site& site, SessionFeed& feed, PagePilot& pilot, const std::shared_ptr<OpenPage>& page, Right right,
                  const std::string& message);

}  // namespace yars::station
