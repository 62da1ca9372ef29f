// Magnetic variation by a model of the earth's field, where its data is installed (GeographicLib's World Magnetic
// Model; Debian has the program that fetches it, geographiclib-get-magnetic, but not the data).
#pragma once

#include <memory>
#include <string>

#include "lib/geo/geodesic.hpp"
#include "lib/geo/height.hpp"

namespace yars::geo {

class MagneticField {
 public:
  // An empty name: the library's own choice; an empty folder: where its data lies by default. has_data() tells whether
  // there was any; a name that was asked for and is not there leaves the reason in problem().
  MagneticField(const std::string& name, const std::string& folder);
  MagneticField(MagneticField&&) noexcept;
  MagneticField& operator=(MagneticField&&) noexcept;
  ~MagneticField();

  bool has_data() const { return model_ != nullptr; }
  const std::string& problem() const { return problem_; }
  // [deg] east positive. A year beyond the model's is taken at its nearest; NaN without data.
  double variation_deg(GeoPoint point, HeightAboveEllipsoid height, double year) const;

 private:
  struct Model;
  std::unique_ptr<Model> model_;
  std::string problem_;
};

}  // namespace yars::geo
