#include "tools/recording/recording_index.hpp"

#include <array>
#include <cstring>
#include <optional>
#include <span>

#include "tools/recording/block_head.hpp"
#include "tools/recording/chunk.hpp"
#include "tools/recording/columns.hpp"

namespace yars::tools::recording {

namespace {

constexpr std::array<char, 4> kTrailerMagic{'Y', 'E', 'N', 'D'};

struct Trailer {
  std::uint64_t index_offset;
  std::uint32_t checksum;  // of the offset
  std::array<char, 4> magic;
};
static_assert(sizeof(Trailer) == 16);

std::uint32_t checksum_of_offset(std::uint64_t offset) {
  return checksum_of(std::as_bytes(std::span(&offset, 1)));
}

template <class T>
bool read_at(std::istream& file, std::uint64_t offset, T& value) {
  file.clear();
  file.seekg(static_cast<std::streamoff>(offset));
  return static_cast<bool>(file.read(reinterpret_cast<char*>(&value), sizeof value));
}

// Blocks lie one behind the other, from the first on.
bool is_plausible(const std::vector<IndexEntry>& blocks, std::uint64_t begin, std::uint64_t end) {
  for (const IndexEntry& block : blocks) {
    if (block.offset < begin || block.offset > end || end - block.offset < sizeof(BlockHead)) return false;
    begin = block.offset + sizeof(BlockHead);
  }
  return true;
}

// Nothing where the file does not end with an index.
std::optional<std::vector<IndexEntry>> written_index(std::istream& file, std::uint64_t begin, std::uint64_t size) {
  Trailer trailer{};
  if (size < begin + sizeof(BlockHead) + sizeof trailer || !read_at(file, size - sizeof trailer, trailer))
    return std::nullopt;
  const std::uint64_t end = size - sizeof trailer;
  if (trailer.magic != kTrailerMagic || trailer.checksum != checksum_of_offset(trailer.index_offset) ||
      trailer.index_offset < begin || trailer.index_offset > end - sizeof(BlockHead))
    return std::nullopt;
  BlockHead head{};
  if (!read_at(file, trailer.index_offset, head) || !is_sound(head) || head.content != BlockContent::index ||
      head.packed_bytes != end - trailer.index_offset - sizeof head || head.items > size / sizeof(BlockHead))
    return std::nullopt;
  std::vector<std::byte> body(head.packed_bytes);
  file.read(reinterpret_cast<char*>(body.data()), static_cast<std::streamsize>(body.size()));
  if (!file || !belongs(head, body)) return std::nullopt;
  std::span<const std::byte> rest(body);
  const auto coded = take_chunk({0, ChunkPart::index}, (head.items + std::size_t{2}) * sizeof(IndexEntry), rest);
  std::vector<std::byte> records;
  if (!coded || !decode_columns(*coded, head.items, sizeof(IndexEntry), records)) return std::nullopt;
  std::vector<IndexEntry> blocks(head.items);
  if (!blocks.empty()) std::memcpy(blocks.data(), records.data(), records.size());
  if (!is_plausible(blocks, begin, trailer.index_offset)) return std::nullopt;
  return blocks;
}

std::vector<IndexEntry> walked_index(std::istream& file, std::uint64_t begin, std::uint64_t size) {
  std::vector<IndexEntry> blocks;
  BlockHead head{};
  while (size - begin >= sizeof head && read_at(file, begin, head) && is_sound(head) &&
         head.content == BlockContent::items && head.packed_bytes <= size - begin - sizeof head) {
    blocks.push_back({begin, head.first_tick, head.last_tick, head.kinds});
    begin += sizeof head + head.packed_bytes;
  }
  return blocks;
}

}  // namespace

std::vector<std::byte> bytes_of(const std::vector<IndexEntry>& blocks, std::uint64_t offset, Packer& packer) {
  std::vector<std::byte> coded, body;
  encode_columns(std::as_bytes(std::span(blocks)), sizeof(IndexEntry), coded);
  append_chunk({0, ChunkPart::index}, coded, packer, body);
  BlockHead head{};
  head.content = BlockContent::index;
  head.items = static_cast<std::uint32_t>(blocks.size());
  std::vector<std::byte> bytes = sealed(head, body);
  const Trailer trailer{offset, checksum_of_offset(offset), kTrailerMagic};
  const auto end = std::as_bytes(std::span(&trailer, 1));
  bytes.insert(bytes.end(), end.begin(), end.end());
  return bytes;
}

RecordingIndex read_index(std::istream& file, std::uint64_t begin) {
  file.clear();
  file.seekg(0, std::ios::end);
  const auto size = static_cast<std::uint64_t>(file.tellg());
  if (auto written = written_index(file, begin, size)) return {std::move(*written), false};
  return {walked_index(file, begin, size), true};
}

}  // namespace yars::tools::recording
