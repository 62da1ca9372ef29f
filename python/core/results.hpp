// Classes ScanResult and PatchResult of yars._core: one scan or one patch map (yars/scan.hpp, yars/patch.hpp) as
// arrays. Arrays lie in the memory of the result. Labels of a scan, and positions, are computed when first asked for.
// Units: as the suffix of each name says; of arrays, as results.py lists them.
// Source of the labels: docs/python.md, "Labels".
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "python/core/calls.hpp"
#include "python/core/support.hpp"
#include "yars/patch.hpp"
#include "yars/scan.hpp"

namespace yars::python {

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
