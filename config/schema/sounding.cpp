#include "config/schema/sounding.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

#include "lib/file/text_file.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::config {

namespace {
constexpr double kDuctPerKm = 157.0;  // fall of refractivity with which a level ray follows the earth

struct Level {
  double height_m, refractivity;
};

// Pressure of saturated vapour over water [hPa] at a temperature [deg C].
double saturated_hpa(double temperature_c) {
  return 6.1121 * std::exp((18.678 - temperature_c / 234.5) * temperature_c / (temperature_c + 257.14));
}

// `vapour_hpa`: pressure of water vapour, a part of the pressure.
double refractivity_of(double pressure_hpa, double temperature_c, double vapour_hpa) {
  const double kelvin = temperature_c + 273.15;
  return 77.6 * (pressure_hpa - vapour_hpa) / kelvin + 72.0 * vapour_hpa / kelvin +
         3.75e5 * vapour_hpa / (kelvin * kelvin);
}

// The columns of a file, by name.
class Columns {
 public:
  Columns(std::string_view heading) {
    const auto names = text::fields_of(heading, ',');
    for (std::size_t i = 0; i < names.size(); ++i) at_[file::lower_case(std::string(names[i]))] = i;
  }
  bool has(const std::string& name) const { return at_.contains(name); }
  bool complete() const {
    return has("height_m") && (has("refractivity") || (has("pressure_hpa") && has("temperature_c") &&
                                                       (has("dewpoint_c") || has("humidity_percent"))));
  }
  void use(std::string_view line) { fields_ = text::fields_of(line, ','); }
  // nullopt: the field is empty or no number.
  std::optional<double> number(const std::string& name) const {
    const auto found = at_.find(name);
    if (found == at_.end() || found->second >= fields_.size()) return std::nullopt;
    return text::finite_number(fields_[found->second]);
  }
  std::optional<double> refractivity() const {
    if (has("refractivity")) return number("refractivity");
    const auto pressure = number("pressure_hpa"), temperature = number("temperature_c");
    const auto wet = number(has("dewpoint_c") ? "dewpoint_c" : "humidity_percent");
    if (!pressure || !temperature || !wet) return std::nullopt;
    const double vapour_hpa = has("dewpoint_c") ? saturated_hpa(*wet) : 0.01 * *wet * saturated_hpa(*temperature);
    return refractivity_of(*pressure, *temperature, vapour_hpa);
  }

 private:
  std::map<std::string, std::size_t> at_;
  std::vector<std::string_view> fields_;
};

FittedProfile fitted(const std::vector<Level>& levels) {
  double weights = 0.0, heights = 0.0, logs = 0.0, squares = 0.0, products = 0.0;
  for (const Level& level : levels) {
    const double weight = level.refractivity * level.refractivity, height_km = 0.001 * level.height_m;
    const double log = std::log(level.refractivity);
    weights += weight;
    heights += weight * height_km;
    logs += weight * log;
    squares += weight * height_km * height_km;
    products += weight * height_km * log;
  }
  const double slope = (weights * products - heights * logs) / (weights * squares - heights * heights);
  return {std::exp((logs - slope * heights) / weights), -slope};
}
}  // namespace

error::Expected<FittedProfile> profile_of_sounding(const std::string& path) {
  const auto text = file::read_text_file(path);
  if (!text) return tl::unexpected(text.error());
  const auto lines = text::numbered_lines(*text);
  Columns columns(lines.empty() ? std::string_view() : lines.front().text);
  if (!columns.complete())
    return error::fail(path, "columns height_m, and refractivity or pressure_hpa, temperature_c and dewpoint_c",
                       lines.empty() ? "no line" : text::shortened(lines.front().text),
                       "name the columns in the first line");
  std::vector<Level> levels;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    columns.use(lines[i].text);
    const auto height_m = columns.number("height_m"), refractivity = columns.refractivity();
    if (!height_m || !refractivity || !(*refractivity > 0.0)) continue;
    const std::string line = file::line_location(path, lines[i].number);
    if (!levels.empty() && *height_m <= levels.back().height_m)
      return error::fail(line, "heights that ascend", std::string(lines[i].text), "sort the levels by height");
    if (!levels.empty()) {
      const double fall = 1000.0 * (levels.back().refractivity - *refractivity) / (*height_m - levels.back().height_m);
      if (fall > kDuctPerKm)
        return error::fail(line, "refractivity that falls by at most 157 N-units per km",
                           "a duct: it falls by " + std::to_string(std::lround(fall)) + " per km",
                           "leave the level out, or give refractivity and refractivityPerKm");
    }
    levels.push_back({*height_m, *refractivity});
  }
  constexpr std::size_t kLeast = 5;
  if (levels.size() < kLeast)
    return error::fail(path, "at least 5 levels with all values", std::to_string(levels.size()), "give more levels");
  const FittedProfile fit = fitted(levels);
  if (!(fit.refractivity <= 450.0 && fit.per_km >= 0.05 && fit.per_km <= 0.25))
    return error::fail(path, "a profile with at most 450 N-units at sea level that fall by 0.05 to 0.25 per km",
                       std::to_string(fit.refractivity) + " and " + std::to_string(fit.per_km),
                       "check the units of the columns");
  return fit;
}

}  // namespace yars::config
