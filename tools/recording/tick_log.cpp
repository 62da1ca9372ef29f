#include "tools/recording/tick_log.hpp"

#include <array>
#include <cstring>
#include <type_traits>

namespace yars::tools::recording {

namespace {

using databuffer::AppliedEvent;
using databuffer::ModelTick;

constexpr std::array<char, 8> kMagic{'Y', 'A', 'R', 'S', 'T', 'L', 'O', 'G'};
constexpr std::uint32_t kVersion = 2;
constexpr std::uint32_t kLargestText = 1U << 16;     // [bytes] of a path in the header
constexpr std::uint32_t kLargestPayload = 1U << 16;  // [bytes] of a chunk: a larger one is damage

enum ChunkKind : std::uint32_t { kTick = 1, kEvent = 2, kSweep = 3, kStart = 4, kGap = 5, kState = 6 };
enum TickParts : std::uint32_t { kOwnshipPart = 1, kCommandPart = 2 };

// The part of a tick that changes every time.
struct TickHead {
  std::int64_t tick, resumed_tick;
  std::uint64_t terrain_generation;
  std::uint32_t epoch, flags, ownship_lane, samples;
  char fidelity[16];
  std::uint32_t parts, reserved;
};
static_assert(sizeof(TickHead) == 64);

// Sizes of all that is written as it lies in memory: a log of another layout is refused, not misread.
struct Preamble {
  std::array<char, 8> magic = kMagic;
  std::uint32_t version = kVersion;
  std::uint32_t sizes = sizeof(TickHead) + 7 * sizeof(databuffer::Ownship) + 11 * sizeof(databuffer::RadarCommand) +
                        13 * sizeof(AppliedEvent) + 17 * sizeof(SweepMark) + 19 * sizeof(databuffer::ModelStatus) +
                        23 * sizeof(databuffer::RadarState);
  std::uint32_t configuration_bytes = 0;
  std::uint32_t terrain_bytes = 0;
};

template <class T>
void append(std::string& bytes, const T& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

template <class T>
bool take(const std::string& bytes, std::size_t& at, T& value) {
  if (bytes.size() - at < sizeof value) return false;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  at += sizeof value;
  return true;
}

template <class T>
std::optional<TickLogEntry> whole(const std::string& payload) {
  T value{};
  std::size_t at = 0;
  if (!take(payload, at, value) || at != payload.size()) return std::nullopt;
  return TickLogEntry(value);
}

}  // namespace

failure::Expected<TickLogWriter> TickLogWriter::create(const std::filesystem::path& path, const TickLogHeader& header) {
  TickLogWriter writer;
  writer.file_.open(path, std::ios::binary | std::ios::trunc);
  if (!writer.file_)
    return failure::fail(path.string(), "a file that can be written", std::strerror(errno),
                         "check the folder and its rights");
  Preamble preamble;
  preamble.configuration_bytes = static_cast<std::uint32_t>(header.configuration.size());
  preamble.terrain_bytes = static_cast<std::uint32_t>(header.terrain.size());
  writer.file_.write(reinterpret_cast<const char*>(&preamble), sizeof preamble);
  writer.file_ << header.configuration << header.terrain;
  writer.bytes_ = sizeof preamble + header.configuration.size() + header.terrain.size();
  return writer;
}

void TickLogWriter::chunk(std::uint32_t kind, const void* payload, std::size_t size) {
  const std::array<std::uint32_t, 2> head{kind, static_cast<std::uint32_t>(size)};
  file_.write(reinterpret_cast<const char*>(head.data()), sizeof head);
  file_.write(static_cast<const char*>(payload), static_cast<std::streamsize>(size));
  bytes_ += sizeof head + size;
}

void TickLogWriter::write(const ModelTick& tick) {
  TickHead head{tick.tick,
                tick.resumed_tick,
                tick.terrain_generation,
                tick.epoch,
                tick.flags,
                tick.ownship_lane,
                tick.samples,
                {},
                0,
                0};
  std::memcpy(head.fidelity, tick.fidelity, sizeof head.fidelity);
  if (first_ || std::memcmp(&tick.ownship, &last_.ownship, sizeof tick.ownship) != 0) head.parts |= kOwnshipPart;
  if (first_ || std::memcmp(&tick.command, &last_.command, sizeof tick.command) != 0) head.parts |= kCommandPart;
  std::string payload;
  append(payload, head);
  if ((head.parts & kOwnshipPart) != 0U) append(payload, tick.ownship);
  if ((head.parts & kCommandPart) != 0U) append(payload, tick.command);
  chunk(kTick, payload.data(), payload.size());
  last_ = tick;
  first_ = false;
}

void TickLogWriter::write(const AppliedEvent& event) {
  chunk(kEvent, &event, sizeof event);
}
void TickLogWriter::write(const SweepMark& mark) {
  chunk(kSweep, &mark, sizeof mark);
}
void TickLogWriter::write(const StartingPoint& start) {
  chunk(kStart, &start, sizeof start);
}
void TickLogWriter::write(const StateChange& change) {
  chunk(kState, &change, sizeof change);
}
void TickLogWriter::write(const Gap& gap) {
  chunk(kGap, &gap, sizeof gap);
}

bool TickLogWriter::flush() {
  return static_cast<bool>(file_.flush());
}

failure::Expected<TickLogReader> TickLogReader::open(const std::filesystem::path& path) {
  TickLogReader reader;
  reader.file_.open(path, std::ios::binary);
  if (!reader.file_) return failure::fail(path.string(), "a recording that can be read", std::strerror(errno));
  Preamble found;
  const Preamble expected;
  reader.file_.read(reinterpret_cast<char*>(&found), sizeof found);
  if (!reader.file_ || found.magic != expected.magic)
    return failure::fail(path.string(), "a recording made by yars record", "another kind of file");
  if (found.version != expected.version || found.sizes != expected.sizes)
    return failure::fail(path.string(),
                         "layout " + std::to_string(expected.version) + "/" + std::to_string(expected.sizes),
                         std::to_string(found.version) + "/" + std::to_string(found.sizes),
                         "replay it with the release that recorded it");
  if (found.configuration_bytes > kLargestText || found.terrain_bytes > kLargestText)
    return failure::fail(path.string(), "paths of at most 64 KiB in the header", "longer ones: the file is damaged");
  reader.header_.configuration.resize(found.configuration_bytes);
  reader.header_.terrain.resize(found.terrain_bytes);
  reader.file_.read(reader.header_.configuration.data(), found.configuration_bytes);
  reader.file_.read(reader.header_.terrain.data(), found.terrain_bytes);
  if (!reader.file_) return failure::fail(path.string(), "a whole header", "a file cut short");
  return reader;
}

std::optional<TickLogEntry> TickLogReader::tick_from(const std::string& payload) {
  TickHead head{};
  std::size_t at = 0;
  if (!take(payload, at, head)) return std::nullopt;
  ModelTick tick = last_;
  tick.tick = head.tick;
  tick.sim_time_ns = head.tick * radar::kTickNanoseconds;
  tick.resumed_tick = head.resumed_tick;
  tick.terrain_generation = head.terrain_generation;
  tick.epoch = head.epoch;
  tick.flags = head.flags;
  tick.ownship_lane = head.ownship_lane;
  tick.samples = head.samples;
  std::memcpy(tick.fidelity, head.fidelity, sizeof tick.fidelity);
  if ((head.parts & kOwnshipPart) != 0U && !take(payload, at, tick.ownship)) return std::nullopt;
  if ((head.parts & kCommandPart) != 0U && !take(payload, at, tick.command)) return std::nullopt;
  last_ = tick;
  return TickLogEntry(tick);
}

std::optional<TickLogEntry> TickLogReader::next() {
  std::array<std::uint32_t, 2> head{};
  file_.read(reinterpret_cast<char*>(head.data()), sizeof head);
  if (file_.gcount() == 0) return std::nullopt;
  std::optional<TickLogEntry> entry;
  if (file_ && head[1] <= kLargestPayload) {
    std::string payload(head[1], '\0');
    file_.read(payload.data(), static_cast<std::streamsize>(payload.size()));
    if (file_) {
      switch (head[0]) {
        case kTick:
          entry = tick_from(payload);
          break;
        case kEvent:
          entry = whole<AppliedEvent>(payload);
          break;
        case kSweep:
          entry = whole<SweepMark>(payload);
          break;
        case kStart:
          entry = whole<StartingPoint>(payload);
          break;
        case kState:
          entry = whole<StateChange>(payload);
          break;
        case kGap:
          entry = whole<Gap>(payload);
          break;
        default:
          break;
      }
    }
  }
  if (!entry) cut_short_ = true;
  return entry;
}

}  // namespace yars::tools::recording
