// Sets of programs that the instructor's page starts beside the set of the session: replays of recordings, flights that
// go on from a recorded second, the recorder.
// Inputs: commands; the folder of the recordings; the folder of the programs.
// Outputs: processes in sessions of their own, whose display publishes frames; the list of recordings as JSON.
// Errors: a file that the list did not name, more than kMaxSets sets, a program that cannot be started. What a program
//   says of its failure is kept for the page.
// Threads: one. The processes end with the station.
// Source: docs/station.md#time-machine.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "lib/error/error.hpp"
#include "lib/file/folder.hpp"

namespace boost::asio {
class io_context;
}  // namespace boost::asio

namespace yars::station {

struct SetSettings {
  std::string session;                 // of the station
  std::filesystem::path programs;      // folder of yars and radar-display
  std::filesystem::path recordings;    // folder of the recordings
  std::string config, terrain;         // of the station; empty: the programs' defaults
  std::filesystem::path start_script;  // flies out of a recording; empty: that of the installation or the source tree
};

class SetsShell {
 public:
  static constexpr std::size_t kMaxSets = 6;
  static constexpr int kMaxListed = 1000;  // recordings

  SetsShell(boost::asio::io_context& context, SetSettings settings);
  ~SetsShell();
  SetsShell(const SetsShell&) = delete;
  SetsShell& operator=(const SetsShell&) = delete;

  // Starts a replay that begins at a sim time [s]. Returns the name of its session.
  error::Expected<std::string> play(const std::string& file, double at_s);
  // Starts a live set that goes on from a recorded second [s]. Returns the name of its session.
  error::Expected<std::string> fly_out(const std::string& file, double at_s);
  // Starts a recorder of the station's session, in a new file of the folder of the recordings. `one_runs`: the session
  // has a recorder already, an error. A recorder that fails stays among the sets, with its reason.
  error::Expected<void> record(bool one_runs);
  error::Expected<void> end(const std::string& session);

  // Reads the newest kMaxListed recordings of the folder: `then` gets the object of `yars recordings --json`, or an
  // object with "problem". Callers that come while a list is read get that list.
  void list_recordings(std::function<void(nlohmann::ordered_json)> then);

  // Collects processes that have ended. True if the list of sets has changed.
  bool look();
  // [{"session", "kind": "replay", "branch" or "recorder", "file", "at", "ended": null or a text}]
  nlohmann::ordered_json sets() const;
  // True for the station's own session and those of its sets.
  bool has_session(const std::string& name) const;

 private:
  struct Process {
    int pid = 0;
    file::Descriptor log;  // its output, in memory
  };
  struct StartedSet {
    std::string session, kind, file;
    double at_s = 0.0;
    std::vector<Process> processes;
    std::string ended;
    bool failed = false;  // its first process that ended by itself had an exit code other than 0
  };
  struct Listing;
  void end_listing(bool whole);
  static error::Expected<Process> start(const std::vector<std::string>& command);
  error::Expected<void> check_file(const std::string& file) const;
  std::string new_session(const std::string& kind);
  std::filesystem::path start_script() const;
  void signal(const StartedSet& set, int number) const;

  boost::asio::io_context& context_;
  SetSettings settings_;
  std::set<std::string> listed_;      // files of the last list
  std::unique_ptr<Listing> listing_;  // the list that is read
  std::vector<int> ending_;           // processes that look() collects when they have ended
  std::vector<StartedSet> sets_;
  int next_ = 1;
  bool changed_ = false;
};

}  // namespace yars::station
