// Start of a program that holds a role: opens the session and claims the role, at once or as a standby.
// Inputs: name of the session, the role, the program's name in the process table.
// Outputs: the session and the claim.
// Errors: those of Session::open(); without `standby` also a role that another process holds.
// Threads: main thread only.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "databuffer/session/session.hpp"
#include "lib/error/error.hpp"
#include "runtime/command_line.hpp"

namespace yars::runtime {

struct HeldRole {
  databuffer::Session session;
  databuffer::Claim claim;
};

// Adds the option --standby.
void add_standby_option(CommandLine& app, bool& standby);

// Claims the role. With `standby` waits while another process holds it, and while another host of the session does. The
// process table shows a waiting program as "NAME standby". nullopt: a stop was requested while waiting.
// `meanwhile` is called every 10 ms while it waits, to prepare for the role.
error::Expected<std::optional<HeldRole>> take_role(
    const std::string& session, databuffer::Role role, std::string_view program, bool standby,
    const std::function<void(const databuffer::Session&)>& meanwhile = {});

// Outcome of a program without --standby whose role another host of the session has taken.
tl::unexpected<error::Error> fail_yielded(databuffer::Role role);

}  // namespace yars::runtime
