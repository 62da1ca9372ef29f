#include "model/scene/openflight/records.hpp"

#include <algorithm>

#include "lib/text/plain_text.hpp"

namespace yars::model::scene {

namespace {

constexpr std::size_t kHeadBytes = 4;
// [bytes] Limit of a record with its continuations. Allows a local vertex pool of 7 million vertices with normals (36
// bytes each), and bounds memory.
constexpr std::size_t kMaxJoinedBytes = 256U << 20;

bool is_continuation(std::span<const std::byte> bytes, std::size_t at) {
  return at + kHeadBytes <= bytes.size() &&
         memory::big_endian<std::uint16_t>(bytes.data() + at) == openflight::kContinuation;
}

}  // namespace

std::string Record::raw_text(std::size_t offset, std::size_t max_length) const {
  std::string text;
  for (std::size_t i = offset; i < bytes_.size() && text.size() < max_length; ++i) {
    const char letter = std::to_integer<char>(bytes_[i]);
    if (letter == 0) break;
    text.push_back(letter);
  }
  return text;
}

std::string Record::text(std::size_t offset, std::size_t max_length) const {
  std::string text = raw_text(offset, max_length);
  std::ranges::replace_if(text, [](char letter) { return letter < 0x20 || letter > 0x7E; }, '?');
  return text;
}

std::optional<Record> record_at(std::span<const std::byte> bytes, std::size_t start) {
  if (start > bytes.size() || bytes.size() - start < kHeadBytes) return std::nullopt;
  const auto opcode = memory::big_endian<std::uint16_t>(bytes.data() + start);
  const std::size_t length = memory::big_endian<std::uint16_t>(bytes.data() + start + 2);
  if (length < kHeadBytes || length > bytes.size() - start) return std::nullopt;
  return Record(start, opcode, bytes.subspan(start, length));
}

error::Expected<std::optional<Record>> RecordStream::single() {
  if (at_ == bytes_.size()) return std::nullopt;
  const std::optional<Record> record = record_at(bytes_, at_);
  if (!record) {
    const std::size_t left = bytes_.size() - at_;
    const std::string at = "a whole record at byte " + std::to_string(at_);
    const std::string end = text::counted(left, "byte") + " up to the file's end";
    if (left < kHeadBytes)
      return error::fail(subject_, at + ", of " + std::to_string(kHeadBytes) + " bytes or more", end,
                         "the file is truncated or damaged; fetch it again");
    const std::size_t length = memory::big_endian<std::uint16_t>(bytes_.data() + at_ + 2);
    return error::fail(subject_, at, "one with a stated length of " + std::to_string(length) + " bytes, and " + end,
                       "the file is truncated or damaged; fetch it again");
  }
  at_ += record->size();
  return record;
}

error::Expected<std::optional<Record>> RecordStream::next() {
  error::Expected<std::optional<Record>> record = single();
  if (!record || !*record || !is_continuation(bytes_, at_)) return record;
  const Record first = **record;
  const auto begin = bytes_.begin() + static_cast<std::ptrdiff_t>(first.start());
  joined_.assign(begin, begin + static_cast<std::ptrdiff_t>(first.size()));
  while (is_continuation(bytes_, at_)) {
    record = single();
    if (!record) return record;
    const std::span<const std::byte> more = bytes_.subspan((*record)->start(), (*record)->size()).subspan(kHeadBytes);
    if (joined_.size() + more.size() > kMaxJoinedBytes)
      return error::fail(subject_, "a record of at most " + std::to_string(kMaxJoinedBytes) + " bytes",
                         "a longer one with its continuations", "split the mesh into several meshes");
    joined_.insert(joined_.end(), more.begin(), more.end());
  }
  return Record(first.start(), first.opcode(), joined_);
}

}  // namespace yars::model::scene
