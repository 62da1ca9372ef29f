#include "yars/recording.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <span>
#include <string_view>
#include <utility>
#include <variant>

#include "databuffer/messages/record_fields.hpp"
#include "radar/limits.hpp"
#include "radar/recording/recording_io.hpp"
#include "radar/theatre.hpp"

namespace yars {

struct Recording::Parts {
  std::string path;
  recording::RecordingReader reader;
  std::uint64_t kind_bits = 0;
  std::optional<std::int64_t> first_tick, last_tick;
  std::size_t told = 0;  // damaged blocks that were warned of
};

namespace {

using databuffer::RecordField;
using databuffer::RecordFields;
using recording::RecordedKind;

const RecordFields* record_named(std::string_view record) {
  const auto all = databuffer::record_fields();
  const auto found = std::ranges::find(all, record, &RecordFields::record);
  return found == all.end() ? nullptr : &*found;
}

// Kinds that records.idl does not describe (recorded_kinds.hpp).
constexpr RecordField kDigestFields[] = {
    {"tick", offsetof(recording::SweepDigest, tick), 8, "int64", "tick", 0, 0},
    {"hash", offsetof(recording::SweepDigest, hash), 8, "uint64", "", 0, 0},
    {"epoch", offsetof(recording::SweepDigest, epoch), 4, "uint32", "", 0, 0},
    {"number", offsetof(recording::SweepDigest, number), 4, "uint32", "", 0, 0},
    {"flags", offsetof(recording::SweepDigest, flags), 4, "uint32", "", 0, 0},
};
constexpr RecordField kGapFields[] = {
    {"ticks", offsetof(recording::Gap, ticks), 8, "uint64", "", 0, 0},
    {"events", offsetof(recording::Gap, events), 8, "uint64", "", 0, 0},
    {"sweeps", offsetof(recording::Gap, sweeps), 8, "uint64", "", 0, 0},
};

// Fields of a kind's fixed part.
std::span<const RecordField> raw_fields(const RecordedKind& kind) {
  if (kind.name == "SweepDigest") return kDigestFields;
  if (kind.name == "Gap") return kGapFields;
  return record_named(kind.name == "StartingPoint" ? "ModelStatus" : kind.name)->fields;
}

// Fields beyond `bytes` are left out: the video of a sweep.
std::vector<RecordedField> described(std::span<const RecordField> fields, std::size_t bytes) {
  std::vector<RecordedField> list;
  for (const RecordField& field : fields) {
    if (field.offset + field.size > bytes) continue;
    RecordedField one{std::string(field.name), std::string(field.type), field.offset, field.size,
                      std::string(field.unit)};
    const std::string_view base = field.type.substr(0, field.type.find('['));
    if (const RecordFields* const record = record_named(base)) one.fields = described(record->fields, record->size);
    list.push_back(std::move(one));
  }
  return list;
}

const RecordedKind& kind_named(std::string_view name) {
  std::string names;
  for (const RecordedKind& kind : recording::recorded_kinds()) {
    if (kind.name == name) return kind;
    names += (names.empty() ? "" : ", ") + std::string(kind.name);
  }
  radar::fail(error::usage_error("kind", "one of " + names, '\'' + std::string(name) + '\''));
}

// Bytes of an item, if it is of this kind.
std::optional<recording::RecordParts> parts_of(const recording::RecordingItem& item, std::uint8_t number) {
  return std::visit(
      [number](const auto& record) -> std::optional<recording::RecordParts> {
        using Record = std::decay_t<decltype(record)>;
        if (recording::kKindOf<Record>.number != number) return std::nullopt;
        return recording::parts_of(record);
      },
      item);
}

// Tick of an item; nullopt: it has none of its own.
std::optional<std::int64_t> tick_of(const recording::RecordingItem& item) {
  if (const auto* const change = std::get_if<recording::StateChange>(&item)) return change->state.tick;
  return std::visit([](const auto& record) { return recording::tick_of(record); }, item);
}

// Whether a block may have records of this kind in this range. A radar state may be older than its block. Damaged bytes
// without a head have kinds = 0, and are read to be missed.
bool may_have(const recording::IndexEntry& block, const RecordedKind& kind, const TickRange& ticks) {
  const bool apart = (ticks.first && block.last_tick < *ticks.first) || (ticks.last && block.first_tick > *ticks.last);
  if (block.kinds != 0 && (block.kinds >> kind.number & 1U) == 0) return false;
  return !apart || kind.number == recording::kKindOf<recording::StateChange>.number;
}

void collect(Records& to, recording::BlockItems& items, std::int64_t first_tick, const RecordedKind& kind,
             const TickRange& ticks, bool with_tails) {
  std::int64_t now = first_tick;
  while (const auto item = items.next()) {
    now = tick_of(*item).value_or(now);
    const auto parts = parts_of(*item, kind.number);
    if (!parts || !ticks.contains(now)) continue;
    to.bytes.insert(to.bytes.end(), parts->fixed.begin(), parts->fixed.end());
    if (!with_tails) continue;
    to.tails.insert(to.tails.end(), parts->tail.begin(), parts->tail.end());
    to.tail_bytes.push_back(parts->tail.size());
  }
}

// Ticks of damaged blocks, "3 to 9, 20 to 31". Blocks of several runs may have the same ticks, which are named once.
std::string ticks_text(const std::vector<recording::IndexEntry>& blocks) {
  std::map<std::int64_t, std::int64_t> ranges;
  for (const recording::IndexEntry& block : blocks) {
    auto& last = ranges.try_emplace(block.first_tick, block.last_tick).first->second;
    last = std::max(last, block.last_tick);
  }
  std::string ticks;
  for (auto at = ranges.begin(); at != ranges.end();) {
    const std::int64_t first = at->first;
    std::int64_t last = at->second;
    for (++at; at != ranges.end() && at->first <= last + 1; ++at) last = std::max(last, at->second);
    ticks += (ticks.empty() ? "" : ", ") + std::to_string(first) + " to " + std::to_string(last);
  }
  return ticks;
}

}  // namespace

Expected<Recording> Recording::open(const std::string& path, const Call& call) {
  return radar::guarded([&] {
    auto reader = recording::RecordingReader::open(path);
    if (!reader) radar::fail(reader.error());
    auto parts = std::make_unique<Parts>(Parts{path, std::move(*reader), 0, {}, {}, 0});
    for (const recording::IndexEntry& block : parts->reader.blocks()) {
      parts->kind_bits |= block.kinds;
      parts->first_tick = std::min(parts->first_tick.value_or(block.first_tick), block.first_tick);
      parts->last_tick = std::max(parts->last_tick.value_or(block.last_tick), block.last_tick);
    }
    if (parts->reader.cut_short()) radar::warn_of(call)(path + ": cut short; it is read to its last whole block");
    return Recording(std::move(parts));
  });
}

Recording::Recording(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
Recording::Recording(Recording&&) noexcept = default;
Recording& Recording::operator=(Recording&&) noexcept = default;
Recording::~Recording() = default;

std::vector<std::string> Recording::all_kinds() {
  std::vector<std::string> names;
  for (const RecordedKind& kind : recording::recorded_kinds()) names.emplace_back(kind.name);
  return names;
}

Expected<std::vector<RecordedField>> Recording::fields_of(const std::string& kind) {
  return radar::guarded([&] {
    const RecordedKind& found = kind_named(kind);
    return described(raw_fields(found), found.bytes);
  });
}

const std::string& Recording::configuration() const {
  return parts_->reader.header().configuration;
}
const std::string& Recording::terrain() const {
  return parts_->reader.header().terrain;
}
std::optional<std::int64_t> Recording::first_tick() const {
  return parts_->first_tick;
}
std::optional<std::int64_t> Recording::last_tick() const {
  return parts_->last_tick;
}
bool Recording::cut_short() const {
  return parts_->reader.cut_short();
}

std::vector<std::string> Recording::kinds() const {
  std::vector<std::string> names;
  for (const RecordedKind& kind : recording::recorded_kinds())
    if ((parts_->kind_bits >> kind.number & 1U) != 0) names.emplace_back(kind.name);
  return names;
}

Expected<Records> Recording::records(const std::string& name, const TickRange& ticks, bool with_tails,
                                     const Call& call) {
  return radar::guarded([&] {
    const RecordedKind& kind = kind_named(name);
    recording::RecordingReader& reader = parts_->reader;
    Records records;
    records.record_bytes = kind.bytes;
    const auto blocks = reader.blocks();
    for (std::size_t number = 0; number < blocks.size(); ++number) {
      parallel::check(call.goes_on);
      if (!may_have(blocks[number], kind, ticks)) continue;
      if (auto items = reader.items_of(number))
        collect(records, *items, blocks[number].first_tick, kind, ticks, with_tails);
      if (call.progress) call.progress("blocks", static_cast<double>(number + 1) / static_cast<double>(blocks.size()));
    }
    const auto& missing = reader.missing();
    if (missing.size() > parts_->told)
      radar::warn_of(call)(parts_->path + ": expected undamaged blocks, found " + std::to_string(missing.size()) +
                           " damaged; missing ticks: " + ticks_text(missing) + "; the rest is read");
    parts_->told = missing.size();
    return records;
  });
}

}  // namespace yars
