// `yars trade` and `yars trade maps`: options, measurement, output. The Python module measures with the same functions.
// Inputs: options of the commands, a folder of terrain. Outputs: a table of errors and costs, as text, JSON or a file.
// Errors: functions that check options, measure, read a directory or write files throw radar::Failure.
#pragma once

#include <string>
#include <vector>

#include "lib/geo/geodesy.hpp"
#include "lib/parallel/thread_pool.hpp"
#include "runtime/command_line.hpp"
#include "tools/command/command.hpp"
#include "tools/trade/trade_table.hpp"
#include "yars/requests.hpp"

namespace yars::radar {
struct RadarConfiguration;
}  // namespace yars::radar

namespace yars::tools {

// Options that are no fields of a request.
struct TradeOptions {
  ConfigurationOptions configuration;
  std::string csv, out;
  bool json = false;
};
// Adds these options, and names the values of those of the request, which stand before them.
void add_trade_options(runtime::Command command, TradeOptions& options);

// What a trade found, and the axes of its plots.
struct TradeResult {
  trade::TradeTable table;
  trade::PlotAxes axes;
  std::vector<std::string> left_out = {};  // of terrain and scenes, one sentence each
};

// Measure all candidates. The fidelity of the configuration is not used. `warn` takes warnings about input files.
// Progress goes to standard error if that is a terminal. `goes_on` is asked between the steps of scans and maps; throws
// parallel::Stopped.
TradeResult measure_trade(const ScanTradeRequest& request, const radar::RadarConfiguration& configuration,
                          const Warn& warn, const parallel::GoesOn& goes_on = {});
TradeResult measure_trade(const MapTradeRequest& request, radar::RadarConfiguration configuration, const Warn& warn,
                          const parallel::GoesOn& goes_on = {});

// JSON object that --out writes and plot_trade reads. NaN becomes null. `left_out` is that of the result.
std::string json_text(const TradeResult& result);

// Throws if the name in --out or --csv does not end in .json or .csv, or if that file cannot be created.
void check_trade_output(const TradeOptions& options);
// Writes the files whose names are not empty.
void write_trade_files(const std::string& csv, const std::string& out, const TradeResult& result);
// Writes the files, and the table, or JSON with --json, to standard output. Then throws if something was left
// out of terrain or scenes.
void write_trade(const TradeOptions& options, const TradeResult& result);

// Centre of the cell in the middle of a directory's index, which is sorted from south to north, then from west to east.
// For an empty name (built-in hills): 37 N 122 W. Throws if the directory is missing or has no usable cell.
geo::GeoPoint default_position(const std::string& directory);
double thread_ms();  // [ms] CPU time of the calling thread

// `yars trade maps`.
void add_trade_maps(runtime::Command trade, const CommonOptions& common);

}  // namespace yars::tools
