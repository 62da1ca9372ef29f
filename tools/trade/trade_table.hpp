// Results of a trade, candidate by candidate and scene by scene, and their statistics.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tools/trade/candidate.hpp"

namespace yars::tools::trade {

// Mean square of what is added, as its root; NaN of nothing.
class RootMeanSquare {
 public:
  void add(double value) {
    sum_ += value * value;
    ++count_;
  }
  double value() const {
    return count_ > 0 ? std::sqrt(sum_ / static_cast<double>(count_)) : std::numeric_limits<double>::quiet_NaN();
  }

 private:
  double sum_ = 0.0;
  std::size_t count_ = 0;
};

// The results of a trade, candidate by candidate and scene by scene, as a table for people, as CSV, and as mean and
// worst case over the scenes. Columns and scenes: scenes.hpp.
struct Column {
  std::string_view name;   // of CSV and JSON, with its unit
  std::string_view title;  // for people
  double scale = 1.0;      // of what people are shown
  bool least_is_worst = false;
};

// What is looked at: in words, and in the numbers that name it.
struct SceneRow {
  std::string name;
  std::vector<double> numbers;
};

// By column; NaN = nothing to compare.
using Values = std::vector<double>;

struct Summary {
  double mean = 0.0;  // over the scenes that have a number; NaN: none has
  double worst = 0.0;
  std::size_t worst_scene = 0;
};

// What a plot of the table shows: a column to the right, two upwards, and their titles.
struct PlotAxes {
  struct Axis {
    std::size_t column;
    std::string_view title;
  };
  Axis time;
  std::array<Axis, 2> errors;
};

struct TradeTable {
  std::span<const Column> columns;
  std::span<const std::string_view> scene_fields;  // names of a scene's numbers
  std::vector<Candidate> candidates;
  std::vector<SceneRow> scenes;
  std::vector<std::vector<Values>> values;  // [candidate][scene]
};

Summary summary_of(const TradeTable& table, std::size_t candidate, std::size_t column);

// Markdown: a row a candidate, "mean / worst @scene"; the scenes by number follow.
std::string table_text(const TradeTable& table);

// A row a candidate and scene under one row of names; NaN is an empty field.
std::string csv_text(const TradeTable& table);

}  // namespace yars::tools::trade
