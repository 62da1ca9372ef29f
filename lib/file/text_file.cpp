#include "lib/file/text_file.hpp"

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <string_view>
#include <system_error>
#include <utility>

#include "lib/file/folder.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::file {

namespace {

namespace fs = std::filesystem;

// PREFIX/share/yars/NAME for a program in PREFIX/bin or PREFIX/libexec/yars, a library in PREFIX/lib/TRIPLET, or a
// Python module in PREFIX, the folder of its package.
std::optional<fs::path> folder_near(const fs::path& binary, std::string_view name) {
  std::error_code problem;
  fs::path folder = fs::weakly_canonical(binary, problem).parent_path();
  for (int levels = 0; levels < 3 && !folder.empty(); ++levels, folder = folder.parent_path()) {
    if (const fs::path found = folder / "share/yars" / name; fs::is_directory(found, problem))
      return fs::weakly_canonical(found, problem);
  }
  return std::nullopt;
}

}  // namespace

fs::path installed_folder(std::string_view name) {
  // A library comes first: the program that loads it, such as Python, may belong to another installation. For a
  // program's own code dladdr has the name that it was started by, which is no path when it came from PATH.
  Dl_info library{};
  if (dladdr(reinterpret_cast<const void*>(&installed_folder), &library) != 0 && library.dli_fname != nullptr &&
      fs::path(library.dli_fname).is_absolute())
    if (auto found = folder_near(library.dli_fname, name)) return *std::move(found);
  std::error_code problem;
  return folder_near(fs::read_symlink("/proc/self/exe", problem), name).value_or(fs::path());
}

std::string installed_file(const std::string& name, const fs::path& folder) {
  std::error_code problem;
  if (name.empty() || folder.empty() || name.find('/') != std::string::npos || fs::exists(name, problem)) return name;
  for (const char* part : {"", "routes", "scripts", "legends"})
    if (const fs::path file = folder / part / name; fs::is_regular_file(file, problem)) return file.string();
  return name;
}

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](char letter) {
    return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
  });
  return text;
}

FolderNames::Names FolderNames::listed(const fs::path& folder) {
  Names names;
  std::error_code code;
  fs::directory_iterator entry(folder.empty() ? "." : folder, code);
  for (const fs::directory_iterator end; !code && entry != end; entry.increment(code)) {
    std::string name = entry->path().filename().string();
    const auto [found, fresh] = names.try_emplace(lower_case(name), name);
    if (!fresh && name < found->second) found->second = std::move(name);
  }
  return names;
}

std::optional<fs::path> FolderNames::find(const fs::path& path) {
  std::error_code code;
  if (fs::exists(fs::symlink_status(path, code))) return path;
  const fs::path folder = path.parent_path();
  auto names = folders_.find(folder);
  if (names == folders_.end()) names = folders_.emplace(folder, listed(folder)).first;
  const auto name = names->second.find(lower_case(path.filename().string()));
  if (name == names->second.end()) return std::nullopt;
  return folder / name->second;
}

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
