#include "tools/float_file.hpp"

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "lib/file/new_file.hpp"

namespace yars::tools {

failure::Expected<void> write_floats(const std::filesystem::path& path, std::span<const float> values) {
  std::vector<char> bytes;
  bytes.reserve(values.size() * sizeof(float));
  for (const float value : values) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    for (const unsigned shift : {0U, 8U, 16U, 24U}) bytes.push_back(static_cast<char>((bits >> shift) & 0xFFU));
  }
  return file::write_file(path, std::as_bytes(std::span(bytes)));
}

}  // namespace yars::tools
