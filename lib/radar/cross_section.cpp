#include "lib/radar/cross_section.hpp"

#include <cmath>
#include <numbers>

namespace yars::radar {

namespace {
constexpr double kPi = std::numbers::pi;
constexpr double kLambdaGhz_m = 0.299792458;  // wavelength [m] times frequency [GHz]

double wavelength_m(double frequency_ghz) {
  return kLambdaGhz_m / frequency_ghz;
}
}  // namespace

double ship_cross_section_m2(double displacement_t, double frequency_ghz) {
  return 52.0 * std::sqrt(1000.0 * frequency_ghz) * std::pow(displacement_t / 1000.0, 1.5);
}

double reflector_cross_section_m2(TargetEcho echo, double edge_m, double frequency_ghz) {
  const double area_per_wavelength_m = edge_m * edge_m / wavelength_m(frequency_ghz);
  const double factor = echo == TargetEcho::trihedral ? 4.0 * kPi / 3.0 : 8.0 * kPi;
  return factor * area_per_wavelength_m * area_per_wavelength_m;
}

double dihedral_edge_m(double cross_section_m2, double frequency_ghz) {
  return std::sqrt(std::sqrt(cross_section_m2 / (8.0 * kPi)) * wavelength_m(frequency_ghz));
}

}  // namespace yars::radar
