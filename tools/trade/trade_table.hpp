// Candidates of a trade (a run of `yars trade`), which are the fidelities to compare, and its result table: one value
// for each candidate, scene and column, with mean and worst case over the scenes. A scene here is the geometry of one
// scan or of one patch map.
// Outputs: text (Markdown) and CSV. Columns and scenes: scenes.hpp.
// Errors: an unknown name, or a value out of range, is an Error of bad usage that names the field of the request.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lib/error/error.hpp"
#include "lib/radar/fidelity.hpp"

namespace yars::tools::trade {

// A fidelity to compare: a preset, or a base preset with one knob changed. Presets and knobs have the names that a GUF
// file uses for presets and for slots of the form `Fidelity`.
struct Candidate {
  std::string name;    // "standard", "samples=240"
  std::string family;  // "preset" or the knob's name; a plot connects the points of one family
  radar::Fidelity fidelity;
};

// Candidates of a list of presets such as "1996,draft"; "all" = every preset, "none" = no preset.
// Errors: an unknown preset.
error::Expected<std::vector<Candidate>> preset_candidates(std::string_view list);

// The fidelity with its random parts off: speckle of scans and maps, texture of scans, brightness noise of 1996 maps.
// The mean power of thermal noise stays.
radar::Fidelity without_noise(radar::Fidelity fidelity);

// Kind of picture that a trade compares. knob_candidates() accepts only knobs that affect this kind.
enum class Subject : std::uint8_t { scan, map };

// Candidates of a knob's values such as "samples=120,240". Errors: an unknown knob, a value out of the knob's range.
error::Expected<std::vector<Candidate>> knob_candidates(std::string_view sweep, const radar::Fidelity& base,
                                                        Subject subject);

// Candidates of lists of presets (none: all) and of knobs, of which each changes the preset `base`. Throws
// radar::Failure for those that are not valid, or if there is no candidate.
std::vector<Candidate> candidates_of(const std::vector<std::string>& presets, const std::vector<std::string>& knobs,
                                     const std::string& base, Subject subject);

// Root mean square of the added values; NaN when there are none.
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

struct Column {
  std::string_view name;      // heading in CSV and JSON, with its unit
  std::string_view title;     // heading in the text table
  double scale = 1.0;         // the text table shows value * scale
  bool min_is_worst = false;  // true: larger values are better
};

// Name of a scene, and its numbers in the order of TradeTable::scene_fields.
struct SceneRow {
  std::string name;
  std::vector<double> numbers;
};

// One value for each column; NaN: this scene gives no value for the column.
using Values = std::vector<double>;

struct Summary {
  double mean = 0.0;            // mean over the scenes with a value; NaN: no scene has a value
  double worst = 0.0;           // the smallest value if Column::min_is_worst, else the largest
  std::size_t worst_scene = 0;  // index of the scene with the worst value
};

// Axes of two plots of the table: time on the x axis, one of the two errors on the y axis.
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

// Mean and worst value of one column of one candidate over all scenes.
Summary summary_of(const TradeTable& table, std::size_t candidate, std::size_t column);

// Markdown table with one row for each candidate, then a numbered list of the scenes. A field reads "mean / worst
// @number of the worst scene"; with a single scene the field is that scene's value. "-" stands for NaN.
std::string table_text(const TradeTable& table);

// CSV with a header and one row for each candidate and scene; NaN is an empty field.
std::string csv_text(const TradeTable& table);

}  // namespace yars::tools::trade
