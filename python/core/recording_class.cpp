#include "python/core/recording_class.hpp"

#include <pybind11/stl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>
#include <vector>

namespace yars::python {

namespace {

py::object dtype_of(const std::vector<RecordedField>& fields, std::size_t bytes);

// Lengths of the axes of a field's type: "char[21][8]" has 21 and 8.
std::vector<std::size_t> lengths_of(const std::string& type) {
  std::vector<std::size_t> lengths;
  for (std::size_t at = type.find('['); at != std::string::npos; at = type.find('[', at + 1))
    lengths.push_back(std::stoul(type.substr(at + 1)));
  return lengths;
}

// Type of one entry of a field in NumPy's words, and the lengths of its axes. A text is one entry.
py::object dtype_of(const RecordedField& field) {
  std::vector<std::size_t> lengths = lengths_of(field.type);
  const std::string base = field.type.substr(0, field.type.find('['));
  py::object type;
  if (base == "char") {
    type = py::str("S" + std::to_string(lengths.back()));
    lengths.pop_back();
  } else if (!field.fields.empty()) {
    std::size_t entries = 1;
    for (const std::size_t length : lengths) entries *= length;
    type = dtype_of(field.fields, field.bytes / entries);
  } else {
    type = py::str(base == "double" ? "float64" : base == "float" ? "float32" : base);
  }
  if (lengths.empty()) return type;
  return py::make_tuple(type, py::tuple(py::cast(lengths)));
}

// Structured type with the offsets of the record.
py::object dtype_of(const std::vector<RecordedField>& fields, std::size_t bytes) {
  py::list names, formats, offsets;
  for (const RecordedField& field : fields) {
    names.append(field.name);
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

void add_units(py::dict& units, const std::string& before, const std::vector<RecordedField>& fields) {
  for (const RecordedField& field : fields) {
    const std::string name = before + field.name;
    if (field.fields.empty())
      units[name.c_str()] = field.unit;
    else
      add_units(units, name + '.', field.fields);
  }
}

py::array structured(py::object type, std::vector<std::byte> bytes, std::size_t size) {
  const auto count = static_cast<py::ssize_t>(bytes.size() / size);
  auto* const kept = new std::vector<std::byte>(std::move(bytes));
  const py::capsule keeper(kept, [](void* pointer) { delete static_cast<std::vector<std::byte>*>(pointer); });
  return read_only(py::array(py::reinterpret_steal<py::dtype>(type.release()), {count},
                             {static_cast<py::ssize_t>(size)}, kept->data(), keeper));
}

// The structured array of records; takes their bytes.
py::array array_of_records(const std::string& kind, Records& records) {
  return structured(dtype_of(value_of(yars::Recording::fields_of(kind)), records.record_bytes),
                    std::move(records.bytes), records.record_bytes);
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

Recording::Recording(const std::string& path) : path_(path) {
  Warnings warnings;
  without_interpreter([&](const parallel::GoesOn& goes_on) { open(warnings, goes_on); });
  warnings.show("yars.Recording", 3);
}

void Recording::open(Warnings& warnings, const parallel::GoesOn& goes_on) {
  if (process_ == ::getpid() && recording_) return;
  static_cast<void>(recording_.release());  // of a parent, or none
  recording_ = std::make_unique<yars::Recording>(value_of(yars::Recording::open(path_, warnings.call(goes_on))));
  process_ = ::getpid();
}

py::dict Recording::header() const {
  py::dict header;
  header["configuration"] = recording_->configuration();
  header["terrain"] = recording_->terrain();
  return header;
}

Records Recording::read(const std::string& kind, const TickRange& ticks, bool with_tails) {
  Warnings warnings;
  Records records;
  without_interpreter([&](const parallel::GoesOn& goes_on) {
    const auto taken = lock_.take(goes_on);
    Warnings known;  // that the file is cut short
    open(known, {});
    records = value_of(recording_->records(kind, ticks, with_tails, {.warn = warnings.sink()}));
  });
  warnings.show("yars.Recording");
  return records;
}

py::array Recording::records(const std::string& kind, const TickRange& ticks) {
  Records records = read(kind, ticks, false);
  return array_of_records(kind, records);
}

py::dict Recording::units(const std::string& kind) {
  py::dict units;
  add_units(units, "", value_of(yars::Recording::fields_of(kind)));
  return units;
}

py::tuple Recording::sweeps(const TickRange& ticks) {
  Records records = read("Sweep", ticks, true);
  py::array headers = array_of_records("Sweep", records);
  return py::make_tuple(std::move(headers), rows_of(std::move(records.tails), records.tail_bytes));
}

py::tuple Recording::maps(const TickRange& ticks) {
  Records records = read("PatchMap", ticks, true);
  py::array headers = array_of_records("PatchMap", records);
  auto owner = std::make_shared<std::vector<std::byte>>(std::move(records.tails));
  py::list pictures;
  std::size_t at = 0;
  for (const std::size_t bytes : records.tail_bytes) {
    const auto size = static_cast<py::ssize_t>(std::lround(std::sqrt(bytes)));
    pictures.append(
        array_of<std::uint8_t>(owner, reinterpret_cast<const std::uint8_t*>(owner->data()) + at, {size, size}));
    at += bytes;
  }
  return py::make_tuple(std::move(headers), std::move(pictures));
}

void add_recording(py::module_& module) {
  using Tick = std::optional<std::int64_t>;
  py::class_<Recording> recording(module, "Recording");
  recording.def_property_readonly("header", &Recording::header)
      .def_property_readonly("kinds", [](const Recording& self) { return self.recording().kinds(); })
      .def_property_readonly("first_tick", [](const Recording& self) { return self.recording().first_tick(); })
      .def_property_readonly("last_tick", [](const Recording& self) { return self.recording().last_tick(); })
      .def_property_readonly("cut_short", [](const Recording& self) { return self.recording().cut_short(); })
      .def("records", [](Recording& self, const std::string& kind, Tick first,
                         Tick last) { return self.records(kind, {first, last}); })
      .def("sweeps", [](Recording& self, Tick first, Tick last) { return self.sweeps({first, last}); })
      .def("maps", [](Recording& self, Tick first, Tick last) { return self.maps({first, last}); });
  seal(recording);
  module.def("open_recording", [](const std::string& path) { return std::make_unique<Recording>(path); });
  module.def("units_of", &Recording::units, py::arg("kind"));
}

}  // namespace yars::python
