// Common parts of `yars trade` and `yars trade maps`: options, candidates, clock, output files.
// Errors: functions that check options, read a directory or write files throw CommandFailed.
#pragma once

#include <string>
#include <vector>

#include "databuffer/runtime/command_line.hpp"
#include "lib/geo/geodesy.hpp"
#include "tools/command/command.hpp"
#include "tools/trade/candidate.hpp"
#include "tools/trade/trade_table.hpp"

namespace yars::radar {
struct RadarConfiguration;
}  // namespace yars::radar

namespace yars::tools {

struct TradeOptions {
  ConfigurationOptions configuration;
  std::string csv, out;
  std::string presets = "all", base = "standard", ruler = "reference";
  std::vector<std::string> knobs;
  int repeat = 5;
  bool json = false;
};

void add_trade_options(databuffer::Command command, TradeOptions& options);

// Call before the measurement. Throws if the name in --out or --csv does not end in .json or .csv, or if that file
// cannot be created.
void check_trade_output(const TradeOptions& options);
// The candidates of --presets and --knob. Throws if an option is not valid or there is no candidate.
std::vector<trade::Candidate> candidates_of(const TradeOptions& options, trade::Subject subject);
// Writes the table, or JSON with --json, to standard output. Also writes the files of --csv and --out.
void write_trade(const TradeOptions& options, const trade::TradeTable& table, const trade::PlotAxes& axes);

// Centre of the cell in the middle of a directory's index, which is sorted from south to north, then from west to east.
// For an empty name (built-in hills): 37 N 122 W. Throws if the directory is missing or has no usable cell.
geo::GeoPoint default_position(const std::string& directory);
double thread_ms();  // [ms] CPU time of the calling thread

// `yars trade maps`.
void add_trade_maps(databuffer::Command trade, const CommonOptions& common);

}  // namespace yars::tools
