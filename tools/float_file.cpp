#include "tools/float_file.hpp"

#include <bit>
#include <cstdint>
#include <fstream>
#include <vector>

namespace yars::tools {

failure::Expected<void> write_floats(const std::filesystem::path& path, std::span<const float> values) {
  std::vector<char> bytes;
  bytes.reserve(values.size() * sizeof(float));
  for (const float value : values) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    for (const unsigned shift : {0U, 8U, 16U, 24U}) bytes.push_back(static_cast<char>((bits >> shift) & 0xFFU));
  }
  std::ofstream file(path, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.flush();
  if (!file)
    return failure::fail(path.string(), "a file that can be written", "an error",
                         "check the folder and the space left");
  return {};
}

}  // namespace yars::tools
