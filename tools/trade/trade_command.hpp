// `yars trade` and `yars trade maps`: options, measurement, output. The Python module measures with the same functions.
// Inputs: options of the commands, a folder of terrain. Outputs: a table of errors and costs, as text, JSON or a file.
// Errors: functions that check options, measure, read a directory or write files throw CommandFailed.
#pragma once

#include <string>
#include <vector>

#include "lib/geo/geodesy.hpp"
#include "lib/parallel/thread_pool.hpp"
#include "runtime/command_line.hpp"
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

struct ScanTradeOptions : TradeOptions {
  std::vector<std::string> scenes;
  double width_deg = 100.0;
  int ruler_samples = 1024;
};
struct MapTradeOptions : TradeOptions {
  std::vector<std::string> views;
  int ruler_size = 480;
};

void add_trade_options(runtime::Command command, TradeOptions& options);  // those that both have
void add_scan_trade_options(runtime::Command command, ScanTradeOptions& options);
void add_map_trade_options(runtime::Command command, MapTradeOptions& options);

// What a trade found, and the axes of its plots.
struct TradeResult {
  trade::TradeTable table;
  trade::PlotAxes axes;
  std::vector<std::string> left_out = {};  // of terrain and scenes, one sentence each
};

// Measure all candidates. The fidelity of the configuration is not used. `warn` takes warnings about input files.
// Progress goes to standard error if that is a terminal. `goes_on` is asked between the steps of scans and maps; throws
// parallel::Stopped.
TradeResult measure_trade(const ScanTradeOptions& options, const radar::RadarConfiguration& configuration,
                          const Warn& warn, const parallel::GoesOn& goes_on = {});
TradeResult measure_trade(const MapTradeOptions& options, const radar::RadarConfiguration& configuration,
                          const Warn& warn, const parallel::GoesOn& goes_on = {});

// JSON object that --out writes and plot_trade reads. NaN becomes null. `left_out` is that of the result.
std::string json_text(const TradeResult& result);

// Call before the measurement. Throws if the name in --out or --csv does not end in .json or .csv, or if that file
// cannot be created.
void check_trade_output(const TradeOptions& options);
// The candidates of --presets and --knob. Throws if an option is not valid or there is no candidate.
std::vector<trade::Candidate> candidates_of(const TradeOptions& options, trade::Subject subject);
// Writes the files of --csv and --out.
void write_trade_files(const TradeOptions& options, const TradeResult& result);
// Writes the files, and the table, or JSON with --json, to standard output. Then throws CommandFailed if something was
// left out of terrain or scenes.
void write_trade(const TradeOptions& options, const TradeResult& result);

// Centre of the cell in the middle of a directory's index, which is sorted from south to north, then from west to east.
// For an empty name (built-in hills): 37 N 122 W. Throws if the directory is missing or has no usable cell.
geo::GeoPoint default_position(const std::string& directory);
double thread_ms();  // [ms] CPU time of the calling thread

// `yars trade maps`.
void add_trade_maps(runtime::Command trade, const CommonOptions& common);

}  // namespace yars::tools
