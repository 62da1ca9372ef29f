#include "tools/trade/map_table.hpp"

namespace yars::tools::trade {

Values values_of(const MapCost& cost, const MapErrors& errors) {
  return {cost.map_ms,           cost.terrain_bytes, errors.position_m,
          errors.shadow_percent, errors.power_db,    errors.gray_levels};
}

SceneRow row_of(const MapView& view) {
  return {map_view_name(view),
          {view.place.latitude_deg, view.place.longitude_deg, view.altitude_ft, view.target.latitude_deg,
           view.target.longitude_deg, view.window_nm}};
}

}  // namespace yars::tools::trade
