#include "python/core/support.hpp"

#include <algorithm>
#include <cmath>

#include "tools/command/command.hpp"

namespace yars::python {

namespace {
// The class yars.Error, which the package defines so that it exists without this part.
py::object error_class() {
  return py::module_::import("yars").attr("Error");
}
}  // namespace

void register_exceptions(py::module_& /*module*/) {
  py::register_exception_translator(
      [](std::exception_ptr pointer) {  // NOLINT(performance-unnecessary-value-param): pybind11's form
        try {
          if (pointer) std::rethrow_exception(pointer);
        } catch (const tools::CommandFailed& failed) {
          const py::object type = failed.code == databuffer::kExitUsage
                                      ? py::reinterpret_borrow<py::object>(PyExc_ValueError)
                                      : error_class();
          PyErr_SetString(type.ptr(), failed.message.c_str());
        }
      });
}

void raise(const error::Error& error) {
  tools::throw_failure(error);
}
void raise_value_error(const std::string& message) {
  throw tools::CommandFailed{message, databuffer::kExitUsage};
}

namespace {
// Value of an option as text. Python's own number texts are the shortest that give the same number again.
std::string text_of(const py::handle& value) {
  if (PyUnicode_Check(value.ptr())) return py::cast<std::string>(value);
  if (py::hasattr(value, "__fspath__")) return py::cast<std::string>(value.attr("__fspath__")());
  if (PyIndex_Check(value.ptr())) return py::str(py::int_(py::reinterpret_borrow<py::object>(value)));
  if (py::hasattr(value, "__float__")) return py::repr(py::float_(py::reinterpret_borrow<py::object>(value)));
  return py::repr(value);
}

// Whether a value is this truth value, of Python or NumPy.
bool is_truth(const py::handle& value, bool truth) {
  if (py::isinstance<py::bool_>(value)) return value.ptr() == (truth ? Py_True : Py_False);
  return py::isinstance(value, py::module_::import("numpy").attr("bool_")) &&
         py::cast<bool>(value.attr("item")()) == truth;
}
}  // namespace

std::vector<std::string> words_of(const py::kwargs& arguments) {
  std::vector<std::string> words;
  for (const auto& [key, value] : arguments) {
    std::string option = "--" + py::cast<std::string>(key);
    for (char& letter : option)
      if (letter == '_') letter = '-';
    if (value.is_none() || is_truth(value, false)) continue;
    if (is_truth(value, true)) {
      words.push_back(option);
      continue;
    }
    if (py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value)) {
      for (const py::handle& entry : value) words.push_back(option + "=" + text_of(entry));
      continue;
    }
    words.push_back(option + "=" + text_of(value));
  }
  return words;
}

void read_options(const std::string& name, const py::kwargs& arguments,
                  const std::function<void(databuffer::Command)>& add_options) {
  databuffer::CommandLine line("", name);
  add_options(line);
  if (const auto fault = line.read(words_of(arguments))) raise_value_error(*fault);
}

void Warnings::show(const std::string& command) {
  constexpr std::size_t kMostLines = 5;  // of one call
  std::vector<std::string> lines;
  for (const std::string& line : std::exchange(lines_, {}))
    if (std::find(lines.begin(), lines.end(), line) == lines.end()) lines.push_back(line);
  if (lines.size() > kMostLines) {
    const std::size_t more = lines.size() - kMostLines;
    lines.resize(kMostLines);
    lines.push_back("and " + std::to_string(more) + " more warnings");
  }
  for (const std::string& line : lines)
    if (PyErr_WarnFormat(PyExc_UserWarning, 2, "%s: %s", command.c_str(), line.c_str()) != 0)
      throw py::error_already_set();
}

py::array flags_of(const std::shared_ptr<const void>& owner, const std::uint8_t* data, std::vector<py::ssize_t> shape) {
  return array_of<std::uint8_t>(owner, data, std::move(shape)).attr("view")(py::dtype::of<bool>());
}

}  // namespace yars::python
