#include "lib/file/text_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <utility>

#include "lib/file/folder.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::file {

namespace {

// [bytes] Maximum size of a file, because files are read into memory as a whole. A track (recorded flight, one position
// a line) of one day at 50 Hz has about this size.
constexpr std::uintmax_t kMaxFile_bytes = std::uintmax_t{256} << 20;
// Maximum number of lines, which bounds the memory of the parsed lines. kMaxFile_bytes alone does not bound it, because
// a short line takes more memory after parsing than as text.
constexpr std::ptrdiff_t kMaxLines = 10'000'000;

}  // namespace

std::optional<std::string> read_regular_file(const std::filesystem::path& path, std::size_t max_bytes) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
  struct stat status{};
  if (!file || ::fstat(file.number(), &status) != 0) return std::nullopt;
  if (!S_ISREG(status.st_mode)) {
    errno = EINVAL;
    return std::nullopt;
  }
  constexpr std::size_t kMinStep = 65'536;  // [bytes] growth of the buffer if the status gives too small a size
  std::string text;
  for (std::size_t done = 0;;) {
    const std::size_t expected = std::max(static_cast<std::size_t>(status.st_size) + 1, done + kMinStep);
    text.resize(std::min(expected, max_bytes));
    if (done == text.size()) return text;
    const ssize_t count = ::read(file.number(), text.data() + done, text.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return std::nullopt;
    done += static_cast<std::size_t>(count);
    if (count == 0) {
      text.resize(done);
      return text;
    }
  }
}

error::Expected<std::string> read_text_file(const std::filesystem::path& path) {
  std::error_code code;
  if (std::filesystem::is_directory(path, code))
    return error::fail(path.string(), "a text file", "a folder", "name a file in it");
  // Reading a pipe can block forever. Reading a device may never end.
  if (std::filesystem::exists(path, code) && !std::filesystem::is_regular_file(path, code))
    return error::fail(path.string(), "a text file", "a pipe, a socket or a device", "copy it into a regular file");
  const std::uintmax_t size = std::filesystem::is_regular_file(path, code) ? std::filesystem::file_size(path, code) : 0;
  if (size > kMaxFile_bytes) return error::fail(path.string(), "at most 256 MiB of text", text::counted(size, "byte"));
  auto text = read_regular_file(path, kMaxFile_bytes + 1);
  if (!text) return error::fail(path.string(), "a file that can be read", error::reason_of(errno), "check the path");
  if (text->size() > kMaxFile_bytes) return error::fail(path.string(), "at most 256 MiB of text", "more");
  if (const auto lines = std::ranges::count(*text, '\n'); lines > kMaxLines)
    return error::fail(path.string(), "at most 10 million lines", std::to_string(lines), "split the file");
  return std::move(*text);
}

error::Expected<std::vector<double>> parse_numbers(const std::string& subject,
                                                   const std::vector<std::string_view>& texts,
                                                   const std::vector<NumberField>& fields, std::string_view separator) {
  if (texts.size() != fields.size()) {
    std::string names;
    for (const NumberField& field : fields)
      names += (names.empty() ? "" : std::string(separator)) + std::string(field.name);
    return error::fail(subject, names, text::counted(texts.size(), "field"));
  }
  std::vector<double> values;
  for (std::size_t index = 0; index < fields.size(); ++index) {
    const NumberField& field = fields[index];
    const auto value = text::finite_number(texts[index]);
    if (!value || *value < field.min || *value > field.max)
      return error::fail(subject,
                         std::string(field.name) + " in [" + text::text_of_number(field.min) + ", " +
                             text::text_of_number(field.max) + ']',
                         '"' + std::string(texts[index]) + '"');
    values.push_back(*value);
  }
  return values;
}

std::string line_location(std::string_view file, int line) {
  return std::string(file) + ':' + std::to_string(line);
}

}  // namespace yars::file
