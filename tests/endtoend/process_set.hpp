// A set of YARS processes under test, started from the build's bin folder in a session of its own. The destructor kills
// the processes and removes their files. All waits have a timeout.
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
  int code = -1;       // exit code; 128 + signal number if killed; -1: killed after the timeout
  std::string output;  // standard output
  std::string errors;  // standard error
};

// Runs a program of the bin folder to its end.
Finished run_program(const std::vector<std::string>& command, double timeout_s = 60.0);
// Runs any other program to its end: a path, or a name that PATH has.
Finished run_tool(const std::vector<std::string>& command, double timeout_s = 60.0);
bool tool_exists(const std::string& name);

// Reasons of `yars status --json` why the set is not OK, but those of a slow machine: no test depends on its speed. A
// status that is null is a fault, too.
std::vector<std::string> faults_in(const nlohmann::json& status);

class ProcessSet {
 public:
  // The name of the session is `session` and the process id. folder() is new and empty; the destructor removes it.
  explicit ProcessSet(const std::string& session);
  ~ProcessSet();
  ProcessSet(const ProcessSet&) = delete;
  ProcessSet& operator=(const ProcessSet&) = delete;

  const std::string& session() const { return session_; }
  const std::filesystem::path& folder() const { return folder_; }

  // Starts a program of the bin folder in the session. `arguments`: the program, then its arguments. `name` identifies
  // the process in the calls below. Its standard error goes to folder()/NAME.log. The environment variable
  // YARS_TEST_HOSTS, if set, is a command that is put before the program; it starts the program on another host
  // (tests/gateway/network_lockstep_test.py).
  void start(const std::string& name, std::vector<std::string> arguments);
  // Starts any other program: a path, or a name that PATH has. No --session is added.
  void start_tool(const std::string& name, const std::vector<std::string>& command);
  void kill(const std::string& name, int signal);
  // Waits for the end of one process. Result: exit code as in Finished.
  int wait(const std::string& name, double timeout_s = 60.0);
  bool runs(const std::string& name);
  // Waits for the end of a process, then starts it again with the same command. Result: exit code of the ended process.
  int start_again(const std::string& name);
  pid_t pid(const std::string& name) const { return pids_.at(name); }
  std::string log_of(const std::string& name) const;
  std::string output_of(const std::string& name) const;
  // Ends all processes by SIGTERM. Result: exit codes by name.
  std::map<std::string, int> end_all();

  Finished yars(std::vector<std::string> arguments, double timeout_s = 60.0) const;
  // True once the recorder of the session writes. As a process it is known some time before.
  bool is_recorded() const;
  // What `yars status --json` and `yars watch --json --once` print, without a process for each look; null when there is
  // no session.
  nlohmann::json status() const;
  nlohmann::json watch() const;
  // Calls watch() until the condition holds. False after the timeout.
  bool wait_until(const std::function<bool(const nlohmann::json&)>& condition, double timeout_s = 60.0) const;
  bool segment_exists() const;

 private:
  std::string session_;
  std::filesystem::path folder_;
  std::map<std::string, pid_t> pids_;
  std::map<std::string, std::vector<std::string>> commands_;  // by name, as last started
};

// Folder shared/data beside the checkout, with real terrain; empty if it does not exist.
std::filesystem::path shared_data();

// Evaluates the condition every 10 ms. False if it does not hold within the timeout.
bool eventually(const std::function<bool()>& condition, double timeout_s);

}  // namespace yars::endtoend
