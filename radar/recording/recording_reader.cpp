#include "radar/recording/recording_reader.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <span>
#include <utility>

#include "radar/recording/block.hpp"

namespace yars::recording {

error::Expected<RecordingReader> RecordingReader::open(const std::filesystem::path& path) {
  std::error_code code;
  // Opening a pipe could block forever, and a reader cannot seek in a pipe.
  if (std::filesystem::exists(path, code) && !std::filesystem::is_regular_file(path, code))
    return error::fail(path.string(), "a recording in a regular file", "a folder, a pipe, a socket or a device",
                       "copy the recording into a regular file");
  auto file = std::make_unique<std::ifstream>(path, std::ios::binary);
  if (!*file)
    return error::fail(path.string(), "a recording that can be read", error::reason_of(errno), "check the path");
  return read(std::move(file), path.string());
}

error::Expected<RecordingReader> RecordingReader::read(std::unique_ptr<std::istream> file, const std::string& name) {
  RecordingReader reader;
  auto header = read_header(*file, name);
  if (!header) return tl::unexpected(header.error());
  reader.header_ = std::move(*header);
  reader.index_ = read_index(*file, static_cast<std::uint64_t>(file->tellg()));
  reader.file_ = std::move(file);
  return reader;
}

std::vector<std::byte> RecordingReader::bytes_at(std::uint64_t offset) {
  BlockHead head{};
  file_->clear();
  file_->seekg(static_cast<std::streamoff>(offset));
  if (!file_->read(reinterpret_cast<char*>(&head), sizeof head) || !is_sound(head) ||
      head.content != BlockContent::items)
    return {};
  std::vector<std::byte> bytes(sizeof head + head.body_bytes);
  std::memcpy(bytes.data(), &head, sizeof head);
  const std::span body = std::span(bytes).subspan(sizeof head);
  if (!file_->read(reinterpret_cast<char*>(body.data()), static_cast<std::streamsize>(body.size()))) return {};
  if (!body_matches(head, body)) return {};
  return bytes;
}

std::optional<BlockItems> RecordingReader::block_at(std::uint64_t offset) {
  const auto bytes = bytes_at(offset);
  if (bytes.empty()) return std::nullopt;
  BlockHead head{};
  std::memcpy(&head, bytes.data(), sizeof head);
  return BlockItems::decode(head, std::span(bytes).subspan(sizeof head));
}

std::vector<std::byte> RecordingReader::bytes_of_block(std::size_t block) {
  return block < index_.blocks.size() ? bytes_at(index_.blocks[block].offset) : std::vector<std::byte>();
}

std::optional<BlockItems> RecordingReader::undamaged_block(std::size_t block) {
  const IndexEntry& entry = index_.blocks[block];
  if (auto items = block_at(entry.offset)) return items;
  const auto at = std::ranges::lower_bound(missing_, entry.offset, {}, &IndexEntry::offset);
  if (at == missing_.end() || at->offset != entry.offset) missing_.insert(at, entry);
  return std::nullopt;
}

std::optional<RecordingItem> RecordingReader::next() {
  for (;;) {
    if (block_)
      if (auto item = block_->next()) return item;
    block_.reset();
    if (next_block_ >= index_.blocks.size()) return std::nullopt;
    block_ = undamaged_block(next_block_++);
    hole_ = hole_ || !block_;
  }
}

std::size_t RecordingReader::block_of(std::int64_t tick) const {
  const auto& blocks = index_.blocks;
  auto found = std::find_if(blocks.begin(), blocks.end(),
                            [tick](const auto& block) { return block.first_tick <= tick && tick <= block.last_tick; });
  if (found == blocks.end()) {
    const auto before =
        std::find_if(blocks.rbegin(), blocks.rend(), [tick](const auto& block) { return block.first_tick <= tick; });
    found = before == blocks.rend() ? blocks.begin() : before.base() - 1;
  }
  return static_cast<std::size_t>(found - blocks.begin());
}

void RecordingReader::seek_block(std::size_t block) {
  next_block_ = std::min(block, index_.blocks.size());
  block_.reset();
  hole_ = false;
}

std::optional<BlockItems> RecordingReader::items_of(std::size_t block) {
  if (block >= index_.blocks.size()) return std::nullopt;
  return undamaged_block(block);
}

std::optional<RecordingItem> RecordingReader::last_before(std::uint8_t kind) {
  const std::size_t end = next_block_ - (block_ ? 1 : 0);
  for (std::size_t i = end; i-- > 0;) {
    if ((index_.blocks[i].kinds >> kind & 1U) == 0) continue;
    const auto block = undamaged_block(i);
    if (!block) continue;
    if (auto item = block->last_of(kind)) return item;
  }
  return std::nullopt;
}

}  // namespace yars::recording
