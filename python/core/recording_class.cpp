#include "python/core/recording_class.hpp"

#include <pybind11/stl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <string_view>
#include <utility>
#include <variant>

#include "databuffer/messages/record_fields.hpp"
#include "tools/command/command.hpp"

namespace yars::python {

namespace {

namespace rec = tools::recording;
using databuffer::RecordField;
using databuffer::RecordFields;

const RecordFields* fields_of(std::string_view record) {
  const auto all = databuffer::record_fields();
  const auto found = std::ranges::find(all, record, &RecordFields::record);
  return found == all.end() ? nullptr : &*found;
}

// Kinds that records.idl does not describe (recorded_kinds.hpp).
constexpr RecordField kDigestFields[] = {
    {"tick", offsetof(rec::SweepDigest, tick), 8, "int64", "tick", 0, 0},
    {"hash", offsetof(rec::SweepDigest, hash), 8, "uint64", "", 0, 0},
    {"epoch", offsetof(rec::SweepDigest, epoch), 4, "uint32", "", 0, 0},
    {"number", offsetof(rec::SweepDigest, number), 4, "uint32", "", 0, 0},
    {"flags", offsetof(rec::SweepDigest, flags), 4, "uint32", "", 0, 0},
};
constexpr RecordField kGapFields[] = {
    {"ticks", offsetof(rec::Gap, ticks), 8, "uint64", "", 0, 0},
    {"events", offsetof(rec::Gap, events), 8, "uint64", "", 0, 0},
    {"sweeps", offsetof(rec::Gap, sweeps), 8, "uint64", "", 0, 0},
};

// Fields of a kind's fixed part.
std::span<const RecordField> fields_of(const rec::RecordedKind& kind) {
  if (kind.name == "SweepDigest") return kDigestFields;
  if (kind.name == "Gap") return kGapFields;
  return fields_of(kind.name == "StartingPoint" ? "ModelStatus" : kind.name)->fields;
}

// A field's type, taken apart: "char[21][8]" has the base char and the lengths 21 and 8.
struct FieldType {
  std::string base;
  std::vector<std::size_t> lengths;
};
FieldType taken_apart(std::string_view type) {
  FieldType parts;
  parts.base = type.substr(0, type.find('['));
  for (std::size_t at = type.find('['); at != std::string_view::npos; at = type.find('[', at + 1))
    parts.lengths.push_back(std::stoul(std::string(type.substr(at + 1))));
  return parts;
}

py::object dtype_of(std::span<const RecordField> fields, std::size_t bytes);

// Type of one entry of a field in NumPy's words, and the lengths of its axes. A text is one entry.
py::object dtype_of(const RecordField& field) {
  FieldType type = taken_apart(field.type);
  py::object base;
  if (type.base == "char") {
    base = py::str("S" + std::to_string(type.lengths.back()));
    type.lengths.pop_back();
  } else if (const RecordFields* const record = fields_of(type.base)) {
    base = dtype_of(record->fields, record->size);
  } else {
    base = py::str(type.base == "double" ? "float64" : type.base == "float" ? "float32" : type.base);
  }
  if (type.lengths.empty()) return base;
  return py::make_tuple(base, py::tuple(py::cast(type.lengths)));
}

// Structured type with the offsets of the record. Fields beyond `bytes` are left out: the video of a sweep.
py::object dtype_of(std::span<const RecordField> fields, std::size_t bytes) {
  py::list names, formats, offsets;
  for (const RecordField& field : fields) {
    if (field.offset + field.size > bytes) continue;
    names.append(std::string(field.name));
    formats.append(dtype_of(field));
    offsets.append(field.offset);
  }
  py::dict parts;
  parts["names"] = names;
  parts["formats"] = formats;
  parts["offsets"] = offsets;
  parts["itemsize"] = bytes;
  return py::module_::import("numpy").attr("dtype")(parts);
}

void add_units(py::dict& units, const std::string& before, std::span<const RecordField> fields, std::size_t bytes) {
  for (const RecordField& field : fields) {
    if (field.offset + field.size > bytes) continue;
    const std::string name = before + std::string(field.name);
    if (const RecordFields* const record = fields_of(taken_apart(field.type).base))
      add_units(units, name + '.', record->fields, record->size);
    else
      units[name.c_str()] = std::string(field.unit);
  }
}

const rec::RecordedKind& kind_of(std::string_view name) {
  std::string names;
  for (const rec::RecordedKind& kind : rec::recorded_kinds()) {
    if (kind.name == name) return kind;
    names += (names.empty() ? "" : ", ") + std::string(kind.name);
  }
  raise_value_error("yars.Recording: kind: expected one of " + names + ", found '" + std::string(name) + "'");
}

// Bytes of an item, if it is of this kind.
std::optional<rec::RecordParts> parts_of(const rec::RecordingItem& item, std::uint8_t number) {
  return std::visit(
      [number](const auto& record) -> std::optional<rec::RecordParts> {
        using Record = std::decay_t<decltype(record)>;
        if (rec::kKindOf<Record>.number != number) return std::nullopt;
        return rec::parts_of(record);
      },
      item);
}

// Tick of an item; nullopt: it has none of its own.
std::optional<std::int64_t> tick_of(const rec::RecordingItem& item) {
  if (const auto* const change = std::get_if<rec::StateChange>(&item)) return change->state.tick;
  return std::visit([](const auto& record) { return rec::tick_of(record); }, item);
}

py::array structured(py::object type, std::vector<std::byte> bytes, std::size_t size) {
  const auto count = static_cast<py::ssize_t>(bytes.size() / size);
  auto* const kept = new std::vector<std::byte>(std::move(bytes));
  const py::capsule keeper(kept, [](void* pointer) { delete static_cast<std::vector<std::byte>*>(pointer); });
  return read_only(py::array(py::reinterpret_steal<py::dtype>(type.release()), {count},
                             {static_cast<py::ssize_t>(size)}, kept->data(), keeper));
}

// Rows of equal length from tails one after the other, filled up with 0.
py::array rows_of(std::vector<std::byte> tails, const std::vector<std::size_t>& lengths) {
  const std::size_t width = lengths.empty() ? 0 : *std::ranges::max_element(lengths);
  std::vector<std::uint8_t> rows;
  if (tails.size() == width * lengths.size()) {
    auto owner = std::make_shared<std::vector<std::byte>>(std::move(tails));
    return array_of<std::uint8_t>(owner, reinterpret_cast<const std::uint8_t*>(owner->data()),
                                  {static_cast<py::ssize_t>(lengths.size()), static_cast<py::ssize_t>(width)});
  }
  rows.assign(width * lengths.size(), 0);
  std::size_t from = 0;
  for (std::size_t row = 0; row < lengths.size(); from += lengths[row++])
    std::memcpy(rows.data() + row * width, tails.data() + from, lengths[row]);
  return array_from(std::move(rows), {static_cast<py::ssize_t>(lengths.size()), static_cast<py::ssize_t>(width)});
}

}  // namespace

void Recording::open() {
  if (process_ == ::getpid() && *reader_) return;
  auto opened = rec::RecordingReader::open(path_);
  if (!opened) raise(opened.error());
  reader_->emplace(std::move(*opened));
  process_ = ::getpid();
}

Recording::Recording(const std::string& path) : path_(path) {
  without_interpreter([this](const parallel::GoesOn&) { open(); });
  cut_short_ = reader().cut_short();
  header_ = reader().header();
  for (const rec::IndexEntry& block : reader().blocks()) {
    kind_bits_ |= block.kinds;
    first_tick_ = std::min(first_tick_.value_or(block.first_tick), block.first_tick);
    last_tick_ = std::max(last_tick_.value_or(block.last_tick), block.last_tick);
  }
  if (!cut_short_) return;
  Warnings warnings;
  warnings.sink()(path_ + ": cut short; it is read to its last whole block");
  warnings.show("yars.Recording", 3);
}

py::dict Recording::header() const {
  py::dict header;
  header["configuration"] = header_.configuration;
  header["terrain"] = header_.terrain;
  return header;
}

py::list Recording::kinds() const {
  py::list names;
  for (const rec::RecordedKind& kind : rec::recorded_kinds())
    if ((kind_bits_ >> kind.number & 1U) != 0) names.append(std::string(kind.name));
  return names;
}

Recording::Collected Recording::collect(const rec::RecordedKind& kind, const TickRange& ticks, bool with_tails) {
  Collected collected;
  without_interpreter([&](const parallel::GoesOn& goes_on) {
    const auto taken = lock_.take(goes_on);
    open();
    const auto blocks = reader().blocks();
    for (std::size_t number = 0; number < blocks.size(); ++number) {
      const rec::IndexEntry& block = blocks[number];
      // A radar state may be older than its block. Damaged bytes without a head have kinds = 0, and are read to be
      // missed.
      const bool apart =
          (ticks.first && block.last_tick < *ticks.first) || (ticks.last && block.first_tick > *ticks.last);
      if (block.kinds != 0 && (block.kinds >> kind.number & 1U) == 0) continue;
      if (apart && kind.number != rec::kKindOf<rec::StateChange>.number) continue;
      auto items = reader().items_of(number);
      if (!items) continue;
      std::int64_t now = block.first_tick;
      while (const auto item = items->next()) {
        now = tick_of(*item).value_or(now);
        const auto parts = parts_of(*item, kind.number);
        if (!parts || !ticks.contains(now)) continue;
        collected.fixed.insert(collected.fixed.end(), parts->fixed.begin(), parts->fixed.end());
        if (!with_tails) continue;
        collected.tails.insert(collected.tails.end(), parts->tail.begin(), parts->tail.end());
        collected.tail_bytes.push_back(parts->tail.size());
      }
    }
  });
  return collected;
}

void Recording::show_damage() {
  Warnings warnings;
  without_interpreter([&](const parallel::GoesOn& goes_on) {
    const auto taken = lock_.take(goes_on);
    const auto& missing = reader().missing();
    if (missing.size() > shown_) {
      // Blocks of several runs may have the same ticks, which are named once.
      std::map<std::int64_t, std::int64_t> ranges;
      for (const rec::IndexEntry& block : missing) {
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
      warnings.sink()(path_ + ": expected undamaged blocks, found " + std::to_string(missing.size()) +
                      " damaged; missing ticks: " + ticks + "; the rest is read");
    }
    shown_ = missing.size();
  });
  warnings.show("yars.Recording");
}

py::array Recording::records(const std::string& name, const TickRange& ticks) {
  const rec::RecordedKind& kind = kind_of(name);
  py::object type = dtype_of(fields_of(kind), kind.bytes);
  Collected collected = collect(kind, ticks, false);
  show_damage();
  return structured(std::move(type), std::move(collected.fixed), kind.bytes);
}

py::dict Recording::units(const std::string& name) {
  const rec::RecordedKind& kind = kind_of(name);
  py::dict units;
  add_units(units, "", fields_of(kind), kind.bytes);
  return units;
}

py::tuple Recording::sweeps(const TickRange& ticks) {
  const rec::RecordedKind& kind = kind_of("Sweep");
  Collected collected = collect(kind, ticks, true);
  show_damage();
  py::array headers = structured(dtype_of(fields_of(kind), kind.bytes), std::move(collected.fixed), kind.bytes);
  return py::make_tuple(std::move(headers), rows_of(std::move(collected.tails), collected.tail_bytes));
}

py::tuple Recording::maps(const TickRange& ticks) {
  const rec::RecordedKind& kind = kind_of("PatchMap");
  Collected collected = collect(kind, ticks, true);
  show_damage();
  py::array headers = structured(dtype_of(fields_of(kind), kind.bytes), std::move(collected.fixed), kind.bytes);
  auto owner = std::make_shared<std::vector<std::byte>>(std::move(collected.tails));
  py::list pictures;
  std::size_t at = 0;
  for (std::size_t map = 0; map < collected.tail_bytes.size(); at += collected.tail_bytes[map++]) {
    const auto size = static_cast<py::ssize_t>(std::lround(std::sqrt(collected.tail_bytes[map])));
    pictures.append(
        array_of<std::uint8_t>(owner, reinterpret_cast<const std::uint8_t*>(owner->data()) + at, {size, size}));
  }
  return py::make_tuple(std::move(headers), std::move(pictures));
}

void add_recording(py::module_& module) {
  using Tick = std::optional<std::int64_t>;
  py::class_<Recording> recording(module, "Recording");
  recording.def_property_readonly("header", &Recording::header)
      .def_property_readonly("kinds", &Recording::kinds)
      .def_property_readonly("first_tick", &Recording::first_tick)
      .def_property_readonly("last_tick", &Recording::last_tick)
      .def_property_readonly("cut_short", &Recording::cut_short)
      .def("records", [](Recording& self, const std::string& kind, Tick first,
                         Tick last) { return self.records(kind, {first, last}); })
      .def("sweeps", [](Recording& self, Tick first, Tick last) { return self.sweeps({first, last}); })
      .def("maps", [](Recording& self, Tick first, Tick last) { return self.maps({first, last}); });
  seal(recording);
  module.def("open_recording", [](const std::string& path) { return std::make_unique<Recording>(path); });
  module.def("units_of", &Recording::units, py::arg("kind"));
}

}  // namespace yars::python
