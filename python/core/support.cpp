#include "python/core/support.hpp"

#define XXH_INLINE_ALL
#include <pybind11/stl.h>
#include <xxhash.h>

#include <array>
#include <string_view>
#include <unordered_set>
#include <utility>

#include "radar/limits.hpp"

namespace yars::python {

namespace {
// The class yars.Error, which the package defines so that it exists without this part.
py::object error_class() {
  return py::module_::import("yars").attr("Error");
}
}  // namespace

namespace {

// Names of files may have any bytes.
py::object text_of(const std::string& text) {
  return py::reinterpret_steal<py::object>(
      PyUnicode_DecodeUTF8(text.data(), static_cast<py::ssize_t>(text.size()), "backslashreplace"));
}

// The message with Python's keywords: heading_deg=45, force=True.
std::string message_in_python(const Error& error) {
  return radar::spelled(error,
                        [](const values::Field& field, std::string_view value) {
                          return std::string(field.name) + (value.empty()     ? ""
                                                            : value == "true" ? "=True"
                                                                              : '=' + std::string(value));
                        })
      .message();
}

void set_error(const Error& error) {
  static constexpr std::array kCodes{"failed", "argument", "range", "limit", "cancelled"};
  const py::object type =
      error.code == ErrorCode::failed ? error_class() : py::reinterpret_borrow<py::object>(PyExc_ValueError);
  const py::object problem = type(text_of(message_in_python(error)));
  problem.attr("code") = kCodes[static_cast<std::size_t>(error.code)];
  problem.attr("field") = text_of(error.subject);
  problem.attr("expected") = text_of(error.expected);
  problem.attr("found") = text_of(error.found);
  problem.attr("action") = text_of(error.action);
  problem.attr("low") = error.low;
  problem.attr("high") = error.high;
  PyErr_SetObject(type.ptr(), problem.ptr());
}

}  // namespace

void register_exceptions(py::module_& /*module*/) {
  py::register_exception_translator(
      [](std::exception_ptr pointer) {  // NOLINT(performance-unnecessary-value-param): pybind11's form
        try {
          if (pointer) std::rethrow_exception(pointer);
        } catch (const radar::Failure& failure) {
          set_error(failure.error);
        }
      });
}

void raise(const Error& error) {
  if (error.code == ErrorCode::cancelled) throw parallel::Stopped{};
  radar::fail(error);
}

void Warnings::show(const std::string& function, int frames) {
  constexpr std::size_t kMostLines = 5;  // of one call
  std::vector<std::string> lines;
  std::unordered_set<std::string> known;
  for (std::string& line : std::exchange(lines_, {}))
    if (known.insert(line).second) lines.push_back(std::move(line));
  if (lines.size() > kMostLines) {
    const std::size_t more = lines.size() - kMostLines;
    lines.resize(kMostLines);
    lines.push_back("and " + std::to_string(more) + " more warnings");
  }
  for (const std::string& line : lines)
    if (PyErr_WarnFormat(PyExc_UserWarning, 1 + frames, "%s: %s", function.c_str(), line.c_str()) != 0)
      throw py::error_already_set();
}

void add_hashes(py::module_& module) {
  module.def(
      "xxh3",
      [](const py::args& parts) {
        XXH3_state_t state;
        XXH3_64bits_reset(&state);
        for (const py::handle part : parts) {
          const py::buffer_info info = py::cast<py::buffer>(part).request();
          XXH3_64bits_update(&state, info.ptr, static_cast<std::size_t>(info.size * info.itemsize));
        }
        return XXH3_64bits_digest(&state);
      },
      "XXH3 hash, 64 bits, of the bytes of contiguous buffers, one after the other.");
  module.def(
      "xxh3_items",
      [](const py::buffer& array) {
        const py::buffer_info info = array.request();
        std::vector<std::uint64_t> hashes(info.ndim > 0 ? static_cast<std::size_t>(info.shape[0]) : 0);
        const std::size_t bytes =
            hashes.empty() ? 0 : static_cast<std::size_t>(info.size * info.itemsize) / hashes.size();
        for (std::size_t i = 0; i < hashes.size(); ++i)
          hashes[i] = XXH3_64bits(static_cast<const std::uint8_t*>(info.ptr) + i * bytes, bytes);
        return hashes;
      },
      py::arg("array"), "XXH3 hashes, 64 bits each, of the entries along the first axis of a contiguous array.");
}

py::array flags_of(const std::shared_ptr<const void>& owner, const std::uint8_t* data, std::vector<py::ssize_t> shape) {
  return array_of<std::uint8_t>(owner, data, std::move(shape)).attr("view")(py::dtype::of<bool>());
}

}  // namespace yars::python
