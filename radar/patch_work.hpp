// Data of a Patch: configuration, order, environment, and the computation or its result.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lib/parallel/thread_pool.hpp"
#include "lib/radar/configuration.hpp"
#include "model/hrm/patch_formation.hpp"
#include "radar/stores.hpp"
#include "yars/patch.hpp"

namespace yars {

struct Patch::Work {
  Work(const radar::RadarConfiguration& given, std::size_t threads, LabelUse labels);

  // The computation. ready() makes it at the first call, and again after finish().
  struct Formation {
    Formation(const radar::RadarConfiguration& configuration, std::size_t threads, LabelUse labels);
    parallel::ThreadPool workers;
    model::hrm::PatchFormation map;
  };
  Formation& ready();
  // Checks the order and reads what it needs.
  void prepare(const Terrain& terrain, const PatchRequest& request, const PatchSubject& subject, const Call& call);
  const model::hrm::MapImage& image() const { return formation ? formation->map.image() : result->image; }
  const std::vector<std::uint8_t>& picture() const { return formation ? formation->map.picture() : result->picture; }
  const model::hrm::PixelLabels& labels() const { return formation ? formation->map.labels() : result->labels; }

  radar::RadarConfiguration configuration;
  std::size_t threads;
  LabelUse label_use;
  model::hrm::PatchOrder order;
  model::hrm::PatchEnvironment environment;
  std::vector<std::string> left_out;
  std::unique_ptr<Formation> formation;  // null after finish()
  // After run().
  std::optional<model::hrm::PatchGeometry> geometry;
  double formation_s = 0.0;
  std::size_t triangles = 0;
  std::optional<model::hrm::PatchFormation::Result> result;  // after finish()
};

}  // namespace yars
