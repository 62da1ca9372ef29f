// The items of a block, in the order in which they were recorded.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "tools/recording/block_head.hpp"
#include "tools/recording/recorded_kinds.hpp"

namespace yars::tools::recording {

class BlockItems {
 public:
  // Nothing when the body is not what its head says, though its checksum is right. Takes at most some
  // kMostBlockBytes of memory for each of body, columns and records.
  static std::optional<BlockItems> decode(const BlockHead& head, std::span<const std::byte> body);
  std::optional<RecordingItem> next();
  std::optional<RecordingItem> last_of(std::uint8_t kind) const;  // the block's last item of this kind

 private:
  struct Column {
    const RecordedKind* kind = nullptr;
    std::size_t count = 0;
    std::vector<std::byte> records, tails;
    std::vector<std::size_t> tail_begins;  // one more than records; empty: no tails
    std::size_t at = 0;
  };
  static bool decode(Column& column, std::size_t& left, std::span<const std::byte>& body);
  static bool decode_tails(Column& column, std::size_t& left, std::span<const std::byte>& body);
  static RecordingItem item(const Column& column, std::size_t at);

  std::map<std::uint8_t, Column> columns_;  // by the kind's number
  std::vector<std::byte> order_;
  std::size_t at_ = 0;
};

}  // namespace yars::tools::recording
