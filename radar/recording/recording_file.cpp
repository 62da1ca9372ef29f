#include "radar/recording/recording_file.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "radar/recording/block.hpp"
#include "radar/recording/recorded_kinds.hpp"

namespace yars::recording {

namespace {

constexpr std::array<char, 8> kFileMagic{'Y', 'A', 'R', 'S', 'T', 'L', 'O', 'G'};
constexpr std::uint32_t kVersion = 4;
constexpr std::uint32_t kVersionWithoutModel = 3;  // its recordings were made by model 1
constexpr std::uint32_t kMaxKinds = 63;            // numbers 1 to 63

struct Preamble {
  std::array<char, 8> magic;
  std::uint32_t version;
  std::uint32_t kinds;  // number of KindEntry records that follow
  std::uint32_t configuration_bytes;
  std::uint32_t terrain_bytes;
};

struct KindEntry {
  std::uint8_t number, reserved;
  std::uint16_t version;
  std::uint32_t bytes;
};
static_assert(sizeof(Preamble) == 24 && sizeof(KindEntry) == 8);

// After the preamble, from format version 4 on.
struct ModelEntry {
  std::uint32_t model, reserved;
};
static_assert(sizeof(ModelEntry) == 8);

template <class T>
void append(std::vector<std::byte>& bytes, const T& value) {
  const std::size_t begin = bytes.size();
  bytes.resize(begin + sizeof value);
  std::memcpy(bytes.data() + begin, &value, sizeof value);
}

void append(std::vector<std::byte>& bytes, const std::string& text) {
  const auto more = std::as_bytes(std::span(text));
  bytes.insert(bytes.end(), more.begin(), more.end());
}

// Appends the next `count` bytes of the file to `bytes`. Returns false if the file has fewer bytes.
bool read_more(std::istream& file, std::size_t count, std::vector<std::byte>& bytes) {
  const std::size_t begin = bytes.size();
  bytes.resize(begin + count);
  file.read(reinterpret_cast<char*>(bytes.data() + begin), static_cast<std::streamsize>(count));
  return static_cast<bool>(file);
}

std::string described(const KindEntry& entry, const RecordedKind* kind) {
  return (kind != nullptr ? std::string(kind->name) : "kind " + std::to_string(entry.number)) + " version " +
         std::to_string(entry.version) + " with records of " + std::to_string(entry.bytes) + " bytes";
}

error::Expected<void> check_kinds(std::span<const std::byte> entries, const std::string& file_name) {
  for (; !entries.empty(); entries = entries.subspan(sizeof(KindEntry))) {
    KindEntry entry{};
    std::memcpy(&entry, entries.data(), sizeof entry);
    const RecordedKind* kind = recorded_kind(entry.number);
    if (kind != nullptr && kind->version == entry.version && kind->bytes == entry.bytes) continue;
    const std::string expected = kind == nullptr ? "a kind of records that this release knows"
                                                 : described({entry.number, 0, kind->version, kind->bytes}, kind);
    return error::fail(file_name, expected, described(entry, kind), "replay it with the release that recorded it");
  }
  return {};
}

}  // namespace

std::string_view file_magic() {
  return {kFileMagic.data(), kFileMagic.size()};
}

std::vector<std::byte> bytes_of(const RecordingHeader& header) {
  std::vector<std::byte> bytes;
  append(bytes, Preamble{kFileMagic, kVersion, static_cast<std::uint32_t>(recorded_kinds().size()),
                         static_cast<std::uint32_t>(header.configuration.size()),
                         static_cast<std::uint32_t>(header.terrain.size())});
  append(bytes, ModelEntry{header.model, 0});
  for (const RecordedKind& kind : recorded_kinds()) append(bytes, KindEntry{kind.number, 0, kind.version, kind.bytes});
  append(bytes, header.configuration);
  append(bytes, header.terrain);
  append(bytes, checksum_of(bytes));
  return bytes;
}

error::Expected<RecordingHeader> read_header(std::istream& file, const std::string& file_name) {
  const auto damaged = [&](const std::string& found) {
    return error::fail(file_name, "a complete header of a recording", found, "record again");
  };
  std::vector<std::byte> bytes;
  Preamble preamble{};
  const bool complete = read_more(file, sizeof preamble, bytes);
  std::memcpy(&preamble, bytes.data(), sizeof preamble);
  if (!complete || preamble.magic != kFileMagic)
    return error::fail(file_name, "a recording made by yars record", "another kind of file");
  if (preamble.version != kVersion && preamble.version != kVersionWithoutModel)
    return error::fail(file_name, "version " + std::to_string(kVersion) + " of the recording format",
                       std::to_string(preamble.version), "replay it with the release that recorded it");
  ModelEntry made_by{1, 0};
  if (preamble.version == kVersion) {
    if (!read_more(file, sizeof made_by, bytes)) return damaged("a file cut short within the header");
    std::memcpy(&made_by, bytes.data() + sizeof preamble, sizeof made_by);
  }
  const std::size_t fixed_bytes = bytes.size();
  if (preamble.kinds > kMaxKinds || preamble.configuration_bytes > kMaxHeaderText ||
      preamble.terrain_bytes > kMaxHeaderText)
    return damaged("a header with longer paths or more kinds of records than allowed");
  const std::size_t kinds_bytes = preamble.kinds * sizeof(KindEntry);
  std::uint32_t checksum = 0;
  if (!read_more(file, kinds_bytes + preamble.configuration_bytes + preamble.terrain_bytes, bytes) ||
      !file.read(reinterpret_cast<char*>(&checksum), sizeof checksum))
    return damaged("a file cut short within the header");
  if (checksum != checksum_of(bytes)) return damaged("a wrong checksum");
  if (auto same = check_kinds(std::span(bytes).subspan(fixed_bytes, kinds_bytes), file_name); !same)
    return tl::unexpected(same.error());
  const auto* text = reinterpret_cast<const char*>(bytes.data()) + fixed_bytes + kinds_bytes;
  return RecordingHeader{std::string(text, preamble.configuration_bytes),
                         std::string(text + preamble.configuration_bytes, preamble.terrain_bytes), made_by.model};
}

error::Expected<void> check_model(const RecordingHeader& header, const std::string& file_name) {
  if (header.model == radar::kModelNumber) return {};
  return error::fail(file_name, "a recording made by model " + std::to_string(radar::kModelNumber),
                     "one made by model " + std::to_string(header.model),
                     "play its video, or compare it with the release that recorded it");
}

namespace {

constexpr std::array<char, 4> kTrailerMagic{'Y', 'E', 'N', 'D'};

struct Trailer {
  std::uint64_t index_offset;
  std::uint32_t checksum;  // checksum of the offset
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

// True if the block offsets ascend between `begin` and `end` without overlap of the blocks' heads.
bool is_plausible(const std::vector<IndexEntry>& blocks, std::uint64_t begin, std::uint64_t end) {
  for (const IndexEntry& block : blocks) {
    if (block.offset < begin || block.offset > end || end - block.offset < sizeof(BlockHead)) return false;
    begin = block.offset + sizeof(BlockHead);
  }
  return true;
}

// The stored index; nullopt if the file does not end with a valid index.
std::optional<std::vector<IndexEntry>> stored_index(std::istream& file, std::uint64_t begin, std::uint64_t size) {
  Trailer trailer{};
  if (size < begin + sizeof(BlockHead) + sizeof trailer || !read_at(file, size - sizeof trailer, trailer))
    return std::nullopt;
  const std::uint64_t end = size - sizeof trailer;
  if (trailer.magic != kTrailerMagic || trailer.checksum != checksum_of_offset(trailer.index_offset) ||
      trailer.index_offset < begin || trailer.index_offset > end - sizeof(BlockHead))
    return std::nullopt;
  BlockHead head{};
  if (!read_at(file, trailer.index_offset, head) || !is_sound(head) || head.content != BlockContent::index ||
      head.body_bytes != end - trailer.index_offset - sizeof head || head.items > size / sizeof(BlockHead))
    return std::nullopt;
  std::vector<std::byte> body(head.body_bytes);
  file.read(reinterpret_cast<char*>(body.data()), static_cast<std::streamsize>(body.size()));
  if (!file || !body_matches(head, body)) return std::nullopt;
  std::span<const std::byte> rest(body);
  const auto coded = take_chunk({0, ChunkPart::index}, (head.items + std::size_t{2}) * sizeof(IndexEntry), rest);
  std::vector<std::byte> records;
  if (!coded || !decode_columns(*coded, head.items, sizeof(IndexEntry), records)) return std::nullopt;
  std::vector<IndexEntry> blocks(head.items);
  if (!blocks.empty()) std::memcpy(blocks.data(), records.data(), records.size());
  if (!is_plausible(blocks, begin, trailer.index_offset)) return std::nullopt;
  return blocks;
}

// True if a complete block begins at `offset`. Reads its head into `head`.
bool is_complete_at(std::istream& file, std::uint64_t offset, std::uint64_t size, BlockHead& head) {
  return size - offset >= sizeof head && read_at(file, offset, head) && is_sound(head) &&
         head.body_bytes <= size - offset - sizeof head;
}

// Offset of the first complete block at or after `offset`; the size of the file if there is none.
std::uint64_t next_block(std::istream& file, std::uint64_t offset, std::uint64_t size) {
  constexpr std::size_t kBufferBytes = std::size_t{1} << 16;
  const std::string_view magic = magic_of_blocks();
  std::string buffer;
  BlockHead head{};
  while (size - offset >= sizeof head) {
    buffer.resize(std::min<std::uint64_t>(kBufferBytes, size - offset));
    file.clear();
    file.seekg(static_cast<std::streamoff>(offset));
    if (!file.read(buffer.data(), static_cast<std::streamsize>(buffer.size()))) return size;
    for (auto at = buffer.find(magic); at != std::string::npos; at = buffer.find(magic, at + 1))
      if (is_complete_at(file, offset + at, size, head)) return offset + at;
    if (buffer.size() < kBufferBytes) return size;
    // Consecutive buffers overlap, because a magic number may cross their boundary.
    offset += kBufferBytes - magic.size();
  }
  return size;
}

// Entry for damaged bytes from `begin` to the complete block at `next`. The ticks are from the head at `begin` if that
// head is sound, else from the neighbouring blocks.
IndexEntry hole_at(std::istream& file, std::uint64_t begin, std::uint64_t next, std::uint64_t size,
                   const std::vector<IndexEntry>& before) {
  BlockHead head{};
  IndexEntry hole{begin, before.empty() ? 0 : before.back().last_tick, 0, 0};
  hole.last_tick = hole.first_tick;
  if (size - begin >= sizeof head && read_at(file, begin, head) && is_sound(head) &&
      head.content == BlockContent::items)
    return {begin, head.first_tick, head.last_tick, 0};
  if (!before.empty() && hole.first_tick < std::numeric_limits<std::int64_t>::max()) ++hole.first_tick;
  hole.last_tick = hole.first_tick;
  if (read_at(file, next, head) && head.first_tick > hole.first_tick) hole.last_tick = head.first_tick - 1;
  return hole;
}

// Index made from the heads of the complete blocks from `begin` on, with entries for damaged bytes between them.
std::vector<IndexEntry> rebuilt_index(std::istream& file, std::uint64_t begin, std::uint64_t size) {
  std::vector<IndexEntry> blocks;
  BlockHead head{};
  while (begin < size) {
    if (is_complete_at(file, begin, size, head)) {
      if (head.content == BlockContent::items) blocks.push_back({begin, head.first_tick, head.last_tick, head.kinds});
      begin += sizeof head + head.body_bytes;
      // Only the trailer follows the index block.
      if (head.content == BlockContent::index) break;
      continue;
    }
    const std::uint64_t next = next_block(file, begin + 1, size);
    if (next == size) break;  // no complete block follows
    blocks.push_back(hole_at(file, begin, next, size, blocks));
    begin = next;
  }
  return blocks;
}

}  // namespace

std::vector<std::byte> bytes_of(const std::vector<IndexEntry>& blocks, std::uint64_t offset, Compressor& compressor) {
  std::vector<std::byte> coded, body;
  encode_columns(std::as_bytes(std::span(blocks)), sizeof(IndexEntry), coded);
  append_chunk({0, ChunkPart::index}, coded, compressor, body);
  BlockHead head{};
  head.content = BlockContent::index;
  head.items = static_cast<std::uint32_t>(blocks.size());
  std::vector<std::byte> bytes = block_bytes(head, body);
  const Trailer trailer{offset, checksum_of_offset(offset), kTrailerMagic};
  const auto end = std::as_bytes(std::span(&trailer, 1));
  bytes.insert(bytes.end(), end.begin(), end.end());
  return bytes;
}

RecordingIndex read_index(std::istream& file, std::uint64_t begin) {
  file.clear();
  file.seekg(0, std::ios::end);
  const auto size = static_cast<std::uint64_t>(file.tellg());
  if (auto stored = stored_index(file, begin, size)) return {std::move(*stored), false};
  return {rebuilt_index(file, begin, size), true};
}

}  // namespace yars::recording
