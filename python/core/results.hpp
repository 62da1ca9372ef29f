// Classes ScanResult and PatchResult of yars._core: one scan or one patch map (yars/scan.hpp, yars/patch.hpp) as
// arrays. Arrays lie in the memory of the result. Labels of a scan, and positions, are computed when first asked for.
// Where patch maps lie, and boxes of the objects of a scene in them: corners in pixels, laid over as the foot of the
// object appears.
// Units: as the suffix of each name says; of arrays, as results.py lists them; of boxes, pixels and degrees.
// Source: docs/python.md, "Labels" and "Many maps".
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "model/hrm/patch_geometry.hpp"
#include "python/core/calls.hpp"
#include "radar/private_data.hpp"
#include "yars/patch.hpp"
#include "yars/scan.hpp"

namespace yars::python {

// Entry of the structured array `geo`.
struct Geo {
  double origin_latitude, origin_longitude;
  double plane_from_pixel[6];
  double up_deg, distance_m, slant_range_m, grazing_deg, plane_msl_m, window_m, resolution_m;
};
Geo geo_of(const PatchFacts& facts);

// Linear transform from the plane of a group of footprints to the map, about the group's origin.
struct GroupOnMap;

// Entry of the structured array `boxes`. Its layout is that of BOX of python/yars/dataset/blocks.py, so that a data set
// completes and stores these entries where they are.
struct Box {
  std::int64_t order;
  std::int32_t object;
  std::int32_t class_id;  // 0; no field of `boxes`
  std::int32_t pixels;
  float aspect_deg;
  float corners[4][2];
};

// Boxes of the objects whose footprint overlaps the picture, in the order of the scene's groups.
class Boxes {
 public:
  // Boxes of objects with fewer than `min_pixels` labelled pixels are left out. `size`: pixels on an edge of a map.
  Boxes(const yars::Scene& scene, int size, int min_pixels)
      : scene_(scene), size_(size), min_pixels_(min_pixels), pixels_(scene.objects().size(), 0) {}

  // Adds those of one map. `order`: its index. `labels`: object of each pixel.
  void add(std::int64_t order, const model::hrm::PatchGeometry& geometry, std::span<const std::int32_t> labels);
  const std::vector<Box>& boxes() const { return boxes_; }

 private:
  void add_box(std::int64_t order, const model::hrm::PatchGeometry& geometry, const GroupOnMap& transform,
               const radar::Footprint& footprint);

  const yars::Scene& scene_;
  int size_, min_pixels_;
  std::vector<std::int32_t> pixels_;  // by object: pixels with its label in the current map
  std::vector<Box> boxes_;
};

class ScanResult : public std::enable_shared_from_this<ScanResult> {
 public:
  explicit ScanResult(Scan scan) : scan_(std::move(scan)) {}

  // Array by name: power, video, azimuth, and the names of ScanLabels without units. Throws KeyError.
  py::array array(const std::string& name);
  std::uint64_t hash() const { return scan_.hash(); }
  py::dict facts() const;

 private:
  Scan scan_;
  ObjectLock lock_{[] {}};  // guards the labels of scan_
};

class PatchResult : public std::enable_shared_from_this<PatchResult> {
 public:
  explicit PatchResult(Patch patch);

  // Array by name: power, video, x, y, the names of PatchLabels and PatchPositions without units. Throws KeyError.
  py::array array(const std::string& name);
  std::uint64_t hash() const { return patch_.hash(); }
  py::dict facts() const;

 private:
  py::array centres(bool columns) const;

  Patch patch_;
  std::vector<float> power_, grazing_deg_;   // NaN in the blind zone
  std::optional<PatchPositions> positions_;  // nullopt: not computed yet
  ObjectLock lock_{[] {}};                   // guards positions_
};

void add_results(py::module_& module);

}  // namespace yars::python
