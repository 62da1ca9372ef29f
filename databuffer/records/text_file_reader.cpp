#include "databuffer/records/text_file_reader.hpp"

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>

namespace yars::databuffer {

namespace {

// [bytes] a day of flight at 50 Hz; what is larger is no text of ours, and would be held in memory whole.
constexpr std::uintmax_t kLargestFile = std::uintmax_t{256} << 20;

}  // namespace

failure::Expected<std::string> read_text_file(const std::filesystem::path& path) {
  std::error_code code;
  if (std::filesystem::is_directory(path, code))
    return failure::fail(path.string(), "a text file", "a folder", "name a file in it");
  const std::uintmax_t size = std::filesystem::is_regular_file(path, code) ? std::filesystem::file_size(path, code) : 0;
  if (size > kLargestFile)
    return failure::fail(path.string(), "at most 256 MiB of text", std::to_string(size) + " bytes");
  std::ifstream file(path, std::ios::binary);
  if (!file) return failure::fail(path.string(), "a file that can be read", std::strerror(errno), "check the path");
  std::string text{std::istreambuf_iterator<char>(file), {}};
  if (file.bad()) return failure::fail(path.string(), "a file that can be read to its end", std::strerror(errno));
  return text;
}

}  // namespace yars::databuffer
