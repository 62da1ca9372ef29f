#include "lib/geo/geodesy.hpp"

#include <GeographicLib/Constants.hpp>
#include <GeographicLib/Geodesic.hpp>
#include <GeographicLib/GeodesicLine.hpp>
#include <GeographicLib/Geoid.hpp>
#include <GeographicLib/MagneticModel.hpp>
#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <new>

namespace yars::geo {

namespace {
const GeographicLib::Geodesic& wgs84() {
  return GeographicLib::Geodesic::WGS84();
}
}  // namespace

GeodesicInverse geodesic_inverse(GeoPoint from, GeoPoint to) {
  double distance_m = 0.0;
  double azimuth_start_deg = 0.0;
  double azimuth_end_deg = 0.0;
  wgs84().Inverse(from.latitude_deg, from.longitude_deg, to.latitude_deg, to.longitude_deg, distance_m,
                  azimuth_start_deg, azimuth_end_deg);
  return {Length::metres(distance_m), Bearing::degrees(azimuth_start_deg), Bearing::degrees(azimuth_end_deg)};
}

GeoPoint geodesic_direct(GeoPoint from, Bearing azimuth, Length distance) {
  GeoPoint to;
  wgs84().Direct(from.latitude_deg, from.longitude_deg, azimuth.degrees(), distance.metres(), to.latitude_deg,
                 to.longitude_deg);
  return to;
}

struct GeodesicRay::Line {
  GeographicLib::GeodesicLine line;
};

GeodesicRay::GeodesicRay(GeoPoint start, Bearing azimuth) {
  static_assert(sizeof(Line) <= sizeof(storage_) && alignof(Line) <= alignof(std::max_align_t));
  ::new (storage_.data())
      Line{wgs84().Line(start.latitude_deg, start.longitude_deg, azimuth.degrees(),
                        GeographicLib::Geodesic::LATITUDE | GeographicLib::Geodesic::LONGITUDE |
                            GeographicLib::Geodesic::AZIMUTH | GeographicLib::Geodesic::DISTANCE_IN)};
}

GeodesicRay::GeodesicRay(const GeodesicRay& other) {
  ::new (storage_.data()) Line(other.line());
}

GeodesicRay& GeodesicRay::operator=(const GeodesicRay& other) {
  line() = other.line();
  return *this;
}

GeodesicRay::~GeodesicRay() {
  line().~Line();
}

GeodesicRay::Line& GeodesicRay::line() {
  return *std::launder(reinterpret_cast<Line*>(storage_.data()));
}

const GeodesicRay::Line& GeodesicRay::line() const {
  return *std::launder(reinterpret_cast<const Line*>(storage_.data()));
}

GeoPoint GeodesicRay::position(Length distance) const {
  GeoPoint point;
  line().line.Position(distance.metres(), point.latitude_deg, point.longitude_deg);
  return point;
}

GeodesicRay::PositionAndAzimuth GeodesicRay::position_and_azimuth(Length distance) const {
  GeoPoint point;
  double azimuth_deg = 0.0;
  line().line.Position(distance.metres(), point.latitude_deg, point.longitude_deg, azimuth_deg);
  return {point, Bearing::degrees(azimuth_deg)};
}

Length radius_of_curvature(double latitude_deg, Bearing azimuth) {
  const double a_m = GeographicLib::Constants::WGS84_a();
  const double f = GeographicLib::Constants::WGS84_f();
  const double e2 = f * (2.0 - f);
  const double sin_lat = std::sin(latitude_deg * kRadiansPerDegree);
  const double w2 = 1.0 - e2 * sin_lat * sin_lat;
  const double meridian_m = a_m * (1.0 - e2) / (w2 * std::sqrt(w2));
  const double prime_vertical_m = a_m / std::sqrt(w2);
  const double cos_az = std::cos(azimuth.radians());
  const double sin_az = std::sin(azimuth.radians());
  return Length::metres(1.0 / (cos_az * cos_az / meridian_m + sin_az * sin_az / prime_vertical_m));
}

namespace {
constexpr double kTruncationTarget_m = 5e-4;  // [m] bound on the first omitted term: half of the permitted 1 mm

// Element k is 1 / k; element 0 is unused. Multiplication by 1 / k is faster than division by k.
constexpr std::array<double, GeodesicSeries::kMaxOrder + 1> kInverse{
    0.0, 1.0, 1.0 / 2.0, 1.0 / 3.0, 1.0 / 4.0, 1.0 / 5.0, 1.0 / 6.0, 1.0 / 7.0, 1.0 / 8.0};

// Polynomial in the cosine n of the azimuth, with every second power: entry i belongs to n^(degree - 2 i).
using Polynomial = std::array<double, GeodesicSeries::kMaxOrder / 2 + 1>;

Polynomial operator*(double factor, Polynomial polynomial) {
  for (double& entry : polynomial) entry *= factor;
  return polynomial;
}

// Power series in the distance. The degree of coefficient k is k + extra_degree.
struct PowerSeries {
  std::size_t extra_degree = 0;
  std::array<Polynomial, GeodesicSeries::kMaxOrder + 1> at{};

  Polynomial& operator[](std::size_t k) { return at[k]; }
  const Polynomial& operator[](std::size_t k) const { return at[k]; }
  std::size_t last_entry(std::size_t k) const { return (k + extra_degree) / 2; }
};

// Adds `factor` times the product of coefficient j of `a` and coefficient k of `b`.
void add_product(double factor, const PowerSeries& a, std::size_t j, const PowerSeries& b, std::size_t k,
                 Polynomial& sum) {
  for (std::size_t i = 0; i <= a.last_entry(j); ++i)
    for (std::size_t l = 0; l <= b.last_entry(k); ++l) sum[i + l] += factor * a[j][i] * b[k][l];
}

// Coefficient k of the product of two series, without the terms of the first `skipped` coefficients of `a`.
Polynomial product(const PowerSeries& a, const PowerSeries& b, std::size_t k, std::size_t skipped = 0) {
  Polynomial sum{};
  for (std::size_t j = skipped; j <= k; ++j) add_product(1.0, a, j, b, k - j, sum);
  return sum;
}

// Initial values of the geodesics on the auxiliary sphere of Karney 2013. beta: reduced latitude.
struct Start {
  double squared_axes;  // (b / a)^2, with semi-axes a and b of the ellipsoid
  double sin_beta, cos_beta;
  double cos_latitude;
};

Start start_of(double latitude_deg) {
  const double axis_ratio = 1.0 - GeographicLib::Constants::WGS84_f();
  const double latitude_rad = latitude_deg * kRadiansPerDegree;
  const double scaled_sine = axis_ratio * std::sin(latitude_rad);
  const double scaled_cosine = std::cos(latitude_rad);
  const double inverse = 1.0 / std::sqrt(scaled_sine * scaled_sine + scaled_cosine * scaled_cosine);
  return {axis_ratio * axis_ratio, scaled_sine * inverse, scaled_cosine * inverse, scaled_cosine};
}

// Power series in the distance s [equatorial radii]: longitude [rad] over the sine of the azimuth, and sine of the
// geodetic latitude. The degree of the longitude's coefficient k is k - 1.
// Definitions: z = sin(beta), p = cos(beta) cos(azimuth), W^2 = 1 - e^2 cos^2(beta), ds = W dsigma. e: eccentricity;
// sigma: arc on the auxiliary sphere. `inverse_w` is 1 / W.
// Derivatives by s: z' = p / W, p' = -z / W, longitude' = east / cos^2(beta), because east = cos(beta) sin(azimuth) is
// constant (Clairaut). Output: sin(latitude) = z / W.
// Source: Karney 2013, eqs. 5-10.
struct Path {
  PowerSeries sin_latitude;
  std::array<Polynomial, GeodesicSeries::kMaxOrder + 1> longitude{};
};

Path path_from(const Start& start, std::size_t order) {
  const double e_squared = 1.0 - start.squared_axes;
  Path path;
  PowerSeries z, p{1, {}}, w_squared, inverse_w, cosine_squared, inverse_cosine;
  z[0][0] = start.sin_beta;
  p[0][0] = start.cos_beta;
  w_squared[0][0] = start.squared_axes + e_squared * start.sin_beta * start.sin_beta;
  cosine_squared[0][0] = start.cos_beta * start.cos_beta;
  inverse_w[0][0] = 1.0 / std::sqrt(w_squared[0][0]);
  inverse_cosine[0][0] = 1.0 / cosine_squared[0][0];
  for (std::size_t k = 0; k <= order; ++k) {
    if (k > 0) {
      const Polynomial square = product(z, z, k);
      w_squared[k] = e_squared * square;
      cosine_squared[k] = -1.0 * square;
      // Recurrence from the identity 2 W^2 (1/W)' = -(W^2)' (1/W).
      Polynomial sum{};
      for (std::size_t j = 1; j <= k; ++j)
        add_product(static_cast<double>(2 * k - j), w_squared, j, inverse_w, k - j, sum);
      inverse_w[k] = -0.5 * kInverse[k] * inverse_w[0][0] * inverse_w[0][0] * sum;
      inverse_cosine[k] = -inverse_cosine[0][0] * product(cosine_squared, inverse_cosine, k, 1);
    }
    path.sin_latitude[k] = product(z, inverse_w, k);
    if (k == order) break;
    z[k + 1] = kInverse[k + 1] * product(p, inverse_w, k);
    // The degree of p's coefficient is greater by 2, so the entries move by one.
    for (std::size_t i = 0; i <= k / 2; ++i) p[k + 1][i + 1] = -kInverse[k + 1] * path.sin_latitude[k][i];
    path.longitude[k + 1] = kInverse[k + 1] * start.cos_beta * inverse_cosine[k];
  }
  return path;
}

// Power series of the arcsine of the power series `sine`, without the constant term. `first_cosine`: cosine at s = 0.
// Recurrence: sine' = cosine * angle', cosine' = -sine * angle'; `slope` is angle'.
PowerSeries arcsine(const PowerSeries& sine, double first_cosine, std::size_t order) {
  PowerSeries angle, slope{1, {}}, cosine;
  cosine[0][0] = first_cosine;
  const double inverse = 1.0 / first_cosine;
  for (std::size_t k = 0; k < order; ++k) {
    slope[k] = inverse * static_cast<double>(k + 1) * sine[k + 1];
    for (std::size_t j = 1; j <= k; ++j) add_product(-inverse, cosine, j, slope, k - j, slope[k]);
    cosine[k + 1] = -kInverse[k + 1] * product(sine, slope, k);
    angle[k + 1] = kInverse[k + 1] * slope[k];
  }
  return angle;
}

// Value of a polynomial of `degree`. `square`: of the cosine.
double value_of(const Polynomial& polynomial, std::size_t degree, double cosine, double square) {
  double value = polynomial[0];
  for (std::size_t i = 1; i <= degree / 2; ++i) value = value * square + polynomial[i];
  return degree % 2 == 1 ? value * cosine : value;
}
}  // namespace

int GeodesicSeries::order_for(double latitude_deg, Length range) {
  // The series of latitude and longitude converge for ranges up to about the distance to the nearer pole. Term k is
  // about to_pole_m * (range / to_pole_m)^k / k.
  const double to_pole_m = (90.0 - std::abs(latitude_deg)) * kRadiansPerDegree * kMeanEarthRadius_m;
  const double ratio = range.metres() / to_pole_m;
  double omitted_m = to_pole_m * ratio;
  for (int order = 1; order <= kMaxOrder; ++order) {
    omitted_m *= ratio;
    if (omitted_m < kTruncationTarget_m * (order + 1)) return order;
  }
  return 0;
}

GeodesicFan::GeodesicFan(GeoPoint start, int order) : start_(start), order_(order) {
  const auto terms = static_cast<std::size_t>(order);
  const Start begin = start_of(start.latitude_deg);
  const Path path = path_from(begin, terms);
  const PowerSeries latitude = arcsine(path.sin_latitude, begin.cos_latitude, terms);
  const double per_metre = 1.0 / GeographicLib::Constants::WGS84_a();
  double unit = 1.0 / kRadiansPerDegree;
  for (std::size_t k = 1; k <= terms; ++k) {
    unit *= per_metre;
    latitude_deg_[k] = unit * latitude[k];
    longitude_deg_[k] = unit * path.longitude[k];
  }
}

GeodesicSeries GeodesicFan::series(Bearing azimuth) const {
  const double cosine = std::cos(azimuth.radians()), sine = std::sin(azimuth.radians());
  const double square = cosine * cosine;
  GeodesicSeries series{order_, {start_.latitude_deg}, {start_.longitude_deg}};
  for (std::size_t k = 1; k <= static_cast<std::size_t>(order_); ++k) {
    series.latitude_deg[k] = value_of(latitude_deg_[k], k, cosine, square);
    series.longitude_deg[k] = sine * value_of(longitude_deg_[k], k - 1, cosine, square);
  }
  return series;
}

PlanePoint AzimuthalEquidistant::plane_from_geodetic(GeoPoint point) const {
  const GeodesicInverse line = geodesic_inverse(origin_, point);
  const double distance_m = line.distance.metres();
  const double turn_rad = (line.azimuth_at_start - up_).radians();
  return {distance_m * std::sin(turn_rad), distance_m * std::cos(turn_rad)};
}

GeoPoint AzimuthalEquidistant::geodetic_from_plane(PlanePoint point) const {
  const double distance_m = std::hypot(point.x_m, point.y_m);
  if (distance_m == 0.0) return origin_;
  return geodesic_direct(origin_, up_ + Angle::radians(std::atan2(point.x_m, point.y_m)), Length::metres(distance_m));
}

struct MagneticField::Model {
  Model(const std::string& name, const std::string& folder) : field(name, folder) {}
  GeographicLib::MagneticModel field;
};

MagneticField::MagneticField(const std::string& name, const std::string& folder) {
  const std::string chosen = name.empty() ? GeographicLib::MagneticModel::DefaultMagneticName() : name;
  try {
    model_ = std::make_unique<Model>(chosen, folder);
  } catch (const std::exception& problem) {
    // GeographicLib throws when a file of the model is missing or damaged.
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

struct Geoid::Grid {
  Grid(const std::string& name, const std::string& folder) : heights(name, folder, true, true) {}
  GeographicLib::Geoid heights;  // in memory as a whole
};

Geoid::Geoid(const std::string& folder) {
  for (const char* name : {"egm2008-5", "egm96-5", "egm96-15"}) {
    try {
      grid_ = std::make_unique<Grid>(name, folder);
      name_ = name;
      return;
    } catch (const std::exception& problem) {
      // GeographicLib throws when the file of a grid is missing or damaged.
      if (problem_.empty()) problem_ = problem.what();
    }
  }
}

Geoid::Geoid(Geoid&&) noexcept = default;
Geoid& Geoid::operator=(Geoid&&) noexcept = default;
Geoid::~Geoid() = default;

AltitudeMsl Geoid::altitude(GeoPoint point, HeightAboveEllipsoid height) const {
  const double geoid_m = grid_ ? grid_->heights(point.latitude_deg, point.longitude_deg) : 0.0;
  return AltitudeMsl::metres(height.metres() - geoid_m);
}

}  // namespace yars::geo
