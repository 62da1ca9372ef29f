#include "python/core/calls.hpp"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <set>
#include <thread>
#include <utility>
#include <vector>

namespace yars::python {

namespace {
using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds kBetweenSignals{100};  // a wait for the interpreter may take some ms
constexpr std::chrono::seconds kLongestWaitOfFork{2};
}  // namespace

Signals::Signals()
    : in_main_thread_(py::cast<unsigned long>(py::module_::import("threading").attr("main_thread")().attr("ident")) ==
                      PyThread_get_thread_ident()),
      next_(Clock::now() + kBetweenSignals) {}

namespace {
// Calls that run without the interpreter's lock, and those among them that come back to it.
std::atomic<int> running_calls{0};
std::atomic<int> returning_calls{0};
thread_local int own_calls = 0;
std::atomic<bool> python_ends{false};
thread_local bool ends_python = false;  // this thread runs what atexit has registered

// Stops the calls of other threads, and waits up to kLongestWait for them, before the interpreter is taken down.
void end_calls() {
  constexpr std::chrono::seconds kLongestWait{2};
  constexpr std::chrono::milliseconds kPause{1};
  ends_python = true;
  python_ends = true;
  const py::gil_scoped_release released;
  const Clock::time_point end = Clock::now() + kLongestWait;
  while (returning_calls > 0 || (running_calls > own_calls && Clock::now() < end)) std::this_thread::sleep_for(kPause);
}
}  // namespace

ReleasedInterpreter::ReleasedInterpreter() : state_(PyEval_SaveThread()) {
  ++running_calls;
  ++own_calls;
}

ReleasedInterpreter::~ReleasedInterpreter() {
  ++returning_calls;
  if (python_ends && !ends_python) {
    --running_calls;
    --returning_calls;
    while (true) ::pause();
  }
  PyEval_RestoreThread(state_);
  --own_calls;
  --running_calls;
  --returning_calls;
}

bool Signals::ask() {
  if (raised_ || (python_ends && !ends_python)) return false;
  if (!in_main_thread_ || Clock::now() < next_) return true;
  {
    const py::gil_scoped_acquire acquired;
    if (PyErr_CheckSignals() != 0) raised_.emplace();  // takes over the exception
  }
  next_ = Clock::now() + kBetweenSignals;
  return !raised_;
}

void Signals::raise_if_any() {
  if (!raised_) return;
  py::error_already_set raised = std::move(*raised_);
  raised_.reset();
  throw raised;
}

namespace {
// Guarded by the interpreter's lock. Never destroyed, because objects may outlive static ones.
std::set<ObjectLock*>& known_locks() {
  static auto* const locks = new std::set<ObjectLock*>;
  return *locks;
}
// The locks that this thread holds during its fork().
struct HeldLock {
  ObjectLock* lock;
  std::shared_ptr<std::timed_mutex> mutex;
};
thread_local std::vector<HeldLock> held_locks;
}  // namespace

ObjectLock::ObjectLock(std::function<void()> renew) : renew_(std::move(renew)) {
  known_locks().insert(this);
}
ObjectLock::~ObjectLock() {
  known_locks().erase(this);
}

std::unique_lock<std::timed_mutex> ObjectLock::take(const parallel::GoesOn& goes_on) {
  std::unique_lock lock(*mutex_, std::defer_lock);
  while (!lock.try_lock_for(kBetweenSignals)) parallel::check(goes_on);
  return lock;
}

// The interpreter's lock is free during the waits, because a call that holds an ObjectLock may need it to end. Objects
// may come and go meanwhile.
void ObjectLock::before_fork() {
  const Clock::time_point end = Clock::now() + kLongestWaitOfFork;
  std::set<ObjectLock*> tried;
  const auto untried = [&tried](ObjectLock* one) { return !tried.contains(one); };
  for (auto found = std::ranges::find_if(known_locks(), untried); found != known_locks().end();
       found = std::ranges::find_if(known_locks(), untried)) {
    ObjectLock* const one = *found;
    tried.insert(one);
    const std::shared_ptr<std::timed_mutex> mutex = one->mutex_;
    bool taken = mutex->try_lock();
    if (!taken) {
      const py::gil_scoped_release released;
      taken = mutex->try_lock_until(end);
    }
    if (taken) held_locks.push_back({one, mutex});
  }
}

void ObjectLock::after_fork_in_parent() {
  for (const HeldLock& held : held_locks) held.mutex->unlock();
  held_locks.clear();
}

void ObjectLock::after_fork_in_child() {
  for (ObjectLock* const one : known_locks()) {
    const auto is_held = [one](const HeldLock& held) { return held.mutex == one->mutex_; };
    if (std::ranges::any_of(held_locks, is_held)) continue;
    // A thread that does not exist here may have it.
    static auto* const left = new std::vector<std::shared_ptr<std::timed_mutex>>;
    left->push_back(std::exchange(one->mutex_, std::make_shared<std::timed_mutex>()));
    one->renew_();
  }
  running_calls = own_calls;
  returning_calls = 0;
  after_fork_in_parent();
}

void add_calls(py::module_& /*module*/) {
  py::module_::import("atexit").attr("register")(py::cpp_function(&end_calls));
  py::module_::import("os").attr("register_at_fork")(
      py::arg("before") = py::cpp_function(&ObjectLock::before_fork),
      py::arg("after_in_parent") = py::cpp_function(&ObjectLock::after_fork_in_parent),
      py::arg("after_in_child") = py::cpp_function(&ObjectLock::after_fork_in_child));
}

}  // namespace yars::python
