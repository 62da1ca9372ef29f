#include "python/core/patch_series.hpp"

#define XXH_INLINE_ALL
#include <unistd.h>
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <optional>
#include <utility>

#include "lib/geo/earth.hpp"
#include "lib/parallel/thread_pool.hpp"
#include "lib/radar/mapping.hpp"
#include "model/hrm/patch_formation.hpp"
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
struct Geo {
  double origin_latitude, origin_longitude;
  double plane_from_pixel[6];
  double up_deg, distance_m, slant_range_m, grazing_deg, plane_msl_m, window_m, resolution_m;
};
struct Box {
  std::int32_t order, object;
  float corners[4][2];
  float aspect_deg;
  std::int32_t pixels;
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
  return dtype_of(
      {{"order", "<i4"}, {"object", "<i4"}, {"corners", "(4,2)<f4"}, {"aspect_deg", "<f4"}, {"pixels", "<i4"}});
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

void check_numbers(const Order& order) {
  const bool valid = std::abs(order.latitude) <= 90.0 && std::abs(order.longitude) <= 180.0 &&
                     std::abs(order.target_latitude) <= 90.0 && std::abs(order.target_longitude) <= 180.0 &&
                     std::isfinite(order.altitude_ft) && std::isfinite(order.heading) &&
                     std::isfinite(order.speed_kt) && order.window_nm >= 0.01 && order.window_nm <= 200.0 &&
                     order.looks >= 1 && order.looks <= 16 && order.time_s >= 0.0 && order.time_s <= 1e8;
  if (!valid)
    raise_value_error(
        "expected degrees, finite numbers, window_nm from 0.01 to 200, looks from 1 to 16 and time_s from 0 to 1e8, "
        "found others");
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

Geo geo_of(const hrm::PatchGeometry& geometry, int size) {
  Geo geo{};
  geo.origin_latitude = geometry.apex().latitude_deg;
  geo.origin_longitude = geometry.apex().longitude_deg;
  const std::array<double, 6> plane = tools::plane_from_pixel(geometry, size);
  std::copy(plane.begin(), plane.end(), &geo.plane_from_pixel[0]);
  geo.up_deg = geometry.up().degrees();
  geo.distance_m = geometry.distance_m();
  geo.slant_range_m = geometry.slant_range_m();
  geo.grazing_deg = std::asin(geometry.sin_grazing()) / geo::kRadiansPerDegree;
  geo.plane_msl_m = geometry.plane_msl_m();
  geo.window_m = geometry.window_m();
  geo.resolution_m = radar::map_resolution(geo::Length::metres(geometry.window_m())).metres();
  return geo;
}

// Linear transform from the plane of a group of footprints to the map, about the group's origin.
struct GroupOnMap {
  GroupOnMap(const hrm::PatchGeometry& geometry, geo::GeoPoint origin) : at(geometry.point_of(origin)) {
    constexpr double kStep_m = 200.0;
    const geo::AzimuthalEquidistant plane(origin);
    const hrm::MapPoint to_east = geometry.point_of(plane.geodetic_from_plane({kStep_m, 0.0}));
    const hrm::MapPoint to_north = geometry.point_of(plane.geodetic_from_plane({0.0, kStep_m}));
    east = {(to_east.right_m - at.right_m) / kStep_m, (to_east.up_m - at.up_m) / kStep_m};
    north = {(to_north.right_m - at.right_m) / kStep_m, (to_north.up_m - at.up_m) / kStep_m};
  }
  hrm::MapPoint of(double east_m, double north_m) const {
    return {at.right_m + east.right_m * east_m + north.right_m * north_m,
            at.up_m + east.up_m * east_m + north.up_m * north_m};
  }
  hrm::MapPoint at, east, north;
};

// Factor on the distance over ground of a point that is `height_m` above the map plane: it appears at its bearing and
// slant range.
double layover_factor(const hrm::PatchGeometry& geometry, hrm::MapPoint point, double height_m) {
  const double ahead_m = point.up_m + geometry.distance_m();
  const double distance_m = std::sqrt(point.right_m * point.right_m + ahead_m * ahead_m);
  if (!(distance_m > 0.0)) return 1.0;
  return hrm::laid_over_m(distance_m, height_m, geometry.above_level_m(distance_m)) / distance_m;
}

// Boxes of the objects whose footprint overlaps the picture, in the order of the scene's groups.
class Boxes {
 public:
  Boxes(const Scene& scene, int size, int min_pixels)
      : scene_(scene), size_(size), min_pixels_(min_pixels), pixels_(scene.objects().size(), 0) {}

  void add(std::int32_t order, const hrm::PatchGeometry& geometry, const std::vector<std::int32_t>& labels) {
    for (const std::int32_t object : labels)
      if (object >= 0) ++pixels_[static_cast<std::size_t>(object)];
    const geo::GeoPoint centre = geometry.position_of({});
    for (const FootprintGroup& group : scene_.groups()) {
      const double north_m = (group.origin.latitude_deg - centre.latitude_deg) * geo::kMetresPerDegree;
      if (std::abs(north_m) > 1.1 * (group.reach_m + geometry.window_m())) continue;
      const GroupOnMap transform(geometry, group.origin);
      const double reach_m = 0.5 * geometry.window_m() + group.reach_m;
      if (std::abs(transform.at.right_m) > reach_m || std::abs(transform.at.up_m) > 1.5 * reach_m) continue;
      for (const Footprint& footprint : group.footprints) add_box(order, geometry, transform, footprint);
    }
    for (const std::int32_t object : labels)
      if (object >= 0) pixels_[static_cast<std::size_t>(object)] = 0;
  }
  const std::vector<Box>& boxes() const { return boxes_; }

 private:
  void add_box(std::int32_t order, const hrm::PatchGeometry& geometry, const GroupOnMap& transform,
               const Footprint& footprint) {
    const double pixels_per_m = size_ / geometry.window_m();
    const hrm::MapPoint middle = transform.of(footprint.east_m, footprint.north_m);
    // One factor serves the whole footprint, because it changes little over an object.
    const double factor = layover_factor(geometry, middle, footprint.base_msl_m - geometry.plane_msl_m());
    Box box{};
    box.pixels = pixels_[static_cast<std::size_t>(footprint.object)];
    if (box.pixels < min_pixels_) return;
    float left = 1e9F, right = -1e9F, top = 1e9F, bottom = -1e9F;
    constexpr int kSigns[4][2] = {{1, -1}, {1, 1}, {-1, 1}, {-1, -1}};
    for (int k = 0; k < 4; ++k) {
      const double along_m = kSigns[k][0] * footprint.half_length_m, across_m = kSigns[k][1] * footprint.half_width_m;
      const hrm::MapPoint point =
          transform.of(footprint.east_m + along_m * footprint.sine + across_m * footprint.cosine,
                       footprint.north_m + along_m * footprint.cosine - across_m * footprint.sine);
      const double up_m = (point.up_m + geometry.distance_m()) * factor - geometry.distance_m();
      box.corners[k][0] = static_cast<float>((point.right_m * factor + 0.5 * geometry.window_m()) * pixels_per_m);
      box.corners[k][1] = static_cast<float>((0.5 * geometry.window_m() - up_m) * pixels_per_m);
      left = std::min(left, box.corners[k][0]);
      right = std::max(right, box.corners[k][0]);
      top = std::min(top, box.corners[k][1]);
      bottom = std::max(bottom, box.corners[k][1]);
    }
    const auto edge = static_cast<float>(size_);
    const bool overlaps = right > 0.0F && left < edge && bottom > 0.0F && top < edge;
    if (!overlaps && box.pixels == 0) return;
    box.order = order;
    box.object = footprint.object;
    const double off_deg = std::atan(middle.right_m / (middle.up_m + geometry.distance_m())) / geo::kRadiansPerDegree;
    const double aspect_deg = geometry.up().degrees() + off_deg - footprint.heading_deg + 720.0;
    box.aspect_deg = static_cast<float>(aspect_deg - 180.0 * std::floor(aspect_deg / 180.0));
    boxes_.push_back(box);
  }

  const Scene& scene_;
  int size_, min_pixels_;
  std::vector<std::int32_t> pixels_;  // by object: pixels with its label in the current map
  std::vector<Box> boxes_;
};

// Movers of each order, as moving points.
std::vector<std::vector<model::physics::MovingPoint>> traffic_of(const py::object& movers,
                                                                 const std::vector<Order>& orders) {
  std::vector<std::vector<model::physics::MovingPoint>> traffic(orders.size());
  if (movers.is_none()) return traffic;
  for (const Mover& mover : entries_of<Mover>(py::cast<py::array>(movers), mover_type(), "movers")) {
    const bool valid = mover.order >= 0 && mover.order < static_cast<std::int64_t>(orders.size()) &&
                       std::abs(mover.latitude) <= 90.0 && std::abs(mover.longitude) <= 180.0 &&
                       std::isfinite(mover.heading) && std::isfinite(mover.speed_kt) && mover.cross_section_m2 > 0.0 &&
                       std::isfinite(mover.cross_section_m2) && std::isfinite(mover.height_m);
    if (!valid)
      raise_value_error(
          "yars.Radar.patches: movers: expected an order of this call, degrees, finite numbers and a cross "
          "section above 0, found an entry for order " +
          std::to_string(mover.order) + " that has others");
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
  void form(std::size_t index, const Order& order, std::vector<model::physics::MovingPoint> traffic) {
    try {
      begin(order, std::move(traffic));
    } catch (tools::CommandFailed& failed) {
      failed.message = "yars.Radar.patches: orders[" + std::to_string(index) + "]: " + failed.message;
      throw;
    }
    while (formation_.state() != hrm::PatchState::done) formation_.advance();
    store(formation_, index, outputs_);
    hashes_.push_back(tools::picture_hash(formation_.picture()));
    geometries_.push_back(geo_of(formation_.geometry(), configuration_.fidelity.map_size));
    if (boxes_) boxes_->add(static_cast<std::int32_t>(index), formation_.geometry(), formation_.labels().object);
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
    arrays["hash"] = array_from(std::move(hashes_), {static_cast<py::ssize_t>(count)});
    return arrays;
  }

 private:
  void begin(const Order& given, std::vector<model::physics::MovingPoint> traffic) {
    const hrm::PatchOrder order = order_of(given);
    check_arguments([&] {
      check_numbers(given);
      tools::check_order(order, configuration_, request_.force);
    });
    const hrm::PatchNeed need = formation_.begin(order);
    hrm::PatchEnvironment environment;
    {
      const std::lock_guard guard(request_.terrain->mutex());
      environment =
          request_.terrain->theatre(scenes_, model::scene::SceneUse::triangles).prepare(need, warnings_.sink());
    }
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
  auto traffic = traffic_of(request.movers, orders);
  if (request.threads < 1 || request.threads > 256)
    raise_value_error("yars.Radar.patches: threads: expected 1 to 256, found " + std::to_string(request.threads));
  const Outputs outputs = make_outputs(request, orders.size(), configuration.fidelity.map_size);
  std::unique_ptr<Formation> formation =
      pool.take(configuration, static_cast<std::size_t>(request.threads), outputs.labels());
  Series series(*formation, request, outputs);
  {
    const py::gil_scoped_release released;
    for (std::size_t i = 0; i < orders.size(); ++i) series.form(i, orders[i], std::move(traffic[i]));
  }
  py::dict arrays = series.finish();
  pool.give_back(std::move(formation));
  return arrays;
}

void add_series(py::module_& module) {
  module.attr("PATCH_ORDER") = order_type();
  module.attr("MOVER") = mover_type();
  module.def(
      "xxh3",
      [](const py::buffer& bytes) {
        const py::buffer_info info = bytes.request();
        return XXH3_64bits(info.ptr, static_cast<std::size_t>(info.size * info.itemsize));
      },
      py::arg("bytes"), "XXH3 hash, 64 bits, of the bytes of a contiguous buffer.");
  module.def(
      "xxh3_items",
      [](const py::buffer& array) {
        const py::buffer_info info = array.request();
        std::vector<std::uint64_t> hashes(info.ndim > 0 ? static_cast<std::size_t>(info.shape[0]) : 0);
        const std::size_t bytes =
            hashes.empty() ? 0 : static_cast<std::size_t>(info.size * info.itemsize) / hashes.size();
        for (std::size_t i = 0; i < hashes.size(); ++i)
          hashes[i] = XXH3_64bits(static_cast<const std::uint8_t*>(info.ptr) + i * bytes, bytes);
        return hashes;
      },
      py::arg("array"), "XXH3 hashes, 64 bits each, of the entries along the first axis of a contiguous array.");
}

}  // namespace yars::python
