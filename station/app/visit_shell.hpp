// HTTP over one connection of a browser, until it ends or becomes the WebSocket of a page.
// Inputs: requests. Outputs: answers with a status, and headers that keep a browser from doing more than it should.
// Errors: a request that is not allowed gets a status from 400 to 503 and a line that says what was expected.
// Threads: that of the server.
#pragma once

#include "station/app/connection_shell.hpp"
#include "station/app/site_shell.hpp"

namespace yars::station {

// Serves a connection until it ends.
void begin_visit(Site& site, Connection connection);

}  // namespace yars::station
