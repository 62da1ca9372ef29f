#include "tools/scan_shadow.hpp"

#include <cmath>

namespace yars::tools {

namespace {
constexpr const char* kNothing = "-";
constexpr int kDigits = 12;  // micrometres of range, tenths of a millimetre of place

void write_known(std::ostream& out, double value) {
  if (std::isnan(value))
    out << kNothing;
  else
    out << value;
}
}  // namespace

void write_shadow(std::ostream& out, std::span<const model::kernel::SweepPlace> places,
                  std::span<const trade::RaySample> samples) {
  out << "sweep,azimuth_deg,ground_range_m,latitude_deg,longitude_deg,elevation_m,lit\n";
  out.precision(kDigits);
  const std::size_t count = samples.size() / places.size();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const trade::RaySample& sample = samples[i];
    const std::size_t sweep = i / count;
    out << sweep << ',' << model::kernel::look_of(places[sweep]).azimuth.degrees() << ',';
    write_known(out, sample.distance_m);
    out << ',' << sample.place.latitude_deg << ',' << sample.place.longitude_deg << ',';
    write_known(out, sample.ground.elevation_m);
    out << ',' << (std::isnan(sample.ground.elevation_m) ? kNothing : sample.lit ? "1" : "0") << '\n';
  }
}

}  // namespace yars::tools
