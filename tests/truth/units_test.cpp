// Rows of units and of the speed of light.
#include "lib/geo/quantity.hpp"
#include "model/physics/receiver.hpp"
#include "model/physics/reflectivity.hpp"
#include "tests/truth/ledger.hpp"

namespace yars::truth {
namespace {

TEST(Truth, UnitsAreThoseOfTheStandards) {
  const auto row = [](const std::string& term, double outside, double tolerance, const std::string& unit,
                      const std::string& source, double ours) {
    expect_row({"Units", term, outside, tolerance, unit, source, "exact definition"}, ours);
  };
  row("1 nautical mile", 1852.0, 1e-9, "m", "NIST SP 811, appendix B.8", geo::Length::nautical_miles(1.0).metres());
  row("1 foot", 0.3048, 1e-12, "m", "NIST SP 811, appendix B.8", geo::Length::feet(1.0).metres());
  row("1 knot", 0.5144444, 1e-7, "m/s", "NIST SP 811, appendix B.8", geo::Speed::knots(1.0).metres_per_second());
  row("wavelength at 9.6 GHz", 0.0312283810, 1e-9, "m", "speed of light 299,792,458 m/s, SI brochure",
      model::physics::wavelength_m(9.6));
}

TEST(Truth, AMicrosecondOfDelayIs150Metres) {
  expect_row({"Units", "range of 1 µs of delay", 149.896229, 1e-6, "m", "c / 2, SI brochure", "exact definition"},
             model::physics::kMetresPerMicrosecond);
}

}  // namespace
}  // namespace yars::truth
