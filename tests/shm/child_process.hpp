// Child processes for tests: a fork that runs one function, memory shared with the parent, and waits with a time limit.
#pragma once

#include <signal.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <new>
#include <system_error>
#include <type_traits>
#include <utility>

namespace yars::shm::testing {

inline constexpr std::chrono::seconds kWatchdog{30};  // time limit of every wait

// Polls until `done` returns true. False: the time limit has passed.
template <class Predicate>
bool wait_until(Predicate done) {
  const auto deadline = std::chrono::steady_clock::now() + kWatchdog;
  while (!done()) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    const timespec pause{0, 200'000};
    nanosleep(&pause, nullptr);
  }
  return true;
}

class ChildProcess {
 public:
  // Forks. The child runs `body` and exits with its result, or with 0 if it returns nothing. The child does not run
  // destructors of the parent's objects.
  template <class Body>
  explicit ChildProcess(Body body) : pid_(fork()) {
    // With pid_ = -1, kill() would end all processes of the user.
    if (pid_ < 0) throw std::system_error(errno, std::generic_category(), "fork");
    if (pid_ != 0) return;
    if constexpr (std::is_void_v<decltype(body())>) {
      body();
      _exit(0);
    } else {
      _exit(body());
    }
  }
  ChildProcess(ChildProcess&& other) noexcept : pid_(std::exchange(other.pid_, -1)) {}
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  ~ChildProcess() {
    if (pid_ > 0) kill_now();
  }

  pid_t pid() const { return pid_; }
  void send(int signal_number) const { kill(pid_, signal_number); }
  void kill_now() {
    send(SIGKILL);
    wait();
  }
  // Waits for the child's end and returns its exit code, or minus the signal that ended it. A child that exceeds the
  // time limit is killed.
  int wait() {
    int status = 0;
    const bool ended = wait_until([&] { return waitpid(pid_, &status, WNOHANG) == pid_; });
    if (!ended) {
      send(SIGKILL);
      waitpid(pid_, &status, 0);
    }
    pid_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }

 private:
  pid_t pid_;
};

// A zero-filled T in memory that parent and children share.
template <class T>
class SharedMemory {
 public:
  SharedMemory() : memory_(mmap(nullptr, sizeof(T), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0)) {
    if (memory_ == MAP_FAILED) throw std::bad_alloc();
  }
  SharedMemory(const SharedMemory&) = delete;
  SharedMemory& operator=(const SharedMemory&) = delete;
  ~SharedMemory() { munmap(memory_, sizeof(T)); }
  T& operator*() { return *static_cast<T*>(memory_); }
  T* operator->() { return static_cast<T*>(memory_); }

 private:
  void* memory_;
};

}  // namespace yars::shm::testing
