// Calls without the interpreter's lock: signals while they run, their end when Python ends, and locks of objects that
// outlive fork().
// Inputs: work that asks between its steps whether it goes on. Outputs: none; the work writes its own.
// Threads: a signal is noticed by Python's main thread alone, so calls of other threads run to their end.
// Errors: the exception of a signal's handler, such as KeyboardInterrupt.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>

#include "lib/parallel/thread_pool.hpp"
#include "lib/text/plain_text.hpp"
#include "python/core/support.hpp"

namespace yars::python {

// Handlers of signals, called between the steps of a call. Make it with the interpreter's lock.
class Signals {
 public:
  Signals();
  // Work asks this without the interpreter's lock, on the thread that has made this object, and while it holds no
  // ObjectLock: a handler may be any Python code. False from the first handler on that has raised an exception.
  parallel::GoesOn goes_on() {
    return [this] { return ask(); };
  }
  // Throws the exception of a handler. Call it with the interpreter's lock.
  void raise_if_any();

 private:
  bool ask();

  bool in_main_thread_;
  std::chrono::steady_clock::time_point next_;
  std::optional<py::error_already_set> raised_;
};

// The interpreter's lock is free while it exists, and numbers in text have a decimal point. When Python ends, a thread
// may not take the lock any more: other threads than the one that ends then stop here for good, and the process ends
// without them. Signals tell their work to stop.
class ReleasedInterpreter {
 public:
  ReleasedInterpreter();
  ~ReleasedInterpreter();
  ReleasedInterpreter(const ReleasedInterpreter&) = delete;
  ReleasedInterpreter& operator=(const ReleasedInterpreter&) = delete;

 private:
  PyThreadState* state_;
  text::DecimalPoint numbers_;
};

// Calls work(goes_on) without the interpreter's lock. The work may throw parallel::Stopped if it does not go on.
template <class Work>
void without_interpreter(const Work& work) {
  Signals signals;
  try {
    const ReleasedInterpreter released;
    work(signals.goes_on());
  } catch (const parallel::Stopped&) {
  }
  signals.raise_if_any();
}

// Lock of an object that several threads may use. os.fork() waits up to some seconds for the calls that hold such
// locks, because a child has only the thread that forks. In the child all of them are free. An object whose call took
// longer may be half changed in the child: there `renew` makes it usable again, without freeing what it had. Make and
// destroy an ObjectLock with the interpreter's lock; call take() without.
class ObjectLock {
 public:
  explicit ObjectLock(std::function<void()> renew);
  ~ObjectLock();
  ObjectLock(const ObjectLock&) = delete;
  ObjectLock& operator=(const ObjectLock&) = delete;
  // Waits for other threads. Throws parallel::Stopped.
  std::unique_lock<std::timed_mutex> take(const parallel::GoesOn& goes_on = {});

 private:
  friend void add_calls(py::module_& module);
  static void before_fork();
  static void after_fork_in_parent();
  static void after_fork_in_child();

  std::shared_ptr<std::timed_mutex> mutex_ = std::make_shared<std::timed_mutex>();
  std::function<void()> renew_;
};

// Registers what os.fork() and the end of the interpreter call.
void add_calls(py::module_& module);

}  // namespace yars::python
