#include "python/core/patch_series.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <initializer_list>
#include <limits>
#include <optional>
#include <utility>

#include "lib/geo/geodesy.hpp"
#include "lib/radar/fidelity.hpp"
#include "lib/values/fields.hpp"
#include "python/core/results.hpp"
#include "radar/limits.hpp"
#include "radar/private_data.hpp"

namespace yars::python {

namespace {

// Entries of the structured arrays. Their fields are named in order below, for Python.
struct Order {
  double latitude, longitude, altitude_ft, heading, speed_kt, target_latitude, target_longitude, window_nm, time_s;
  std::int32_t looks;
  std::uint32_t map;
};
struct MoverEntry {
  std::int64_t order;
  double latitude, longitude, heading, speed_kt, cross_section_m2, height_m;
};
const char* const kArrays = "video, power, shadow, layover, object, material, height, grazing_angle";

// Structured type of an array, from names and type codes of its fields.
py::dtype dtype_of(const std::vector<std::pair<const char*, const char*>>& fields) {
  py::list list;
  for (const auto& [name, code] : fields) list.append(py::make_tuple(name, code));
  return py::dtype::from_args(list);
}
py::dtype order_type() {
  return dtype_of({{"latitude", "<f8"},
                   {"longitude", "<f8"},
                   {"altitude_ft", "<f8"},
                   {"heading", "<f8"},
                   {"speed_kt", "<f8"},
                   {"target_latitude", "<f8"},
                   {"target_longitude", "<f8"},
                   {"window_nm", "<f8"},
                   {"time_s", "<f8"},
                   {"looks", "<i4"},
                   {"map", "<u4"}});
}
py::dtype mover_type() {
  return dtype_of({{"order", "<i8"},
                   {"latitude", "<f8"},
                   {"longitude", "<f8"},
                   {"heading", "<f8"},
                   {"speed_kt", "<f8"},
                   {"cross_section_m2", "<f8"},
                   {"height_m", "<f8"}});
}
py::dtype geo_type() {
  return dtype_of({{"origin_latitude", "<f8"},
                   {"origin_longitude", "<f8"},
                   {"plane_from_pixel", "6<f8"},
                   {"up_deg", "<f8"},
                   {"distance_m", "<f8"},
                   {"slant_range_m", "<f8"},
                   {"grazing_deg", "<f8"},
                   {"plane_msl_m", "<f8"},
                   {"window_m", "<f8"},
                   {"resolution_m", "<f8"}});
}
py::dtype box_type() {
  const auto list = [](const auto&... entries) {
    py::list items;
    (items.append(entries), ...);
    return items;
  };
  return {list("order", "object", "pixels", "aspect_deg", "corners"), list("<i8", "<i4", "<i4", "<f4", "(4,2)<f4"),
          list(offsetof(Box, order), offsetof(Box, object), offsetof(Box, pixels), offsetof(Box, aspect_deg),
               offsetof(Box, corners)),
          sizeof(Box)};
}

std::string text_of(const py::dtype& type) {
  return py::cast<std::string>(py::str(py::handle(type)));
}

// Entries of a structured array of this type. Throws ValueError for another type.
template <class Entry>
std::vector<Entry> entries_of(const py::array& given, const py::dtype& type, const char* name) {
  if (!py::cast<bool>(given.dtype().attr("__eq__")(type)) || given.ndim() != 1)
    raise(error::usage_error(name, "an array of one axis of the type " + text_of(type),
                             std::to_string(given.ndim()) + " axes of " + text_of(given.dtype())));
  const py::array whole = py::module_::import("numpy").attr("ascontiguousarray")(given);
  std::vector<Entry> entries(static_cast<std::size_t>(whole.size()));
  YARS_REQUIRE(static_cast<std::size_t>(whole.itemsize()), ==, sizeof(Entry));
  std::memcpy(entries.data(), whole.data(), entries.size() * sizeof(Entry));
  return entries;
}

// The arrays that are asked for, with the memory of their entries.
struct Outputs {
  py::dict arrays;
  std::uint8_t *video = nullptr, *shadow = nullptr, *layover = nullptr, *material = nullptr;
  float *power = nullptr, *height = nullptr, *grazing = nullptr;
  std::int16_t* object = nullptr;          // if all indices fit
  std::int32_t* object_of_many = nullptr;  // if not

  bool objects() const { return object != nullptr || object_of_many != nullptr; }
  LabelUse labels() const {
    if (height != nullptr || grazing != nullptr) return LabelUse::heights;
    return shadow != nullptr || layover != nullptr || material != nullptr || objects() ? LabelUse::surfaces
                                                                                       : LabelUse::none;
  }
};

Outputs make_outputs(const SeriesRequest& request, std::size_t count, int size) {
  const bool few_objects =
      request.scene && request.scene->scene().objects().size() <= std::size_t{std::numeric_limits<std::int16_t>::max()};
  Outputs outputs;
  const std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(count), size, size};
  const auto make = [&](const std::string& name, auto*& data) {
    using Number = std::remove_reference_t<decltype(*data)>;
    py::array_t<Number> array(shape);
    data = array.mutable_data();
    outputs.arrays[name.c_str()] = std::move(array);
  };
  for (const std::string& name : request.arrays) {
    if (name == "video")
      make(name, outputs.video);
    else if (name == "power")
      make(name, outputs.power);
    else if (name == "shadow")
      make(name, outputs.shadow);
    else if (name == "layover")
      make(name, outputs.layover);
    else if (name == "object" && few_objects)
      make(name, outputs.object);
    else if (name == "object")
      make(name, outputs.object_of_many);
    else if (name == "material")
      make(name, outputs.material);
    else if (name == "height")
      make(name, outputs.height);
    else if (name == "grazing_angle")
      make(name, outputs.grazing);
    else
      raise(error::usage_error("arrays", kArrays, "'" + name + "'"));
  }
  return outputs;
}

// A number of an entry, with the field that it becomes.
struct Number {
  const char* name;  // of the entry's field
  const values::Field& field;
  double value;
};

// Throws ValueError that names the first number beyond its field's limits. `entry`: such as "orders[3]".
void check_numbers(const std::string& entry, std::initializer_list<Number> numbers) {
  for (const Number& number : numbers)
    if (!number.field.contains(number.value))
      radar::fail(radar::beyond_field(entry + ": " + number.name, number.field, number.value));
}

PatchRequest request_of(const std::string& entry, const Order& order, bool force) {
  using Of = values::PatchRequest;
  check_numbers(entry, {{"latitude", Of::latitude, order.latitude},
                        {"longitude", Of::longitude, order.longitude},
                        {"altitude_ft", Of::altitude, order.altitude_ft},
                        {"heading", Of::heading, order.heading},
                        {"speed_kt", Of::speed, order.speed_kt},
                        {"target_latitude", Of::target_latitude, order.target_latitude},
                        {"target_longitude", Of::target_longitude, order.target_longitude},
                        {"window_nm", Of::window, order.window_nm},
                        {"time_s", Of::time, order.time_s},
                        {"looks", Of::looks, static_cast<double>(order.looks)}});
  PatchRequest request;
  request.latitude_deg = order.latitude;
  request.longitude_deg = order.longitude;
  request.altitude_ft = order.altitude_ft;
  request.heading_deg = order.heading;
  request.speed_kt = order.speed_kt;
  request.target_latitude_deg = order.target_latitude;
  request.target_longitude_deg = order.target_longitude;
  request.window_nm = order.window_nm;
  request.time_s = order.time_s;
  request.looks = order.looks;
  request.map = order.map;
  request.force = force;
  return request;
}

// Movers of each order.
std::vector<std::vector<Mover>> movers_of(const py::object& given, std::size_t orders) {
  std::vector<std::vector<Mover>> movers(orders);
  if (given.is_none()) return movers;
  const auto all = entries_of<MoverEntry>(py::cast<py::array>(given), mover_type(), "movers");
  if (orders == 0 && !all.empty()) raise(error::usage_error("movers", "none without an order", "some"));
  for (std::size_t i = 0; i < all.size(); ++i) {
    const MoverEntry& mover = all[i];
    const std::string entry = "movers[" + std::to_string(i) + "]";
    const values::Field order{"order", "order", "", "", 0.0, static_cast<double>(orders - 1), "", ""};
    check_numbers(entry, {{"order", order, static_cast<double>(mover.order)},
                          {"latitude", values::WorldMover::latitude, mover.latitude},
                          {"longitude", values::WorldMover::longitude, mover.longitude},
                          {"heading", values::WorldMover::heading, mover.heading},
                          {"speed_kt", values::WorldMover::speed, mover.speed_kt},
                          {"cross_section_m2", values::TrafficEntity::cross_section, mover.cross_section_m2},
                          {"height_m", values::TrafficEntity::height, mover.height_m}});
    movers[static_cast<std::size_t>(mover.order)].push_back(
        {mover.latitude, mover.longitude, mover.heading, mover.speed_kt, mover.cross_section_m2, mover.height_m});
  }
  return movers;
}

// Moves or copies the result of one map to entry `index` of the outputs.
void store(const Patch& patch, std::size_t index, const Outputs& outputs) {
  const std::size_t at = index * patch.video().size();
  const PatchLabels labels = patch.labels();
  const auto copy = [&](const auto& from, auto* to) {
    if (to != nullptr) std::copy(from.begin(), from.end(), to + at);
  };
  copy(patch.video(), outputs.video);
  copy(labels.shadow, outputs.shadow);
  copy(labels.layover, outputs.layover);
  if (outputs.object != nullptr)
    std::transform(labels.object.begin(), labels.object.end(), outputs.object + at,
                   [](std::int32_t object) { return static_cast<std::int16_t>(object); });
  copy(labels.object, outputs.object_of_many);
  copy(labels.material, outputs.material);
  copy(labels.height_m, outputs.height);
  if (outputs.power != nullptr)
    std::transform(patch.power().begin(), patch.power().end(), outputs.power + at,
                   [](float power) { return power < 0.0F ? std::numeric_limits<float>::quiet_NaN() : power; });
  if (outputs.grazing != nullptr)
    std::transform(labels.sin_grazing.begin(), labels.sin_grazing.end(), outputs.grazing + at,
                   [](float sine) { return std::asin(sine) / static_cast<float>(geo::kRadiansPerDegree); });
}

py::array structured(const py::dtype& type, const void* data, std::size_t count) {
  return py::array(type, {static_cast<py::ssize_t>(count)}, data);
}

// Maps of a series, one after the other, on the threads of the request.
class Series {
 public:
  Series(const yars::Radar& radar, std::unique_ptr<Patch> patch, const SeriesRequest& request, const Outputs& outputs)
      : radar_(radar), request_(request), outputs_(outputs), patch_(std::move(patch)) {
    if (request.scene && outputs.objects())
      boxes_.emplace(request.scene->scene(), radar.map_size(), request.min_pixels);
  }

  // Forms map `index`. Throws an error that names the index.
  void form(std::size_t index, const Order& order, const std::vector<Mover>& movers, const parallel::GoesOn& goes_on) {
    const std::string entry = "orders[" + std::to_string(index) + "]";
    PatchRequest request = request_of(entry, order, request_.force);
    request.threads = request_.threads;
    const PatchSubject subject{request_.scene ? &request_.scene->scene() : nullptr, movers, outputs_.labels()};
    const yars::Terrain& terrain = request_.terrain->terrain();
    Expected<void> done;
    if (patch_) {
      done = patch_->prepare_next(terrain, request, subject, warnings_.call(goes_on));
    } else if (auto made = Patch::prepare(radar_, terrain, request, subject, warnings_.call(goes_on))) {
      patch_ = std::make_unique<Patch>(std::move(*made));
    } else {
      done = tl::unexpected(made.error());
    }
    if (!done) {
      Error error = done.error();
      error.subject = entry + (error.subject.empty() ? "" : ": " + error.subject);
      raise(error);
    }
    check_done(patch_->run({.goes_on = goes_on}));
    store(*patch_, index, outputs_);
    hashes_.push_back(patch_->hash());
    geometries_.push_back(geo_of(patch_->facts()));
    if (boxes_) boxes_->add(static_cast<std::int64_t>(index), *patch_->work().geometry, patch_->labels().object);
  }

  // Adds geometry, boxes and hashes to the arrays. Call it with the interpreter's lock.
  py::dict finish() {
    warnings_.show("yars.Radar.patches");
    py::dict arrays = outputs_.arrays;
    const std::vector<Box> none;
    const std::vector<Box>& boxes = boxes_ ? boxes_->boxes() : none;
    const std::size_t count = hashes_.size();
    arrays["geo"] = structured(geo_type(), geometries_.data(), count);
    arrays["boxes"] = structured(box_type(), boxes.data(), boxes.size());
    arrays["hash"] = py::array_t<std::uint64_t>(static_cast<py::ssize_t>(count), hashes_.data());
    return arrays;
  }

  std::unique_ptr<Patch> take_patch() { return std::move(patch_); }

 private:
  const yars::Radar& radar_;
  const SeriesRequest& request_;
  const Outputs& outputs_;
  std::unique_ptr<Patch> patch_;  // null before the first map
  std::optional<Boxes> boxes_;
  std::vector<std::uint64_t> hashes_;
  std::vector<Geo> geometries_;
  Warnings warnings_;
};

}  // namespace

// Releases the Patches without destroying them: their destructors would wait for threads that only the parent has.
void PatchPool::forget_those_of_the_parent() {
  if (process_ == ::getpid()) return;
  for (Free& one : free_) static_cast<void>(one.patch.release());
  free_.clear();
  process_ = ::getpid();
}

std::unique_ptr<Patch> PatchPool::take(std::size_t threads, LabelUse labels) {
  const std::lock_guard guard(mutex_);
  forget_those_of_the_parent();
  const auto found = std::ranges::find_if(
      free_, [&](const Free& one) { return one.patch->facts().threads == threads && one.labels == labels; });
  if (found == free_.end()) return nullptr;
  std::unique_ptr<Patch> patch = std::move(found->patch);
  free_.erase(found);
  return patch;
}

void PatchPool::give_back(std::unique_ptr<Patch> patch, LabelUse labels) {
  constexpr std::size_t kKept = 4;
  const std::lock_guard guard(mutex_);
  if (patch && free_.size() < kKept) free_.push_back({std::move(patch), labels});
}

py::dict patch_series(const yars::Radar& radar, PatchPool& pool, const SeriesRequest& request) {
  if (request.scene) radar::check_same_terrain(&request.scene->scene(), request.terrain->terrain());
  const auto orders = entries_of<Order>(request.orders, order_type(), "orders");
  for (std::size_t i = 0; i < orders.size(); ++i) request_of("orders[" + std::to_string(i) + "]", orders[i], true);
  const auto movers = movers_of(request.movers, orders.size());
  const Outputs outputs = make_outputs(request, orders.size(), radar.map_size());
  Series series(radar, pool.take(static_cast<std::size_t>(request.threads), outputs.labels()), request, outputs);
  without_interpreter([&](const parallel::GoesOn& goes_on) {
    for (std::size_t i = 0; i < orders.size(); ++i) series.form(i, orders[i], movers[i], goes_on);
  });
  py::dict arrays = series.finish();
  pool.give_back(series.take_patch(), outputs.labels());
  return arrays;
}

void add_series(py::module_& module) {
  module.attr("PATCH_ORDER") = order_type();
  module.attr("MOVER") = mover_type();
  module.attr("MODEL") = radar::kModelNumber;
}

}  // namespace yars::python
