#include "station/app/sets_shell.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <boost/asio/buffers_iterator.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/streambuf.hpp>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <memory>
#include <string_view>
#include <utility>

#include "lib/file/folder.hpp"
#include "lib/log/log.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::station {

namespace {

using error::Expected;
using nlohmann::ordered_json;

// Starts a program with its output in `output`. It ends when the station ends. -1: the system refused.
int spawn(const std::vector<std::string>& command, int output) {
  std::vector<char*> arguments;
  arguments.reserve(command.size() + 1);
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const int parent = ::getpid();
  const int pid = ::fork();
  if (pid != 0) return pid;
  // Only functions that are safe in the child of a program with threads.
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (::getppid() != parent) ::_exit(1);
  const int none = ::open("/dev/null", O_RDONLY);
  ::dup2(none, STDIN_FILENO);
  ::dup2(output, STDOUT_FILENO);
  ::dup2(output, STDERR_FILENO);
  for (int file = STDERR_FILENO + 1; file < 1024; ++file) ::close(file);
  ::execv(arguments[0], arguments.data());
  // The reason is the last line of the output, which the page shows.
  const auto say = [](std::string_view text) {
    if (::write(STDERR_FILENO, text.data(), text.size()) < 0) ::_exit(127);
  };
  say("expected a program that can be started, found ");
  say(arguments[0]);
  ::_exit(127);
}

std::string text_of_seconds(double seconds) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3f", seconds);
  return text;
}

// The last line that a process has written, for the page.
std::string last_line(const file::Descriptor& log) {
  constexpr off_t kMostBytes = 1000;
  struct stat status{};
  if (::fstat(log.number(), &status) != 0) return {};
  const off_t begin = std::max<off_t>(0, status.st_size - kMostBytes);
  std::string text(static_cast<std::size_t>(status.st_size - begin), '\0');
  if (::pread(log.number(), text.data(), text.size(), begin) < 0) return {};
  std::string_view rest = text;
  while (rest.ends_with('\n')) rest.remove_suffix(1);
  return std::string(rest.substr(rest.rfind('\n') + 1).substr(0, 300));
}

// "20261128-101500", in UTC.
std::string text_of_now() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  ::gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y%m%d-%H%M%S", &parts);
  return text;
}

}  // namespace

struct SetsShell::Listing {
  static constexpr std::size_t kMaxBytes = std::size_t{16} << 20;  // kMaxListed recordings with paths of any length
  Listing(boost::asio::io_context& context, int file) : output(context, file) {}

  boost::asio::posix::stream_descriptor output;
  boost::asio::streambuf text{kMaxBytes};
  int pid = 0;
  std::vector<std::function<void(ordered_json)>> waiting;
};

SetsShell::SetsShell(boost::asio::io_context& context, SetSettings settings)
    : context_(context), settings_(std::move(settings)) {}

SetsShell::~SetsShell() {
  if (listing_ && listing_->pid > 0) ending_.push_back(listing_->pid);
  for (const int pid : ending_) {
    ::kill(pid, SIGKILL);
    ::waitpid(pid, nullptr, 0);
  }
  for (const StartedSet& set : sets_) signal(set, SIGTERM);
  for (const StartedSet& set : sets_)
    for (const Process& process : set.processes) ::waitpid(process.pid, nullptr, 0);
}

Expected<SetsShell::Process> SetsShell::start(const std::vector<std::string>& command) {
  file::Descriptor output(::memfd_create("output", MFD_CLOEXEC));
  if (!output) return error::fail(command.front(), "to start it", std::strerror(errno));
  const int pid = spawn(command, output.number());
  if (pid < 0) return error::fail(command.front(), "to start it", std::strerror(errno));
  log::info("started for the instructor: " + command.front() + ", pid " + std::to_string(pid));
  return Process{pid, std::move(output)};
}

Expected<void> SetsShell::check_file(const std::string& file) const {
  if (sets_.size() >= kMaxSets)
    return error::fail("sets", "at most " + std::to_string(kMaxSets) + " beside this one", "as many", "end one");
  if (!listed_.contains(file)) return error::fail("file", "a recording of the list", file, "list the recordings again");
  return {};
}

std::string SetsShell::new_session(const std::string& kind) {
  return settings_.session.substr(0, 24) + '-' + kind + '-' + std::to_string(next_++);
}

std::filesystem::path SetsShell::start_script() const {
  if (!settings_.start_script.empty()) return settings_.start_script;
  const std::filesystem::path installed = settings_.programs / "yars-start";
  return std::filesystem::exists(installed) ? installed : settings_.programs / "../../../scripts/start";
}

Expected<std::string> SetsShell::play(const std::string& file, double at_s) {
  if (auto good = check_file(file); !good) return tl::unexpected(good.error());
  StartedSet set{new_session("replay"), "replay", file, at_s, {}, {}};
  std::vector<std::string> replay{(settings_.programs / "yars").string(),
                                  "--session",
                                  set.session,
                                  "replay",
                                  file,
                                  "--seek",
                                  text_of_seconds(at_s)};
  auto player = start(replay);
  if (!player) return tl::unexpected(player.error());
  set.processes.push_back(std::move(*player));
  std::vector<std::string> display{(settings_.programs / "radar-display").string(), "--session", set.session,
                                   "--headless", "--publish"};
  if (!settings_.config.empty()) display.insert(display.end(), {"--config", settings_.config});
  if (auto shown = start(display)) set.processes.push_back(std::move(*shown));
  sets_.push_back(std::move(set));
  changed_ = true;
  return sets_.back().session;
}

Expected<std::string> SetsShell::fly_out(const std::string& file, double at_s) {
  if (auto good = check_file(file); !good) return tl::unexpected(good.error());
  constexpr const char* kLonger = "86400";  // [s] than anybody flies
  StartedSet set{new_session("branch"), "branch", file, at_s, {}, {}};
  const std::filesystem::path branch = settings_.recordings / (set.session + '-' + text_of_now() + ".yars");
  // clang-format off: an option and its value on a line
  auto process = start({start_script().string(), "--bin", settings_.programs.string(), "--session", set.session,
                        "--fly-out", file, "--at", text_of_seconds(at_s), "--record", branch.string(), "--pictures",
                        "--headless", kLonger, "--no-frames", "--publish", "--no-input", "--log-dir", ""});
  // clang-format on
  if (!process) return tl::unexpected(process.error());
  set.processes.push_back(std::move(*process));
  sets_.push_back(std::move(set));
  changed_ = true;
  return sets_.back().session;
}

Expected<void> SetsShell::record(bool one_runs) {
  const auto is_recorder = [](const StartedSet& set) { return set.kind == "recorder"; };
  if (one_runs ||
      std::ranges::any_of(sets_, [&](const StartedSet& set) { return is_recorder(set) && set.ended.empty(); }))
    return error::fail("recorder", "none that runs", "one", "PB 12 stops and starts it");
  if (auto folder = file::Folder::make(settings_.recordings); !folder) return tl::unexpected(folder.error());
  const std::filesystem::path file = settings_.recordings / (settings_.session + '-' + text_of_now() + ".yars");
  std::vector<std::string> command{(settings_.programs / "yars").string(), "--session", settings_.session};
  if (!settings_.config.empty()) command.insert(command.end(), {"--config", settings_.config});
  command.insert(command.end(), {"record", file.string(), "--sweeps", "--patches"});
  if (!settings_.terrain.empty()) command.insert(command.end(), {"--terrain", settings_.terrain});
  auto process = start(command);
  if (!process) return tl::unexpected(process.error());
  StartedSet set{settings_.session, "recorder", file.string(), 0.0, {}, {}};
  set.processes.push_back(std::move(*process));
  std::erase_if(sets_, [&](const StartedSet& before) { return is_recorder(before) && before.processes.empty(); });
  sets_.push_back(std::move(set));
  changed_ = true;
  return {};
}

void SetsShell::signal(const StartedSet& set, int number) const {
  for (const Process& process : set.processes) ::kill(process.pid, number);
}

Expected<void> SetsShell::end(const std::string& session) {
  // The recorder bears the station's own session.
  const auto set = std::ranges::find(sets_, session, &StartedSet::session);
  if (set == sets_.end()) return error::fail("end", "a set that the station has started", session.substr(0, 40));
  signal(*set, SIGTERM);
  if (set->processes.empty())
    sets_.erase(set);
  else
    set->ended = "ended by the instructor";
  changed_ = true;
  return {};
}

bool SetsShell::look() {
  std::erase_if(ending_, [](int pid) { return ::waitpid(pid, nullptr, WNOHANG) != 0; });
  for (StartedSet& set : sets_) {
    std::erase_if(set.processes, [&](const Process& process) {
      int status = 0;
      if (::waitpid(process.pid, &status, WNOHANG) == 0) return false;
      if (set.ended.empty()) set.failed = WIFEXITED(status) && WEXITSTATUS(status) != 0;
      if (set.ended.empty())
        set.ended = "ended" + (last_line(process.log).empty() ? "" : ": " + last_line(process.log));
      changed_ = true;
      return true;
    });
    // A display without its replay, or the reverse, is of no use.
    if (!set.ended.empty()) signal(set, SIGTERM);
  }
  std::erase_if(sets_, [](const StartedSet& set) {
    return set.processes.empty() && ((set.kind == "recorder" && !set.failed) || set.ended == "ended by the instructor");
  });
  return std::exchange(changed_, false);
}

ordered_json SetsShell::sets() const {
  ordered_json list = ordered_json::array();
  for (const StartedSet& set : sets_)
    list.push_back({{"session", set.session},
                    {"kind", set.kind},
                    {"file", set.file},
                    {"at", set.at_s},
                    {"ended", set.ended.empty() ? ordered_json(nullptr) : ordered_json(set.ended)}});
  return list;
}

bool SetsShell::has_session(const std::string& name) const {
  return name == settings_.session ||
         std::ranges::any_of(sets_, [&](const StartedSet& set) { return set.session == name && set.ended.empty(); });
}

void SetsShell::list_recordings(std::function<void(ordered_json)> then) {
  std::error_code ignored;
  if (!std::filesystem::exists(settings_.recordings, ignored))
    return then({{"recordings", ordered_json::array()}, {"left_out", 0}});
  if (listing_) return listing_->waiting.push_back(std::move(then));
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) return then({{"problem", std::strerror(errno)}});
  listing_ = std::make_unique<Listing>(context_, ends[0]);
  listing_->waiting.push_back(std::move(then));
  listing_->pid = spawn({(settings_.programs / "yars").string(), "recordings", settings_.recordings.string(),
                         "--newest", std::to_string(kMaxListed), "--json"},
                        ends[1]);
  ::close(ends[1]);
  if (listing_->pid < 0) return end_listing(false);
  boost::asio::async_read(listing_->output, listing_->text, [this](boost::system::error_code problem, std::size_t) {
    if (problem != boost::asio::error::operation_aborted) end_listing(problem == boost::asio::error::eof);
  });
}

// Never waits for the process, which may write more than was read.
void SetsShell::end_listing(bool whole) {
  const std::unique_ptr<Listing> listing = std::move(listing_);
  listing->output.close();
  if (listing->pid > 0) {
    if (!whole) ::kill(listing->pid, SIGKILL);
    ending_.push_back(listing->pid);
  }
  const auto data = listing->text.data();
  auto list =
      whole ? ordered_json::parse(boost::asio::buffers_begin(data), boost::asio::buffers_end(data), nullptr, false)
            : ordered_json();
  if (!list.is_object() || !list.contains("recordings")) {
    list = {{"problem", "the recordings cannot be listed"}};
  } else {
    listed_.clear();
    for (const auto& entry : list["recordings"]) listed_.insert(entry["file"].get<std::string>());
  }
  for (const auto& then : listing->waiting) then(list);
}

}  // namespace yars::station
