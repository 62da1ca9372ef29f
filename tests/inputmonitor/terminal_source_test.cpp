// The terminal source in a child process whose controlling terminal is a pseudo terminal.
#include <gtest/gtest.h>
#include <poll.h>
#include <pty.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

#include <csignal>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <string>

#include "databuffer/messages/input_event.hpp"
#include "inputmonitor/keyboard_source.hpp"

namespace yars::inputmonitor {
namespace {

constexpr int kTimeout_ms = 20'000;

std::int64_t monotonic_now_ns() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

// Runs in the child: prints "ready", then each event on a line, until the source ends. Prints "refused" on an error.
[[noreturn]] void read_terminal() {
  auto source = open_terminal_source();
  if (!source) {
    std::printf("refused\n");
    std::fflush(stdout);
    _exit(3);
  }
  std::printf("ready\n");
  std::fflush(stdout);
  while (!(*source)->ended()) {
    (*source)->wait({monotonic_now_ns(), 0}, 200);
    for (const auto& event : (*source)->take({monotonic_now_ns(), 0}))
      std::printf("%s\n", databuffer::text_of(event).c_str());
    std::fflush(stdout);
  }
  source->reset();
  _exit(0);
}

// A pseudo terminal with a child process that runs read_terminal().
class Terminal {
 public:
  Terminal() {
    child_ = forkpty(&master_, nullptr, nullptr, nullptr);
    if (child_ == 0) read_terminal();
  }
  ~Terminal() {
    // kill() with the pid -1 would reach all processes of the user.
    if (child_ <= 0) return;
    if (!waited_) kill(child_, SIGKILL);
    if (!waited_) waitpid(child_, nullptr, 0);
    close(master_);
  }
  void type(const std::string& bytes) const {
    ASSERT_EQ(write(master_, bytes.data(), bytes.size()), static_cast<ssize_t>(bytes.size()));
  }
  // Waits until the child has printed the text. False if no output comes for kTimeout_ms.
  bool prints(const std::string& expected) {
    while (output_.find(expected) == std::string::npos) {
      pollfd readable{master_, POLLIN, 0};
      if (poll(&readable, 1, kTimeout_ms) <= 0) return false;
      char bytes[256];
      const ssize_t count = read(master_, bytes, sizeof bytes);
      if (count <= 0) return false;
      output_.append(bytes, static_cast<std::size_t>(count));
    }
    output_.erase(0, output_.find(expected) + expected.size());
    return true;
  }
  // The terminal has its original mode: echo and line editing.
  bool echoes() const {
    termios settings{};
    tcgetattr(master_, &settings);
    return (settings.c_lflag & (ECHO | ICANON)) == (ECHO | ICANON);
  }
  void send(int signal_number) const { kill(child_, signal_number); }
  bool exists() const { return child_ > 0; }
  int wait_for_end() {
    int status = 0;
    waitpid(child_, &status, 0);
    waited_ = true;
    return status;
  }

 private:
  int master_ = -1;
  pid_t child_ = -1;
  bool waited_ = false;
  std::string output_;
};

TEST(TerminalSource, KeysBecomeEventsAndEscapeEndsTheSource) {
  Terminal terminal;
  if (!terminal.exists()) GTEST_SKIP() << "needs pseudo terminals (/dev/pts), which are absent here";
  ASSERT_TRUE(terminal.prints("ready"));
  EXPECT_FALSE(terminal.echoes());
  terminal.type("d");
  EXPECT_TRUE(terminal.prints("pb 13"));
  terminal.type("\x1b[A");
  EXPECT_TRUE(terminal.prints("tdc 0 1"));
  EXPECT_TRUE(terminal.prints("tdc 0 0"));
  terminal.type("\r");
  EXPECT_TRUE(terminal.prints("tdc press"));
  EXPECT_TRUE(terminal.prints("tdc release"));
  terminal.type("\x1b");
  const int status = terminal.wait_for_end();
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
  EXPECT_TRUE(terminal.echoes());
}

TEST(TerminalSource, AFatalSignalRestoresTheTerminal) {
  for (const int signal_number : {SIGABRT, SIGSEGV, SIGQUIT, SIGHUP}) {
    Terminal terminal;
    if (!terminal.exists()) GTEST_SKIP() << "needs pseudo terminals (/dev/pts), which are absent here";
    ASSERT_TRUE(terminal.prints("ready"));
    ASSERT_FALSE(terminal.echoes());
    terminal.send(signal_number);
    const int status = terminal.wait_for_end();
    EXPECT_TRUE(WIFSIGNALED(status) || WEXITSTATUS(status) != 0) << signal_number;
    EXPECT_TRUE(terminal.echoes()) << signal_number;
  }
}

TEST(TerminalSource, StandardInputThatIsNoTerminalIsRefused) {
  const pid_t child = fork();
  if (child == 0) {
    if (std::freopen("/dev/null", "r", stdin) == nullptr) _exit(4);
    _exit(open_terminal_source() ? 0 : 3);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 3);
}

}  // namespace
}  // namespace yars::inputmonitor
