// What `yars trade` and `yars trade maps` share: which candidates, which clock, where the table goes.
#pragma once

#include <string>
#include <vector>

#include "lib/geo/geodesy.hpp"
#include "lib/radar/configuration.hpp"
#include "tools/command/command.hpp"
#include "tools/trade/candidate.hpp"
#include "tools/trade/trade_table.hpp"

namespace yars::tools {

struct TradeOptions {
  std::string terrain, csv, out;
  std::string presets = "all", base = "standard", ruler = "reference";
  std::vector<std::string> knobs;
  int repeat = 5;
  bool json = false;
};

void add_trade_options(CLI::App& command, TradeOptions& options);

// Before the work: a name that no writer knows.
void check_trade_output(const TradeOptions& options);
radar::RadarConfiguration trade_configuration(const CommonOptions& common, const TradeOptions& options);
std::vector<trade::Candidate> candidates_of(const TradeOptions& options, trade::Subject subject);
// Table or JSON to standard output, CSV and JSON to files as asked.
void write_trade(const TradeOptions& options, const trade::TradeTable& table, const trade::PlotAxes& axes);

// The middle one of a directory's cells, so that there is ground about it; the built-in hills are everywhere.
geo::GeoPoint default_place(const std::string& directory);
double thread_ms();  // [ms] processor time of this thread
double median_of(std::vector<double> values);

// `yars trade maps`.
void add_trade_maps(CLI::App& trade, const CommonOptions& common);

}  // namespace yars::tools
