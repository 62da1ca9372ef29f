#include "lib/geo/magnetic.hpp"

#include <GeographicLib/MagneticModel.hpp>
#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>

namespace yars::geo {

struct MagneticField::Model {
  Model(const std::string& name, const std::string& folder) : field(name, folder) {}
  GeographicLib::MagneticModel field;
};

MagneticField::MagneticField(const std::string& name, const std::string& folder) {
  const std::string chosen = name.empty() ? GeographicLib::MagneticModel::DefaultMagneticName() : name;
  try {
    model_ = std::make_unique<Model>(chosen, folder);
  } catch (const std::exception& problem) {
    // The library's own way to say that a file is not there.
    problem_ = problem.what();
  }
}

MagneticField::MagneticField(MagneticField&&) noexcept = default;
MagneticField& MagneticField::operator=(MagneticField&&) noexcept = default;
MagneticField::~MagneticField() = default;

double MagneticField::variation_deg(GeoPoint point, HeightAboveEllipsoid height, double year) const {
  if (!model_) return std::numeric_limits<double>::quiet_NaN();
  const auto& field = model_->field;
  double east = 0.0, north = 0.0, up = 0.0;
  field(std::clamp(year, field.MinTime(), field.MaxTime()), point.latitude_deg, point.longitude_deg, height.metres(),
        east, north, up);
  return std::atan2(east, north) / kRadiansPerDegree;
}

}  // namespace yars::geo
