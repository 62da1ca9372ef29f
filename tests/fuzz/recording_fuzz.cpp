// Any bytes as a recording: items or an error, with memory bounded by the limits of a block. In seven inputs of eight
// the input modifies a well-formed recording in pieces of (offset in two bytes, length, bytes). In six of them the
// checksums are corrected, so that the reader gets to chunks, columns and index. One input of eight is itself the file.
#include <algorithm>
#include <cstdint>
#include <cstring>

#include "radar/recording/block.hpp"
#include "tests/radar/recording/made_recording.hpp"

using namespace yars;
using namespace yars::recording;

namespace {

struct WellFormed {
  std::string bytes = test::recorded(test::items_of_every_kind(60, 12));
  std::vector<std::size_t> blocks;  // offsets of the blocks, the last one being the index
  std::size_t header_end = 0;       // offset of the header's checksum

  WellFormed() {
    const auto reader = test::reader_of(bytes);
    for (const IndexEntry& block : reader->blocks()) blocks.push_back(block.offset);
    header_end = blocks.front() - sizeof(std::uint32_t);
    BlockHead last{};
    std::memcpy(&last, bytes.data() + blocks.back(), sizeof last);
    blocks.push_back(blocks.back() + sizeof last + last.body_bytes);
  }
};

// Corrects the header's checksum, and magic number, lengths and checksum of each block at its original offset.
void correct_checksums(const WellFormed& original, std::string& bytes) {
  constexpr std::size_t kTrailer = 16;
  const std::uint32_t checksum = checksum_of(std::as_bytes(std::span(bytes).first(original.header_end)));
  std::memcpy(bytes.data() + original.header_end, &checksum, sizeof checksum);
  for (std::size_t i = 0; i < original.blocks.size(); ++i) {
    const std::size_t begin = original.blocks[i];
    const std::size_t end = i + 1 < original.blocks.size() ? original.blocks[i + 1] : original.bytes.size() - kTrailer;
    BlockHead head{};
    std::memcpy(&head, bytes.data() + begin, sizeof head);
    const auto block =
        block_bytes(head, std::as_bytes(std::span(bytes)).subspan(begin + sizeof head, end - begin - sizeof head));
    std::memcpy(bytes.data() + begin, block.data(), block.size());
  }
}

void read_all(const std::string& bytes) {
  auto reader = test::reader_of(bytes);
  if (!reader) return;
  while (reader->next()) continue;
  reader->seek_block(reader->block_of(300));
  (void)reader->last_before<StateChange>();
  (void)reader->next();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const WellFormed original;
  if (size < 2) return 0;
  const unsigned how = data[0] % 8U;
  const std::uint8_t* const end = data + size;
  ++data;
  if (how == 0) {
    read_all(std::string(reinterpret_cast<const char*>(data), static_cast<std::size_t>(end - data)));
    return 0;
  }
  std::string bytes = original.bytes;
  while (end - data >= 3) {
    const std::size_t offset = (data[0] * 256U + data[1]) % bytes.size();
    const std::size_t length =
        std::min({std::size_t{data[2]}, static_cast<std::size_t>(end - data - 3), bytes.size() - offset});
    if (length > 0) std::memcpy(bytes.data() + offset, data + 3, length);
    data += 3 + length;
  }
  if (how != 1) correct_checksums(original, bytes);
  read_all(bytes);
  return 0;
}
