#include "tools/trade/trade_table.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <span>

namespace yars::tools::trade {

namespace {

std::string number_text(double value, const char* format) {
  if (std::isnan(value)) return "-";
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), format, value);
  return text.data();
}

// Number without exponent. Decimals: three below 0.1, two below 10, one below 100, else none. 0 is "0"; else "<0.001"
// below 0.0005.
std::string shown_number(double value) {
  const double size = std::abs(value);
  if (size == 0.0) return "0";
  if (size < 0.0005) return "<0.001";
  return number_text(value, size < 0.1 ? "%.3f" : size < 10.0 ? "%.2f" : size < 100.0 ? "%.1f" : "%.0f");
}

std::string cell_text(const Summary& summary, double scale, bool many_scenes) {
  if (std::isnan(summary.mean)) return "-";
  std::string mean = shown_number(summary.mean * scale);
  if (!many_scenes) return mean;
  return mean + " / " + shown_number(summary.worst * scale) + " @" + std::to_string(summary.worst_scene + 1);
}

using Row = std::vector<std::string>;

std::string aligned(const std::vector<Row>& rows) {
  std::vector<std::size_t> widths(rows.front().size(), 3);
  for (const Row& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  std::string text;
  const auto add = [&](const Row& row) {
    for (std::size_t i = 0; i < row.size(); ++i)
      text += "| " + row[i] + std::string(widths[i] - row[i].size() + 1, ' ');
    text += "|\n";
  };
  add(rows.front());
  for (const std::size_t width : widths) text += "| " + std::string(width, '-') + " ";
  text += "|\n";
  for (const Row& row : std::span(rows).subspan(1)) add(row);
  return text;
}

}  // namespace

Summary summary_of(const TradeTable& table, std::size_t candidate, std::size_t column) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  Summary summary{kNone, kNone, 0};
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t scene = 0; scene < table.scenes.size(); ++scene) {
    const double value = table.values[candidate][scene][column];
    if (std::isnan(value)) continue;
    sum += value;
    ++count;
    const bool worse = table.columns[column].min_is_worst ? value < summary.worst : value > summary.worst;
    if (count > 1 && !worse) continue;
    summary.worst = value;
    summary.worst_scene = scene;
  }
  if (count > 0) summary.mean = sum / static_cast<double>(count);
  return summary;
}

std::string table_text(const TradeTable& table) {
  std::vector<Row> rows(1, Row{"point"});
  for (const Column& column : table.columns) rows.front().emplace_back(column.title);
  for (std::size_t candidate = 0; candidate < table.candidates.size(); ++candidate) {
    Row row{table.candidates[candidate].name};
    for (std::size_t column = 0; column < table.columns.size(); ++column) {
      const Summary summary = summary_of(table, candidate, column);
      row.push_back(cell_text(summary, table.columns[column].scale, table.scenes.size() > 1));
    }
    rows.push_back(std::move(row));
  }
  std::string text = aligned(rows) + "\n";
  for (std::size_t scene = 0; scene < table.scenes.size(); ++scene)
    text +=
        std::string("@").append(std::to_string(scene + 1)).append(": ").append(table.scenes[scene].name).append("\n");
  return text;
}

std::string csv_text(const TradeTable& table) {
  const auto exact = [](double value) { return std::isnan(value) ? std::string() : number_text(value, "%.9g"); };
  std::string text = "point,family,scene";
  for (const std::string_view name : table.scene_fields) text.append(",").append(name);
  for (const Column& column : table.columns) text.append(",").append(column.name);
  text += "\n";
  for (std::size_t candidate = 0; candidate < table.candidates.size(); ++candidate) {
    for (std::size_t i = 0; i < table.scenes.size(); ++i) {
      text += table.candidates[candidate].name + "," + table.candidates[candidate].family + "," + std::to_string(i + 1);
      for (const double value : table.scenes[i].numbers) text.append(",").append(exact(value));
      for (const double value : table.values[candidate][i]) text.append(",").append(exact(value));
      text += "\n";
    }
  }
  return text;
}

}  // namespace yars::tools::trade
