// Lossless packing (Zstandard) and checksums (CRC-32) of the parts of a recording.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace yars::tools::recording {

// Keeps its tables from one call to the next.
class Packer {
 public:
  Packer();
  // Appends what packs `bytes`; false, and nothing is appended, when that would not be shorter.
  bool pack(std::span<const std::byte> bytes, std::vector<std::byte>& packed);

 private:
  struct Release {
    void operator()(void* tables) const;
  };
  std::unique_ptr<void, Release> tables_;
};

// Fills `bytes` from `packed`; false when it unpacks to anything but as many bytes. Takes no memory that `bytes` has
// not.
bool unpack(std::span<const std::byte> packed, std::span<std::byte> bytes);

std::uint32_t checksum_of(std::span<const std::byte> bytes);

}  // namespace yars::tools::recording
