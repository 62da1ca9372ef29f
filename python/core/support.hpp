// What all parts of yars._core share: errors, warnings, arguments in the form of command-line options, arrays without
// copies.
// Errors: a usage error is ValueError, every other failure is yars.Error; both have the message that the commands
// print.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "databuffer/runtime/command_line.hpp"
#include "lib/error/error.hpp"
#include "tools/command/input_checks.hpp"

namespace yars::python {

namespace py = pybind11;

// Translates CommandFailed and the errors of the libraries to Python's exceptions.
void register_exceptions(py::module_& module);

// Throws ValueError for a usage error, else yars.Error.
[[noreturn]] void raise(const error::Error& error);
[[noreturn]] void raise_value_error(const std::string& message);

// Runs a check of arguments. What it throws becomes a ValueError, also where the command ends with code 1.
template <class Check>
void check_arguments(const Check& check) {
  try {
    check();
  } catch (tools::CommandFailed& failed) {
    failed.code = databuffer::kExitUsage;
    throw;
  }
}

// Words of a command line for keyword arguments: lat=37.5 is --lat=37.5, alt_ft is --alt-ft. True is a flag; False and
// None are left out. A list gives its option once for each entry. Numbers keep all their digits.
std::vector<std::string> words_of(const py::kwargs& arguments);

// Reads keyword arguments by a table of options. `name`: of the command, for messages. Throws ValueError.
void read_options(const std::string& name, const py::kwargs& arguments,
                  const std::function<void(databuffer::Command)>& add_options);

// Collects warnings while the interpreter's lock is released, and hands them to Python's module warnings afterwards.
class Warnings {
 public:
  tools::Warn sink() {
    return [this](const std::string& warning) { lines_.push_back(warning); };
  }
  // Each line once, at most five of a call. Call with the interpreter's lock. `command`: prefix of each line, such as
  // "yars scan".
  void show(const std::string& command);

 private:
  std::vector<std::string> lines_;
};

// Array on memory of a C++ object that the array keeps alive. `shape`: entries along each axis.
template <class T>
py::array array_of(const std::shared_ptr<const void>& owner, const T* data, std::vector<py::ssize_t> shape) {
  auto* const kept = new std::shared_ptr<const void>(owner);
  const py::capsule keeper(kept, [](void* pointer) { delete static_cast<std::shared_ptr<const void>*>(pointer); });
  return py::array_t<T>(std::move(shape), data, keeper);
}
// An array of 0 and 1 as truth values.
py::array flags_of(const std::shared_ptr<const void>& owner, const std::uint8_t* data, std::vector<py::ssize_t> shape);

// Array that takes over a vector.
template <class T, class Allocator>
py::array array_from(std::vector<T, Allocator> values, std::vector<py::ssize_t> shape) {
  auto owner = std::make_shared<std::vector<T, Allocator>>(std::move(values));
  return array_of<T>(owner, owner->data(), std::move(shape));
}

}  // namespace yars::python
