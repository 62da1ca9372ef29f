// Any bytes as a DTED cell: a cell or an error, with memory bounded by the file's length. The input modifies a
// well-formed file, so that the reader gets past its header. Two bytes of the input set the length of the file. Then
// follow pieces of (offset in two bytes, length, bytes).
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <vector>

#include "model/terrain/formats/dted.hpp"

using namespace yars::model::terrain;

namespace {

constexpr std::size_t kHeaders = 80 + 648 + 2700;  // [bytes] the headers UHL, DSI and ACC
constexpr std::size_t kPosts = 121;                // along an edge of a cell of level 0
constexpr std::size_t kRecord = 12 + 2 * kPosts;   // [bytes] one column

std::vector<std::byte> well_formed_cell() {
  std::vector<std::byte> file(kHeaders + kPosts * kRecord);
  const auto put = [&file](std::size_t offset, std::string_view text) {
    std::memcpy(file.data() + offset, text.data(), text.size());
  };
  put(0, "UHL11200000W0350000N03000300");
  put(47, "01210121");
  put(80, "DSI");
  put(728, "ACC");
  for (std::size_t column = 0; column < kPosts; ++column) {
    std::byte* record = file.data() + kHeaders + column * kRecord;
    record[0] = std::byte{0xAA};
    record[3] = static_cast<std::byte>(column);
    record[5] = static_cast<std::byte>(column);
  }
  return file;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::vector<std::byte> cell = well_formed_cell();
  std::vector<std::byte> file = cell;
  const std::uint8_t* const end = data + size;
  if (size >= 2) {
    file.resize(file.size() * (256U - data[0]) / 256U + data[1]);
    data += 2;
  }
  while (end - data >= 3 && !file.empty()) {
    const std::size_t offset = (data[0] * 256U + data[1]) % file.size();
    const std::size_t length =
        std::min({std::size_t{data[2]}, static_cast<std::size_t>(end - data - 3), file.size() - offset});
    std::memcpy(file.data() + offset, data + 3, length);
    data += 3 + length;
  }
  (void)parse_dted(file, "fuzz", CellCorner{.south_deg = 35, .west_deg = -120});
  return 0;
}
