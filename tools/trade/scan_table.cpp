#include "tools/trade/scan_table.hpp"

namespace yars::tools::trade {

Values values_of(const Cost& cost, const Errors& errors) {
  return {cost.scan_ms,          cost.samples_per_second, cost.terrain_bytes, errors.position_m,
          errors.shadow_percent, errors.power_db,         errors.gray_levels};
}

SceneRow row_of(const Scene& scene) {
  return {scene_name(scene),
          {scene.place.latitude_deg, scene.place.longitude_deg, scene.altitude_ft, scene.heading_deg, scene.range_nm}};
}

}  // namespace yars::tools::trade
