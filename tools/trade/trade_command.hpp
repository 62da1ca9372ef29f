// Measurements of `yars trade` and `yars trade maps`, which the Python module shares.
// Inputs: a request, a folder of terrain. Outputs: a table of errors and costs, as JSON or a file.
// Errors: functions that measure, read a directory or write files throw radar::Failure.
#pragma once

#include <string>
#include <vector>

#include "lib/geo/geodesy.hpp"
#include "lib/parallel/thread_pool.hpp"
#include "tools/command/command.hpp"
#include "tools/trade/trade_table.hpp"
#include "yars/requests.hpp"

namespace yars::radar {
struct RadarConfiguration;
}  // namespace yars::radar

namespace yars::tools {

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

// Writes the files whose names are not empty.
void write_trade_files(const std::string& csv, const std::string& out, const TradeResult& result);

// Centre of the cell in the middle of a directory's index, which is sorted from south to north, then from west to east.
// For an empty name (built-in hills): 37 N 122 W. Throws if the directory is missing or has no usable cell.
geo::GeoPoint default_position(const std::string& directory);
// Throws unless the aircraft of a scene or view is above the ground. `field`: of the request. `ground_m` [m] MSL; NaN:
// void, which is not checked.
void check_above_ground(const char* field, geo::AltitudeMsl altitude, double ground_m);
double thread_ms();  // [ms] CPU time of the calling thread

}  // namespace yars::tools
