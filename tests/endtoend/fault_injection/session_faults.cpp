// Faults of the session: a full /dev/shm, segments of another layout or user, second sets, clocks.
#include <fcntl.h>
#include <signal.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <fstream>

#include "shm/segment.hpp"
#include "tests/endtoend/fault_injection/fault_set.hpp"
#include "tests/endtoend/fault_injection/faults.hpp"
#include "tests/shm/segment_path.hpp"

namespace yars::endtoend::fault_injection {

namespace {

constexpr const char* kFiller = "/dev/shm/yars-fault-filler";

// Reports a problem unless the program ended with `code` and an error text that contains `word`.
void expect_refusal(FaultSet& set, const Finished& finished, int code, const std::string& word,
                    const std::string& what) {
  if (finished.code != code || finished.errors.find(word) == std::string::npos)
    set.tell(what + ": expected code " + std::to_string(code) + " and '" + word + "', found code " +
             std::to_string(finished.code) + ": " + finished.output + finished.errors);
}

std::string other_session(const FaultSet&) {
  return "fault-other-" + std::to_string(getpid());
}

// Fills /dev/shm with one file.
void fill_memory() {
  const int file = open(kFiller, O_CREAT | O_WRONLY | O_CLOEXEC, 0600);
  struct statvfs room{};
  if (statvfs("/dev/shm", &room) == 0)
    posix_fallocate(file, 0, static_cast<off_t>(room.f_bavail) * static_cast<off_t>(room.f_frsize));
  close(file);
}

// With a full /dev/shm, a role of the running set is restarted without a new allocation. A new session is refused.
void full_memory(FaultSet& set, const std::string&) {
  const auto session = other_session(set);
  if (!set.alone_in_memory()) {
    // The machine's own /dev/shm is never filled. A limit on the size of files causes the same error.
    const auto refused = run_tool({"prlimit", "--fsize=1000000", "env", "--ignore-signal=SIGXFSZ",
                                   std::string(YARS_BIN_DIR) + "/state-machine", "--session", session});
    return expect_refusal(set, refused, 1, "/dev/shm", "no room in /dev/shm");
  }
  fill_memory();
  const auto& role = kRoles[set.below(kRoles.size())];
  set.kill(role);
  set.mend();
  expect_refusal(set, set.other({"state-machine", "--session", session}), 1, "/dev/shm", "no room in /dev/shm");
  set.rest_ms(20.0, 300.0);
  std::filesystem::remove(kFiller);
}

// Overwrites hash and version of the layout in the segment of a second session. Every program must refuse that segment,
// and the set under test must not be affected.
void wrong_layout(FaultSet& set, const std::string&) {
  const auto session = other_session(set);
  const auto path = test::segment_path(session);
  set.processes().start_tool("holder", {std::string(YARS_BIN_DIR) + "/state-machine", "--session", session});
  if (!eventually([&] { return std::filesystem::exists(path); }, 20.0)) set.tell("no segment at " + path);
  const int file = open(path.c_str(), O_RDWR | O_CLOEXEC);
  const std::array<std::uint64_t, 2> other{set.chance()(), set.below(2) == 0 ? 1U : 99U};  // SegmentHeader from byte 16
  const bool written = pwrite(file, other.data(), sizeof other, 16) == sizeof other;
  close(file);
  if (!written) {
    set.tell("the segment's header could not be changed: " + std::string(std::strerror(errno)));
  } else {
    expect_refusal(set, set.other({"yars", "--session", session, "status"}), 1, "version", "status of another layout");
    expect_refusal(set, set.other({"radar-model", "--session", session}), 1, "version", "a role of another layout");
    expect_refusal(set, set.other({"fault_client", "restore", session, "1"}), 1, "version",
                   "a client of another layout");
  }
  set.processes().kill("holder", SIGTERM);
  if (const int code = set.processes().wait("holder"); code != 0)
    set.tell("the holder ended with " + std::to_string(code));
  std::filesystem::remove(path);
}

// Another user can neither read, write nor remove our segment. A file of that user under a session's name is refused.
void another_user(FaultSet& set, const std::string&) {
  if (geteuid() != 0 || !tool_exists("setpriv")) return;
  const std::vector<std::string> nobody{"setpriv", "--reuid=65534", "--regid=65534", "--clear-groups"};
  const auto as_nobody = [&](std::initializer_list<std::string> words) {
    auto command = nobody;
    command.insert(command.end(), words);
    return run_tool(command);
  };
  const auto ours = test::segment_path(set.processes().session());
  if (as_nobody({"dd", "if=" + ours, "of=/dev/null", "count=1"}).code == 0) set.tell("another user reads our segment");
  if (as_nobody({"sh", "-c", "echo >> " + ours}).code == 0) set.tell("another user writes into our segment");
  if (as_nobody({"rm", "-f", ours}).code == 0) set.tell("another user takes our segment away");
  const auto theirs = test::segment_path(other_session(set));
  as_nobody({"sh", "-c", "head -c 30000000 /dev/zero > " + theirs + " && chmod 666 " + theirs});
  expect_refusal(set, set.other({"state-machine", "--session", other_session(set)}), 1, "user",
                 "another user's segment");
  // The error of a client names the file.
  expect_refusal(set, set.other({"fault_client", "restore", other_session(set), "1"}), 1, theirs,
                 "another user's segment for a client");
  std::filesystem::remove(theirs);
}

// The same session name again: a second state-machine, radar-model or recorder ends and names the pid of the first. A
// second flight-model runs beside the first.
void second_set(FaultSet& set, const std::string&) {
  const auto& session = set.processes().session();
  for (const auto* role : {"state-machine", "radar-model"})
    expect_refusal(set, set.other({role, "--session", session}), 2, std::to_string(set.processes().pid(role)), role);
  expect_refusal(set,
                 set.other({"yars", "--session", session, "record", (set.processes().folder() / "second").string()}), 2,
                 std::to_string(set.processes().pid("recorder")), "a second recorder");
  set.processes().start("second-flight", {"flight-model", "--source", "fixed:37.41,-122.6,15000,20,60"});
  set.rest_ms(50.0, 300.0);
  set.processes().kill("second-flight", SIGTERM);
  if (const int code = set.processes().wait("second-flight"); code != 0)
    set.tell("a second flight-model ended with " + std::to_string(code));
}

void run_yars(FaultSet& set, std::vector<std::string> arguments) {
  const auto finished = set.processes().yars(arguments);
  if (finished.code != 0) set.tell("yars sim " + arguments[1] + ": " + finished.errors);
}

// Three random choices among: freeze, step, rate or reset of the session's clock, and repositioning of the aircraft.
void sim_clock(FaultSet& set, const std::string&) {
  const std::vector<std::vector<std::string>> jumps{
      {"sim", "freeze"},         {"sim", "step", "400"},
      {"sim", "rate", "10"},     {"sim", "rate", "0"},
      {"sim", "rate", "0.3"},    {"sim", "reset"},
      {"sim", "reset", "90000"}, {"sim", "reposition", "37.45", "-122.5", "9000", "300"}};
  for (std::size_t i = 0; i < 3; ++i) {
    run_yars(set, jumps[set.below(jumps.size())]);
    set.rest_ms(5.0, 150.0);
  }
  run_yars(set, {"sim", "rate", "1"});
  run_yars(set, {"sim", "run"});
}

// Clients in a time namespace: their CLOCK_MONOTONIC is 100,000 s ahead or 100 s behind.
void foreign_clock(FaultSet& set, const std::string&) {
  const std::string offset = set.below(2) == 0 ? "100000" : "-100";
  for (const auto* mode : {"push", "fly"}) {
    set.processes().start_tool("foreign",
                               {"unshare", "--time", "--fork", "--kill-child", "--monotonic", offset,
                                std::string(YARS_BIN_DIR) + "/fault_client", mode, set.processes().session(), "100"});
    set.rest_ms(100.0, 300.0);
    set.processes().kill("foreign", SIGKILL);
    set.processes().wait("foreign");
  }
}

}  // namespace

std::vector<Fault> session_faults() {
  return {{"a full /dev/shm", full_memory},
          {"a segment of another layout version", wrong_layout},
          {"another user's segment", another_user},
          {"a second set with the same session name", second_set},
          {"jumps of the session's clock", sim_clock},
          {"programs whose CLOCK_MONOTONIC is another one", foreign_clock}};
}

}  // namespace yars::endtoend::fault_injection
