#include "python/core/support.hpp"

#define XXH_INLINE_ALL
#include <pybind11/stl.h>
#include <xxhash.h>

#include <string_view>
#include <unordered_set>
#include <utility>

#include "lib/text/plain_text.hpp"
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
          // Names of files may have any bytes.
          const auto text = py::reinterpret_steal<py::object>(PyUnicode_DecodeUTF8(
              failed.message.data(), static_cast<py::ssize_t>(failed.message.size()), "backslashreplace"));
          PyErr_SetObject(type.ptr(), text.ptr());
        }
      });
}

void raise(const error::Error& error) {
  tools::throw_failure(error);
}
void raise_value_error(const std::string& message) {
  throw tools::CommandFailed{message, databuffer::kExitUsage};
}

void read_options(const std::string& name, const std::vector<std::string>& words,
                  const std::function<void(databuffer::Command)>& add_options) {
  const text::DecimalPoint numbers;
  databuffer::CommandLine line("", name);
  add_options(line);
  if (const auto fault = line.read(words)) raise_value_error(*fault);
}

void Warnings::explain(tools::CommandFailed& failed) const {
  constexpr std::string_view kReference = "see the lines above; ";
  const std::size_t at = failed.message.find(kReference);
  if (at == std::string::npos) return;
  std::string reason;
  for (const std::string& line : lines_)
    if (failed.message.find(line) == std::string::npos && reason.find(line) == std::string::npos)
      reason += "because of " + line + "; ";
  failed.message.replace(at, kReference.size(), reason);
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
