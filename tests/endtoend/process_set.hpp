// A set of YARS processes under test, started from the build's bin folder in a separate session. The destructor ends
// the processes and cleans up. All waits have a watchdog.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace yars::endtoend {

struct Finished {
  int code = -1;       // exit code; 128 + signal when killed; -1: it had to be killed by the watchdog
  std::string output;  // standard output
  std::string errors;  // standard error
};

// Runs a program of the bin folder to its end.
Finished run_program(const std::vector<std::string>& command, double timeout_s = 60.0);
// Runs a program of the system, found by PATH.
Finished run_tool(const std::vector<std::string>& command, double timeout_s = 60.0);
bool tool_exists(const std::string& name);

class ProcessSet {
 public:
  // `session` is made unique by the process id; the folder is fresh and removed at the end.
  explicit ProcessSet(const std::string& session);
  ~ProcessSet();
  ProcessSet(const ProcessSet&) = delete;
  ProcessSet& operator=(const ProcessSet&) = delete;

  const std::string& session() const { return session_; }
  const std::filesystem::path& folder() const { return folder_; }

  // Starts a role under its name; its standard error goes to folder()/NAME.log.
  void start(const std::string& name, std::vector<std::string> arguments);
  // A program of the system that the test needs beside the set, found by PATH; no --session.
  void start_tool(const std::string& name, const std::vector<std::string>& command);
  void kill(const std::string& name, int signal);
  // Waits for the end of one process; exit code as in Finished.
  int wait(const std::string& name, double timeout_s = 60.0);
  bool runs(const std::string& name);
  // Collects the end of a process and starts it again as before; gives the end's exit code.
  int start_again(const std::string& name);
  pid_t pid(const std::string& name) const { return pids_.at(name); }
  std::string log_of(const std::string& name) const;
  std::string output_of(const std::string& name) const;
  // Ends all with SIGTERM; gives the exit codes.
  std::map<std::string, int> end_all();

  Finished yars(std::vector<std::string> arguments, double timeout_s = 60.0) const;
  nlohmann::json watch() const;  // one object of `yars watch --json --once`; null when there is no session
  // Looks until the condition holds; false when the patience is over.
  bool wait_until(const std::function<bool(const nlohmann::json&)>& condition, double timeout_s = 60.0) const;
  bool segment_exists() const;

 private:
  std::string session_;
  std::filesystem::path folder_;
  std::map<std::string, pid_t> pids_;
  std::map<std::string, std::vector<std::string>> commands_;  // by name, as last started
};

// The real data beside the checkout; empty where it is absent.
std::filesystem::path shared_data();

// Polls every 10 ms.
bool eventually(const std::function<bool()>& condition, double timeout_s);

}  // namespace yars::endtoend
