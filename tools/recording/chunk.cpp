#include "tools/recording/chunk.hpp"

#include <cstring>

namespace yars::tools::recording {

namespace {

enum class Packing : std::uint8_t { none = 0, zstd = 1 };

struct ChunkHead {
  std::uint8_t kind;
  ChunkPart part;
  Packing packing;
  std::uint8_t reserved;
  std::uint32_t raw_bytes;
  std::uint32_t packed_bytes;
};
static_assert(sizeof(ChunkHead) == 12);

}  // namespace

void append_chunk(ChunkName name, std::span<const std::byte> bytes, Packer& packer, std::vector<std::byte>& body) {
  ChunkHead head{name.kind, name.part, Packing::zstd, 0, static_cast<std::uint32_t>(bytes.size()), 0};
  const std::size_t begin = body.size();
  body.resize(begin + sizeof head);
  if (!packer.pack(bytes, body)) {
    head.packing = Packing::none;
    body.insert(body.end(), bytes.begin(), bytes.end());
  }
  head.packed_bytes = static_cast<std::uint32_t>(body.size() - begin - sizeof head);
  std::memcpy(body.data() + begin, &head, sizeof head);
}

std::optional<std::vector<std::byte>> take_chunk(ChunkName name, std::size_t most, std::span<const std::byte>& body) {
  ChunkHead head{};
  if (body.size() < sizeof head) return std::nullopt;
  std::memcpy(&head, body.data(), sizeof head);
  if (head.kind != name.kind || head.part != name.part || head.raw_bytes > most) return std::nullopt;
  if (head.packed_bytes > body.size() - sizeof head) return std::nullopt;
  const auto packed = body.subspan(sizeof head, head.packed_bytes);
  body = body.subspan(sizeof head + head.packed_bytes);
  if (head.packing == Packing::none) {
    if (head.packed_bytes != head.raw_bytes) return std::nullopt;
    return std::vector<std::byte>(packed.begin(), packed.end());
  }
  std::vector<std::byte> bytes(head.raw_bytes);
  if (head.packing != Packing::zstd || !unpack(packed, bytes)) return std::nullopt;
  return bytes;
}

}  // namespace yars::tools::recording
