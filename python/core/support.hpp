// Helpers of all parts of yars._core: errors, warnings, arrays without copies.
// Errors: a wrong value of the caller is ValueError, every other failure is yars.Error.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "lib/error/error.hpp"
#include "lib/parallel/thread_pool.hpp"
#include "radar/theatre.hpp"

namespace yars::python {

namespace py = pybind11;

// Translates the errors of the library to Python's exceptions.
void register_exceptions(py::module_& module);

// Adds xxh3() and xxh3_items(): hashes of the bytes of arrays.
void add_hashes(py::module_& module);

// Throws ValueError for a wrong value of the caller, else yars.Error, with the fields of the error as attributes. The
// error of a call that the caller stopped throws parallel::Stopped.
[[noreturn]] void raise(const Error& error);

// Returns the value of a call of the library, or raises its error.
template <class Value>
Value value_of(Expected<Value>&& given) {
  if (!given) raise(given.error());
  return std::move(*given);
}
inline void check_done(const Expected<void>& done) {
  if (!done) raise(done.error());
}

// Collects warnings while the interpreter's lock is released, and hands them to Python's module warnings afterwards.
class Warnings {
 public:
  radar::Warn sink() {
    return [this](const std::string& warning) { lines_.push_back(warning); };
  }
  // Argument for a call of the library: collects its warnings, and stops it by `goes_on`.
  Call call(const parallel::GoesOn& goes_on) { return {.warn = sink(), .goes_on = goes_on}; }
  // Shows each line once, and at most five lines of a call. Call with the interpreter's lock. `function`: prefix of
  // each line, such as "yars.Radar.scan". `frames`: number of Python frames of this package between this call and the
  // caller, whose line the warning names.
  void show(const std::string& function, int frames = 1);

 private:
  std::vector<std::string> lines_;
};

// Makes the array read-only and returns it.
inline py::array read_only(py::array array) {
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

// Removes Python's constructor from a class. Only functions of the module make instances, so each instance has its C++
// object.
template <class Class>
void seal(Class& type) {
  reinterpret_cast<PyTypeObject*>(type.ptr())->tp_new = [](PyTypeObject* made, PyObject*, PyObject*) -> PyObject* {
    PyErr_Format(PyExc_TypeError, "%s: expected one that a function of yars makes, found a call of its class",
                 made->tp_name);
    return nullptr;
  };
}

// Array on memory of a C++ object that the array keeps alive; it cannot be written. `shape`: entries along each axis.
template <class T>
py::array array_of(const std::shared_ptr<const void>& owner, const T* data, std::vector<py::ssize_t> shape) {
  auto* const kept = new std::shared_ptr<const void>(owner);
  const py::capsule keeper(kept, [](void* pointer) { delete static_cast<std::shared_ptr<const void>*>(pointer); });
  return read_only(py::array_t<T>(std::move(shape), data, keeper));
}
// Array of bool from bytes 0 and 1.
py::array flags_of(const std::shared_ptr<const void>& owner, const std::uint8_t* data, std::vector<py::ssize_t> shape);

// Array that takes over a vector.
template <class T, class Allocator>
py::array array_from(std::vector<T, Allocator> values, std::vector<py::ssize_t> shape) {
  auto owner = std::make_shared<std::vector<T, Allocator>>(std::move(values));
  return array_of<T>(owner, owner->data(), std::move(shape));
}

}  // namespace yars::python
