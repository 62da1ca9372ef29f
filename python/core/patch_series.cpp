#include "python/core/patch_series.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <functional>
#include <initializer_list>
#include <limits>
#include <optional>
#include <utility>

#include "lib/geo/earth.hpp"
#include "lib/parallel/thread_pool.hpp"
#include "lib/radar/mapping.hpp"
#include "lib/text/plain_text.hpp"
#include "model/hrm/patch_formation.hpp"
#include "python/core/patch_boxes.hpp"
#include "tools/command/command.hpp"
#include "tools/patch/patch_setup.hpp"

namespace yars::python {

namespace {

namespace hrm = model::hrm;

// Entries of the structured arrays. Their fields are named in order below, for Python.
struct Order {
  double latitude, longitude, altitude_ft, heading, speed_kt, target_latitude, target_longitude, window_nm, time_s;
  std::int32_t looks;
  std::uint32_t map;
};
struct Mover {
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
    raise_value_error(std::string("yars.Radar.patches: ") + name + ": expected an array of one axis of the type " +
                      text_of(type) + ", found " + std::to_string(given.ndim()) + " axes of " + text_of(given.dtype()));
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
  hrm::LabelUse labels() const {
    if (height != nullptr || grazing != nullptr) return hrm::LabelUse::heights;
    return shadow != nullptr || layover != nullptr || material != nullptr || objects() ? hrm::LabelUse::surfaces
                                                                                       : hrm::LabelUse::none;
  }
};

Outputs make_outputs(const SeriesRequest& request, std::size_t count, int size) {
  const bool few_objects =
      request.scene && request.scene->objects().size() <= std::size_t{std::numeric_limits<std::int16_t>::max()};
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
      raise_value_error("yars.Radar.patches: arrays: expected " + std::string(kArrays) + ", found '" + name + "'");
  }
  return outputs;
}

// A number of an entry with its limits, for messages.
struct LimitedField {
  const char* name;
  double value;
  tools::Limits limits;
};
// Throws ValueError that names the first field beyond its limits, with its value. `entry`: such as "orders[3]".
void check_fields(const std::string& entry, std::initializer_list<LimitedField> fields) {
  for (const LimitedField& field : fields)
    if (!field.limits.contain(field.value))
      raise_value_error("yars.Radar.patches: " + entry + ": " + field.name + ": expected " +
                        text::text_of_number(field.limits.min) + " to " + text::text_of_number(field.limits.max) +
                        ", found " + text::text_of_number(field.value));
}

// Those of the options of `yars patch`.
void check_numbers(const std::string& entry, const Order& order) {
  check_fields(entry, {{"latitude", order.latitude, tools::kLatitudes_deg},
                       {"longitude", order.longitude, tools::kLongitudes_deg},
                       {"altitude_ft", order.altitude_ft, tools::kAltitudes_ft},
                       {"heading", order.heading, tools::kHeadings_deg},
                       {"speed_kt", order.speed_kt, tools::kSpeeds_kt},
                       {"target_latitude", order.target_latitude, tools::kLatitudes_deg},
                       {"target_longitude", order.target_longitude, tools::kLongitudes_deg},
                       {"window_nm", order.window_nm, tools::kWindows_nm},
                       {"time_s", order.time_s, tools::kTimes_s},
                       {"looks", static_cast<double>(order.looks), tools::kLooks}});
}

void check_numbers(const std::string& entry, const Mover& mover, std::size_t orders) {
  constexpr tools::Limits kCrossSections_m2{1e-3, 1e7}, kHeights_m{0.0, 1000.0};
  if (orders == 0) raise_value_error("yars.Radar.patches: movers: expected none without an order, found some");
  check_fields(entry, {{"order", static_cast<double>(mover.order), {0.0, static_cast<double>(orders - 1)}},
                       {"latitude", mover.latitude, tools::kLatitudes_deg},
                       {"longitude", mover.longitude, tools::kLongitudes_deg},
                       {"heading", mover.heading, tools::kHeadings_deg},
                       {"speed_kt", mover.speed_kt, tools::kSpeeds_kt},
                       {"cross_section_m2", mover.cross_section_m2, kCrossSections_m2},
                       {"height_m", mover.height_m, kHeights_m}});
}

hrm::PatchOrder order_of(const Order& order) {
  hrm::PatchOrder map;
  map.apex = {order.latitude, order.longitude};
  map.altitude = geo::AltitudeMsl::feet(order.altitude_ft);
  map.ground_track = geo::Bearing::degrees(order.heading);
  map.ground_speed = geo::Speed::knots(order.speed_kt);
  map.centre = {order.target_latitude, order.target_longitude};
  map.window = geo::Length::nautical_miles(order.window_nm);
  map.looks = order.looks;
  map.sim_time = geo::Duration::seconds(order.time_s);
  map.map = order.map;
  return map;
}

// Movers of each order, as moving points.
std::vector<std::vector<model::physics::MovingPoint>> traffic_of(const py::object& movers,
                                                                 const std::vector<Order>& orders) {
  std::vector<std::vector<model::physics::MovingPoint>> traffic(orders.size());
  if (movers.is_none()) return traffic;
  const auto all = entries_of<Mover>(py::cast<py::array>(movers), mover_type(), "movers");
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Mover& mover = all[i];
    check_numbers("movers[" + std::to_string(i) + "]", mover, orders.size());
    const auto order = static_cast<std::size_t>(mover.order);
    traffic[order].push_back(model::physics::moving_point({{mover.latitude, mover.longitude},
                                                           geo::Bearing::degrees(mover.heading),
                                                           geo::Speed::knots(mover.speed_kt).metres_per_second(),
                                                           geo::Duration::seconds(orders[order].time_s)},
                                                          mover.cross_section_m2, mover.height_m));
  }
  return traffic;
}

// Moves or copies the result of one map to entry `index` of the outputs.
void store(const hrm::PatchFormation& formation, std::size_t index, const Outputs& outputs) {
  const std::size_t count = formation.picture().size();
  const std::size_t at = index * count;
  const hrm::PixelLabels& labels = formation.labels();
  const auto copy = [&](const auto& from, auto* to) {
    if (to != nullptr) std::copy(from.begin(), from.end(), to + at);
  };
  copy(formation.picture(), outputs.video);
  copy(labels.shadow, outputs.shadow);
  copy(labels.layover, outputs.layover);
  if (outputs.object != nullptr)
    std::transform(labels.object.begin(), labels.object.end(), outputs.object + at,
                   [](std::int32_t object) { return static_cast<std::int16_t>(object); });
  copy(labels.object, outputs.object_of_many);
  copy(labels.material, outputs.material);
  copy(labels.height_m, outputs.height);
  if (outputs.power != nullptr)
    std::transform(formation.image().power.begin(), formation.image().power.end(), outputs.power + at,
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
  Series(Formation& formation, const SeriesRequest& request, const Outputs& outputs)
      : configuration_(formation.configuration),
        request_(request),
        outputs_(outputs),
        formation_(formation.patch_formation),
        scenes_(request.scene ? request.scene->scenes() : configuration_.world.scenes) {
    if (request.scene && outputs.objects())
      boxes_.emplace(*request.scene, configuration_.fidelity.map_size, request.min_pixels);
  }

  // Forms map `index`. Throws CommandFailed that names the index.
  void form(std::size_t index, const Order& order, std::vector<model::physics::MovingPoint> traffic,
            const parallel::GoesOn& goes_on) {
    try {
      begin(order, std::move(traffic), goes_on);
    } catch (tools::CommandFailed& failed) {
      failed.message = "yars.Radar.patches: orders[" + std::to_string(index) + "]: " + failed.message;
      throw;
    }
    for (; formation_.state() != hrm::PatchState::done; formation_.advance()) parallel::check(goes_on);
    store(formation_, index, outputs_);
    hashes_.push_back(tools::picture_hash(formation_.picture()));
    geometries_.push_back(geo_of(formation_.geometry(), configuration_.fidelity.map_size));
    if (boxes_) boxes_->add(static_cast<std::int64_t>(index), formation_.geometry(), formation_.labels().object);
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

 private:
  void begin(const Order& given, std::vector<model::physics::MovingPoint> traffic, const parallel::GoesOn& goes_on) {
    const hrm::PatchOrder order = order_of(given);
    check_arguments([&] { tools::check_order(order, configuration_, request_.force); });
    const hrm::PatchNeed need = formation_.begin(order);
    hrm::PatchEnvironment environment = request_.terrain->with_theatre(
        scenes_, model::scene::SceneUse::triangles, warnings_, goes_on,
        [&](tools::Theatre& theatre) { return theatre.prepare(need, warnings_.sink()); });
    if (!request_.force) check_arguments([&] { tools::check_heights(order, environment, configuration_); });
    environment.traffic = std::move(traffic);
    formation_.set_environment(environment);
  }

  const radar::RadarConfiguration& configuration_;
  const SeriesRequest& request_;
  const Outputs& outputs_;
  hrm::PatchFormation& formation_;
  const std::vector<radar::Scene>& scenes_;
  std::optional<Boxes> boxes_;
  std::vector<std::uint64_t> hashes_;
  std::vector<Geo> geometries_;
  Warnings warnings_;
};

}  // namespace

Formation::Formation(const radar::RadarConfiguration& given, std::size_t threads, hrm::LabelUse labels)
    : configuration(given),
      use(labels),
      workers(threads),
      patch_formation(configuration,
                      {threads, [this](const std::function<void(std::size_t)>& job) { workers.run(job); }},
                      hrm::kMaxSectorPoints, labels) {}

// Their destructors would wait for threads that do not exist here.
void FormationPool::forget_those_of_the_parent() {
  if (process_ == ::getpid()) return;
  for (std::unique_ptr<Formation>& formation : free_) static_cast<void>(formation.release());
  free_.clear();
  process_ = ::getpid();
}

std::unique_ptr<Formation> FormationPool::take(const radar::RadarConfiguration& configuration, std::size_t threads,
                                               hrm::LabelUse labels) {
  {
    const std::lock_guard guard(mutex_);
    forget_those_of_the_parent();
    const auto found = std::find_if(free_.begin(), free_.end(), [&](const std::unique_ptr<Formation>& formation) {
      return formation->workers.threads() == threads && formation->use == labels;
    });
    if (found != free_.end()) {
      std::unique_ptr<Formation> formation = std::move(*found);
      free_.erase(found);
      return formation;
    }
  }
  return std::make_unique<Formation>(configuration, threads, labels);
}

void FormationPool::give_back(std::unique_ptr<Formation> formation) {
  constexpr std::size_t kKept = 4;
  const std::lock_guard guard(mutex_);
  if (free_.size() < kKept) free_.push_back(std::move(formation));
}

py::dict patch_series(const radar::RadarConfiguration& configuration, FormationPool& pool,
                      const SeriesRequest& request) {
  const auto orders = entries_of<Order>(request.orders, order_type(), "orders");
  for (std::size_t i = 0; i < orders.size(); ++i) check_numbers("orders[" + std::to_string(i) + "]", orders[i]);
  auto traffic = traffic_of(request.movers, orders);
  if (request.threads < 1 || request.threads > 256)
    raise_value_error("yars.Radar.patches: threads: expected 1 to 256, found " + std::to_string(request.threads));
  const Outputs outputs = make_outputs(request, orders.size(), configuration.fidelity.map_size);
  std::unique_ptr<Formation> formation =
      pool.take(configuration, static_cast<std::size_t>(request.threads), outputs.labels());
  Series series(*formation, request, outputs);
  without_interpreter([&](const parallel::GoesOn& goes_on) {
    for (std::size_t i = 0; i < orders.size(); ++i) series.form(i, orders[i], std::move(traffic[i]), goes_on);
  });
  py::dict arrays = series.finish();
  pool.give_back(std::move(formation));
  return arrays;
}

void add_series(py::module_& module) {
  module.attr("PATCH_ORDER") = order_type();
  module.attr("MOVER") = mover_type();
}

}  // namespace yars::python
