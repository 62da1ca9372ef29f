#include "tools/recording/block_head.hpp"

#include <algorithm>
#include <cstring>

#include "tools/recording/packing.hpp"

namespace yars::tools::recording {

namespace {

constexpr std::array<char, 4> kMagic{'Y', 'B', 'L', 'K'};

std::uint32_t checksum_of_head(const BlockHead& head) {
  return checksum_of(std::as_bytes(std::span(&head, 1)).first(offsetof(BlockHead, head_checksum)));
}

}  // namespace

std::string_view magic_of_blocks() {
  return {kMagic.data(), kMagic.size()};
}

std::vector<std::byte> sealed(BlockHead head, std::span<const std::byte> body) {
  head.magic = kMagic;
  head.packed_bytes = static_cast<std::uint32_t>(body.size());
  head.body_checksum = checksum_of(body);
  head.reserved = 0;
  head.head_checksum = checksum_of_head(head);
  std::vector<std::byte> block(sizeof head + body.size());
  std::memcpy(block.data(), &head, sizeof head);
  std::copy(body.begin(), body.end(), block.begin() + sizeof head);
  return block;
}

bool is_sound(const BlockHead& head) {
  if (head.magic != kMagic || head.head_checksum != checksum_of_head(head)) return false;
  if (head.content == BlockContent::index) return true;
  return head.content == BlockContent::items && head.raw_bytes <= kMostBlockBytes &&
         head.packed_bytes <= kMostBlockBytes && head.items <= kMostBlockItems;
}

bool belongs(const BlockHead& head, std::span<const std::byte> body) {
  return body.size() == head.packed_bytes && checksum_of(body) == head.body_checksum;
}

}  // namespace yars::tools::recording
