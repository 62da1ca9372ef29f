#include "inputmonitor/terminal_mode.hpp"

#include <signal.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>

namespace yars::inputmonitor {

namespace {

// What would end the process without unwinding; SIGINT and SIGTERM end it in order.
constexpr std::array kFelling{SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGQUIT, SIGHUP};

// A signal handler has no other way to reach it.
struct Saved {
  std::atomic<int> descriptor{-1};
  termios settings{};
  std::array<struct sigaction, kFelling.size()> actions{};
};
Saved saved;

void restore() {
  const int descriptor = saved.descriptor.exchange(-1);
  if (descriptor >= 0) tcsetattr(descriptor, TCSANOW, &saved.settings);
}

// The handler is gone when it is entered (SA_RESETHAND): the signal sent again does what it always did.
void restore_and_fall(int signal_number) {
  restore();
  raise(signal_number);
}

void catch_felling_signals() {
  struct sigaction action {};
  action.sa_handler = restore_and_fall;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigemptyset(&action.sa_mask);
  for (std::size_t index = 0; index < kFelling.size(); ++index)
    sigaction(kFelling[index], &action, &saved.actions[index]);
}

void release_felling_signals() {
  for (std::size_t index = 0; index < kFelling.size(); ++index)
    sigaction(kFelling[index], &saved.actions[index], nullptr);
}

termios byte_by_byte(termios settings) {
  settings.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
  settings.c_iflag &= ~static_cast<tcflag_t>(IXON);  // Ctrl-S must not seem to freeze the keyboard
  settings.c_cc[VSUSP] = _POSIX_VDISABLE;
  settings.c_cc[VMIN] = 1;
  settings.c_cc[VTIME] = 0;
  return settings;
}

}  // namespace

bool is_foreground_terminal(int descriptor) {
  return isatty(descriptor) == 1 && tcgetpgrp(descriptor) == getpgrp();
}

failure::Expected<std::unique_ptr<TerminalMode>> TerminalMode::enter(int descriptor) {
  if (!is_foreground_terminal(descriptor))
    return failure::fail("standard input", "a terminal in whose foreground this program runs",
                         isatty(descriptor) == 1 ? "one of which another program has the foreground" : "no terminal",
                         "start it in a terminal of its own, or use --source window or script:FILE");
  if (tcgetattr(descriptor, &saved.settings) != 0)
    return failure::fail("standard input", "a terminal whose settings can be read", std::strerror(errno));
  const termios raw = byte_by_byte(saved.settings);
  saved.descriptor = descriptor;
  catch_felling_signals();
  std::unique_ptr<TerminalMode> mode(new TerminalMode);
  if (tcsetattr(descriptor, TCSANOW, &raw) != 0)
    return failure::fail("standard input", "a terminal that can be set", std::strerror(errno));
  return mode;
}

TerminalMode::~TerminalMode() {
  // A process that was put into the background meanwhile would be stopped here.
  sigset_t blocked;
  sigset_t before;
  sigemptyset(&blocked);
  sigaddset(&blocked, SIGTTOU);
  pthread_sigmask(SIG_BLOCK, &blocked, &before);
  restore();
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  release_felling_signals();
}

}  // namespace yars::inputmonitor
