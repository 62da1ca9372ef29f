#include "databuffer/terminal_guard.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <ext/stdio_sync_filebuf.h>
#include <iostream>
#include <string>
#include <utility>

#include "lib/failure/printable.hpp"

namespace yars::databuffer {

namespace {

struct Outlet {
  int descriptor;
  std::string unfinished;  // the first bytes of a character whose others are still to come
};

bool write_all(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t count = ::write(descriptor, text.data(), text.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    text.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

ssize_t write_printable(void* cookie, const char* bytes, std::size_t size) {
  auto& outlet = *static_cast<Outlet*>(cookie);
  std::string text = std::exchange(outlet.unfinished, {}) + std::string(bytes, size);
  const std::size_t held = failure::unfinished_bytes(text);
  outlet.unfinished = text.substr(text.size() - held);
  text.resize(text.size() - held);
  return write_all(outlet.descriptor, failure::printable_lines(text)) ? static_cast<ssize_t>(size) : 0;
}

// nullptr: the system has no room for it; the stream stays as it is.
std::FILE* guarded(Outlet& outlet, int buffering) {
  cookie_io_functions_t functions{};
  functions.write = write_printable;
  std::FILE* stream = ::fopencookie(&outlet, "w", functions);
  if (stream != nullptr) std::setvbuf(stream, nullptr, buffering, BUFSIZ);
  return stream;
}

}  // namespace

void guard_terminal() {
  // They outlive what is printed while the process ends.
  static auto* const outlets = new Outlet[]{{STDOUT_FILENO, {}}, {STDERR_FILENO, {}}};
  static const bool done = [] {
    std::FILE* out = guarded(outlets[0], ::isatty(STDOUT_FILENO) != 0 ? _IOLBF : _IOFBF);
    std::FILE* error = guarded(outlets[1], _IONBF);
    if (out == nullptr || error == nullptr) return false;
    stdout = out;
    stderr = error;
    static auto* const cout_buffer = new __gnu_cxx::stdio_sync_filebuf<char>(out);
    static auto* const cerr_buffer = new __gnu_cxx::stdio_sync_filebuf<char>(error);
    std::cout.rdbuf(cout_buffer);
    std::cerr.rdbuf(cerr_buffer);
    std::clog.rdbuf(cerr_buffer);
    return true;
  }();
  (void)done;
}

}  // namespace yars::databuffer
