#include "model/terrain/whole_file_writer.hpp"

#include <fstream>
#include <string>
#include <system_error>

namespace yars::model::terrain {

failure::Expected<std::filesystem::path> write_whole_file(const std::filesystem::path& path,
                                                          std::span<const std::byte> bytes) {
  const std::filesystem::path beside = path.string() + ".tmp";
  std::error_code code;
  std::filesystem::create_directories(path.parent_path(), code);
  if (code) return failure::fail(path.parent_path().string(), "a folder that can be made", code.message());
  std::ofstream file(beside, std::ios::binary | std::ios::trunc);
  file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) {
    std::filesystem::remove(beside, code);
    return failure::fail(beside.string(), "a file of " + std::to_string(bytes.size()) + " bytes to be written",
                         "a failed write", "check the folder and the space on the disk");
  }
  std::filesystem::rename(beside, path, code);
  if (!code) return path;
  const std::string why = code.message();
  std::filesystem::remove(beside, code);
  return failure::fail(path.string(), "a file that can be replaced", why);
}

}  // namespace yars::model::terrain
