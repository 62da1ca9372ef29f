// The results of a trade, contender by contender and scene by scene, as a table for people, as CSV, and as mean and
// worst case over the scenes.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "tools/trade/contender.hpp"
#include "tools/trade/evidence.hpp"
#include "tools/trade/scene.hpp"

namespace yars::tools::trade {

enum class Column : std::size_t {
  scan_ms,
  samples_per_second,
  terrain_bytes,
  position_m,
  shadow_percent,
  power_db,
  gray_levels
};
inline constexpr std::array<std::string_view, 7> kColumnNames{
    "scan_ms", "samples_per_second", "terrain_bytes", "position_m", "shadow_percent", "power_db", "gray_levels"};

struct Cost {
  double scan_ms = 0.0;  // [ms] of the thread's processor time
  double samples_per_second = 0.0;
  double terrain_bytes = 0.0;  // resident
};

// By Column; NaN = nothing to compare.
using Values = std::array<double, kColumnNames.size()>;
Values values_of(const Cost& cost, const Errors& errors);

struct Summary {
  double mean = 0.0;   // over the scenes that have a number; NaN: none has
  double worst = 0.0;  // the greatest; of samples a second the least
  std::size_t worst_scene = 0;
};

struct TradeTable {
  std::vector<Contender> contenders;
  std::vector<Scene> scenes;
  std::vector<std::vector<Values>> values;  // [contender][scene]
};

Summary summary_of(const TradeTable& table, std::size_t contender, Column column);

// Markdown: a row a contender, "mean / worst @scene"; the scenes by number follow.
std::string table_text(const TradeTable& table);

// A row a contender and scene under one row of names; NaN is an empty field.
std::string csv_text(const TradeTable& table);

}  // namespace yars::tools::trade
