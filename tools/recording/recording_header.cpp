#include "tools/recording/recording_header.hpp"

#include <array>
#include <cstdint>
#include <cstring>
#include <span>

#include "tools/recording/packing.hpp"
#include "tools/recording/recorded_kinds.hpp"

namespace yars::tools::recording {

namespace {

constexpr std::array<char, 8> kMagic{'Y', 'A', 'R', 'S', 'T', 'L', 'O', 'G'};
constexpr std::uint32_t kVersion = 3;
constexpr std::uint32_t kMostKinds = 63;

struct Preamble {
  std::array<char, 8> magic;
  std::uint32_t version;
  std::uint32_t kinds;
  std::uint32_t configuration_bytes;
  std::uint32_t terrain_bytes;
};

struct KindEntry {
  std::uint8_t number, reserved;
  std::uint16_t version;
  std::uint32_t bytes;
};
static_assert(sizeof(Preamble) == 24 && sizeof(KindEntry) == 8);

template <class T>
void append(std::vector<std::byte>& bytes, const T& value) {
  const auto more = std::as_bytes(std::span(&value, 1));
  bytes.insert(bytes.end(), more.begin(), more.end());
}

void append(std::vector<std::byte>& bytes, const std::string& text) {
  const auto more = std::as_bytes(std::span(text));
  bytes.insert(bytes.end(), more.begin(), more.end());
}

// The next `count` bytes of the file behind `bytes`.
bool read_on(std::istream& file, std::size_t count, std::vector<std::byte>& bytes) {
  const std::size_t begin = bytes.size();
  bytes.resize(begin + count);
  file.read(reinterpret_cast<char*>(bytes.data() + begin), static_cast<std::streamsize>(count));
  return static_cast<bool>(file);
}

std::string described(const KindEntry& entry, const RecordedKind* kind) {
  return (kind != nullptr ? std::string(kind->name) : "kind " + std::to_string(entry.number)) + " " +
         std::to_string(entry.version) + " of " + std::to_string(entry.bytes) + " bytes";
}

failure::Expected<void> check_kinds(std::span<const std::byte> entries, const std::string& file_name) {
  for (; !entries.empty(); entries = entries.subspan(sizeof(KindEntry))) {
    KindEntry entry{};
    std::memcpy(&entry, entries.data(), sizeof entry);
    const RecordedKind* kind = recorded_kind(entry.number);
    if (kind != nullptr && kind->version == entry.version && kind->bytes == entry.bytes) continue;
    const std::string expected = kind == nullptr ? "a kind of records that this release knows"
                                                 : described({entry.number, 0, kind->version, kind->bytes}, kind);
    return failure::fail(file_name, expected, described(entry, kind), "replay it with the release that recorded it");
  }
  return {};
}

}  // namespace

std::vector<std::byte> bytes_of(const RecordingHeader& header) {
  std::vector<std::byte> bytes;
  append(bytes, Preamble{kMagic, kVersion, static_cast<std::uint32_t>(recorded_kinds().size()),
                         static_cast<std::uint32_t>(header.configuration.size()),
                         static_cast<std::uint32_t>(header.terrain.size())});
  for (const RecordedKind& kind : recorded_kinds()) append(bytes, KindEntry{kind.number, 0, kind.version, kind.bytes});
  append(bytes, header.configuration);
  append(bytes, header.terrain);
  append(bytes, checksum_of(bytes));
  return bytes;
}

failure::Expected<RecordingHeader> read_header(std::istream& file, const std::string& file_name) {
  const auto damaged = [&](const std::string& found) {
    return failure::fail(file_name, "a whole header of a recording", found, "record again");
  };
  std::vector<std::byte> bytes;
  Preamble preamble{};
  const bool begins = read_on(file, sizeof preamble, bytes);
  std::memcpy(&preamble, bytes.data(), sizeof preamble);
  if (!begins || preamble.magic != kMagic)
    return failure::fail(file_name, "a recording made by yars record", "another kind of file");
  if (preamble.version != kVersion)
    return failure::fail(file_name, "version " + std::to_string(kVersion) + " of the recording format",
                         std::to_string(preamble.version), "replay it with the release that recorded it");
  if (preamble.kinds > kMostKinds || preamble.configuration_bytes > kMostHeaderText ||
      preamble.terrain_bytes > kMostHeaderText)
    return damaged("one with longer paths or more kinds of records than there can be");
  const std::size_t kinds_bytes = preamble.kinds * sizeof(KindEntry);
  std::uint32_t checksum = 0;
  if (!read_on(file, kinds_bytes + preamble.configuration_bytes + preamble.terrain_bytes, bytes) ||
      !file.read(reinterpret_cast<char*>(&checksum), sizeof checksum))
    return damaged("a file cut short");
  if (checksum != checksum_of(bytes)) return damaged("a checksum of other bytes");
  if (auto same = check_kinds(std::span(bytes).subspan(sizeof preamble, kinds_bytes), file_name); !same)
    return tl::unexpected(same.error());
  const auto* text = reinterpret_cast<const char*>(bytes.data()) + sizeof preamble + kinds_bytes;
  return RecordingHeader{std::string(text, preamble.configuration_bytes),
                         std::string(text + preamble.configuration_bytes, preamble.terrain_bytes)};
}

}  // namespace yars::tools::recording
