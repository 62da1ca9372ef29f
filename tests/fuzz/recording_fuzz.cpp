// Any bytes as a recording: items or an error, with memory bounded by the limits of a block. The input modifies a sound
// recording in pieces of (offset, length, bytes). Checksums are corrected in seven inputs of eight, so that the reader
// gets past them to chunks, columns and index. One input of eight is the whole file itself.
#include <algorithm>
#include <cstdint>
#include <cstring>

#include "tests/tools/recording/made_recording.hpp"
#include "tools/recording/block.hpp"

using namespace yars;
using namespace yars::tools::recording;

namespace {

struct Sound {
  std::string bytes = test::recorded(test::items_of_every_kind(60, 12));
  std::vector<std::size_t> blocks;  // where they begin, that of the index too
  std::size_t header_end = 0;       // where its checksum begins

  Sound() {
    const auto reader = test::reader_of(bytes);
    for (const IndexEntry& block : reader->blocks()) blocks.push_back(block.offset);
    header_end = blocks.front() - sizeof(std::uint32_t);
    BlockHead last{};
    std::memcpy(&last, bytes.data() + blocks.back(), sizeof last);
    blocks.push_back(blocks.back() + sizeof last + last.body_bytes);
  }
};

// Of the sound file's blocks, whatever their heads claim: magic, lengths and checksums are right, the rest is not.
void make_right(const Sound& sound, std::string& bytes) {
  constexpr std::size_t kTrailer = 16;
  const std::uint32_t checksum = checksum_of(std::as_bytes(std::span(bytes).first(sound.header_end)));
  std::memcpy(bytes.data() + sound.header_end, &checksum, sizeof checksum);
  for (std::size_t i = 0; i < sound.blocks.size(); ++i) {
    const std::size_t begin = sound.blocks[i];
    const std::size_t end = i + 1 < sound.blocks.size() ? sound.blocks[i + 1] : sound.bytes.size() - kTrailer;
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
  static const Sound sound;
  if (size < 2) return 0;
  const unsigned how = data[0] % 8U;
  const std::uint8_t* const end = data + size;
  ++data;
  if (how == 0) {
    read_all(std::string(reinterpret_cast<const char*>(data), static_cast<std::size_t>(end - data)));
    return 0;
  }
  std::string bytes = sound.bytes;
  while (end - data >= 3) {
    const std::size_t offset = (data[0] * 256U + data[1]) % bytes.size();
    const std::size_t length =
        std::min({std::size_t{data[2]}, static_cast<std::size_t>(end - data - 3), bytes.size() - offset});
    if (length > 0) std::memcpy(bytes.data() + offset, data + 3, length);
    data += 3 + length;
  }
  if (how != 1) make_right(sound, bytes);
  read_all(bytes);
  return 0;
}
