// Any bytes as a packed cell: a cell or an error, with memory bounded by the files' lengths. The input modifies a pair
// of well-formed files (.jp2 and .side) in pieces of (file, offset in two bytes, length, bytes). Checksums are
// corrected in seven inputs of eight, so that the reader gets past them to the data.
#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <vector>

#include "model/terrain/formats/pack.hpp"
#include "tests/model/terrain/sampling/rough_cell.hpp"

using namespace yars::model::terrain;

namespace {

constexpr CellCorner kPlace{36, -122};
constexpr int kPosts = 49;  // along an edge: small files that still have several reductions
// Offsets in the .side file: length of the .jp2 file; its CRC-32, CRC-32 of the rest, and the rest.
constexpr std::size_t kBytes = 20;
constexpr std::size_t kJp2Crc = 24, kRestCrc = 28, kRest = 32;

PackedCell well_formed_pack() {
  auto packed = pack_cell(yars::test::rough_cell(kPlace, kPosts, kPosts, 3));
  return packed ? *packed : PackedCell{};
}

void put(std::vector<std::byte>& file, std::size_t offset, std::size_t value) {
  for (std::size_t i = 0; i < 4; ++i) file[offset + i] = static_cast<std::byte>(value >> (24U - 8U * i));
}

std::size_t checksum(const std::vector<std::byte>& file, std::size_t from) {
  return crc32(0, reinterpret_cast<const Bytef*>(file.data()) + from, static_cast<uInt>(file.size() - from));
}

void correct_checksums(PackedCell& pack) {
  if (pack.side.size() < kRest) return;
  put(pack.side, kBytes, pack.jp2.size());
  put(pack.side, kJp2Crc, checksum(pack.jp2, 0));
  put(pack.side, kRestCrc, checksum(pack.side, kRest));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const PackedCell well_formed = well_formed_pack();
  if (size < 2) return 0;
  PackedCell pack = well_formed;
  const std::uint8_t* const end = data + size;
  const bool correct = data[0] % 8 != 0;
  const int reduction = data[1] % 8;
  data += 2;
  while (end - data >= 4) {
    std::vector<std::byte>& file = data[0] % 2 == 0 ? pack.jp2 : pack.side;
    // The first byte of a piece selects the file. Values from 252 also cut the file at the offset.
    if (file.empty()) break;
    const std::size_t offset = (data[1] * 256U + data[2]) % file.size();
    if (data[0] >= 252) file.resize(offset);
    const std::size_t length =
        std::min({std::size_t{data[3]}, static_cast<std::size_t>(end - data - 4), file.size() - offset});
    if (length > 0) std::memcpy(file.data() + offset, data + 4, length);
    data += 4 + length;
  }
  if (correct) correct_checksums(pack);
  (void)parse_pack(pack.jp2, pack.side, "fuzz", kPlace, reduction);
  return 0;
}
