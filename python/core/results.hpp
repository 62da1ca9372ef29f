// Classes ScanResult and PatchResult of yars._core: one scan or one patch map with the labels of its samples or pixels.
// Arrays lie in the memory of the result. Labels of a scan, and positions, are computed when first asked for.
// Units: as the suffix of each name says; of arrays, as results.py lists them.
// Source of the labels: docs/python.md, "Labels".
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "lib/radar/configuration.hpp"
#include "model/hrm/patch_formation.hpp"
#include "model/kernel/offline_scan.hpp"
#include "python/core/calls.hpp"
#include "python/core/places.hpp"
#include "python/core/support.hpp"

namespace yars::python {

// By sample, sweep after sweep. Where no ground has the sample's slant range, and over voids: NaN.
struct ScanLabels {
  std::vector<std::uint8_t> shadow, layover, material;
  std::vector<std::int32_t> object;
  std::vector<double> ground_range_m, slant_range_m, latitude_deg, longitude_deg;
  std::vector<float> height_m, grazing_deg;
};

class ScanResult : public std::enable_shared_from_this<ScanResult> {
 public:
  struct Parts {
    model::kernel::OfflineScan::Result scan;
    tools::ScanEnvironment environment;
  };
  // Environment and `scene` (null: none) are kept for the labels.
  ScanResult(const radar::RadarConfiguration& configuration, Parts parts, std::shared_ptr<Scene> scene);

  // Array by name: power, video, azimuth, and the names of ScanLabels without units. Throws KeyError.
  py::array array(const std::string& name);
  std::uint64_t hash() const;
  py::dict facts() const;

 private:
  void compute_labels(const parallel::GoesOn& goes_on);

  radar::RadarConfiguration configuration_;
  model::kernel::OfflineScan::Result scan_;
  tools::ScanEnvironment environment_;
  std::shared_ptr<Scene> scene_;
  std::unique_ptr<ScanLabels> labels_;  // null: not computed yet
  ObjectLock lock_{[] {}};              // guards labels_
};

class PatchResult : public std::enable_shared_from_this<PatchResult> {
 public:
  struct Parts {
    model::hrm::PatchGeometry geometry;
    model::hrm::PatchFormation::Result map;
    double formation_s;
  };
  // Takes the result out of a formation.
  static Parts parts_of(model::hrm::PatchFormation& formation);
  PatchResult(Parts parts, const model::hrm::PatchOrder& order, std::string fidelity);

  // Array by name: power, video, x, y, the labels of hrm::PixelLabels, ground_range, slant_range, latitude, longitude.
  py::array array(const std::string& name);
  std::uint64_t hash() const;
  py::dict facts() const;

 private:
  // Arrays of the pixels' places, by name.
  using Places = std::map<std::string, std::vector<double>>;
  Places positions() const;  // latitude, longitude
  Places ranges() const;     // ground_range, slant_range

  model::hrm::PatchGeometry geometry_;
  model::hrm::PatchOrder order_;
  double formation_s_;
  std::string fidelity_;
  model::hrm::PatchFormation::Result map_;
  std::vector<float> grazing_deg_;
  Places places_;           // those that are computed
  ObjectLock lock_{[] {}};  // guards places_
};

void add_results(py::module_& module);

}  // namespace yars::python
