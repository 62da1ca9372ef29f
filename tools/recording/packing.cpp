#include "tools/recording/packing.hpp"

#include <zlib.h>
#include <zstd.h>

namespace yars::tools::recording {

namespace {
// Level 5 takes twice the time and makes a recording 1.6 % smaller; zlib at its best takes ten times as long for that.
constexpr int kLevel = 3;
}  // namespace

void Packer::Release::operator()(void* tables) const {
  ZSTD_freeCCtx(static_cast<ZSTD_CCtx*>(tables));
}

Packer::Packer() : tables_(ZSTD_createCCtx()) {}

bool Packer::pack(std::span<const std::byte> bytes, std::vector<std::byte>& packed) {
  const std::size_t begin = packed.size();
  packed.resize(begin + bytes.size());
  const std::size_t size = ZSTD_compressCCtx(static_cast<ZSTD_CCtx*>(tables_.get()), packed.data() + begin,
                                             bytes.size(), bytes.data(), bytes.size(), kLevel);
  const bool gains = ZSTD_isError(size) == 0U && size < bytes.size();
  packed.resize(gains ? begin + size : begin);
  return gains;
}

bool unpack(std::span<const std::byte> packed, std::span<std::byte> bytes) {
  return ZSTD_decompress(bytes.data(), bytes.size(), packed.data(), packed.size()) == bytes.size();
}

std::uint32_t checksum_of(std::span<const std::byte> bytes) {
  return static_cast<std::uint32_t>(crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

}  // namespace yars::tools::recording
