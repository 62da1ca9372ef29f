#include "model/terrain/cell_reading.hpp"

#include <fstream>
#include <system_error>

namespace yars::model::terrain {

failure::Expected<std::vector<std::byte>> read_file(const std::filesystem::path& path, std::size_t limit_bytes) {
  std::error_code code;
  if (!std::filesystem::is_regular_file(path, code))
    return failure::fail(path.string(), "an elevation file", code ? code.message() : "not a plain file");
  const std::uintmax_t size = std::filesystem::file_size(path, code);
  if (code) return failure::fail(path.string(), "a readable file", code.message());
  if (size > limit_bytes)
    return failure::fail(path.string(), "at most " + std::to_string(limit_bytes) + " bytes",
                         std::to_string(size) + " bytes", "this is not a one-degree cell");
  std::ifstream file(path, std::ios::binary);
  std::vector<std::byte> bytes(size);
  file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  if (!file)
    return failure::fail(path.string(), "a readable file of " + std::to_string(size) + " bytes", "a failed read");
  return bytes;
}

}  // namespace yars::model::terrain
