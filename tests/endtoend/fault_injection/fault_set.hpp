// The set under fault injection: six roles with a terrain folder, a scene, a configuration and a script, external
// programs beside them, and a seeded random generator. mend() restarts dead roles, as scripts/start does, and
// counts restarts. A death that no fault has caused is reported as a problem.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "tests/endtoend/fault_injection/private_memory.hpp"
#include "tests/endtoend/fault_injection/watch.hpp"
#include "tests/endtoend/process_set.hpp"

namespace yars::endtoend::fault_injection {

inline const std::vector<std::string> kRoles{"state-machine", "radar-model",   "flight-model",
                                             "radar-display", "input-monitor", "recorder"};

// Resources of a process.
struct Held {
  double memory_mib = 0.0;  // resident
  int handles = 0;          // open files
  int threads = 0;
};

class FaultSet {
 public:
  explicit FaultSet(std::uint64_t seed);
  ~FaultSet();

  void start_all();
  ProcessSet& processes() { return set_; }
  Watch& watch() { return *watch_; }
  bool alone_in_memory() const { return memory_.is_private(); }  // /dev/shm is this test's own, and small

  // Sends SIGKILL and waits for the death, which mend() then does not report.
  void kill(const std::string& role);
  // Until the next recovery mend() does not report that the role ended by itself with exit code 1.
  void may_fail(const std::string& role) { may_fail_.insert(role); }
  // Restarts the roles that have ended. Reports unexpected ends.
  void mend();
  // Brings the set back to RBM at its initial position, and waits until pictures, sweeps and applied events continue.
  // Result: the time it took [s]; -1 if it took longer than `timeout_s`.
  double recover(double timeout_s);
  std::string signs_of_life() const;  // text for failure messages

  // Starts fault_client.c with a mode and its number. Result: its name in processes().
  std::string client(const std::string& mode, double number);
  // Kills a client by SIGKILL and waits for its end.
  void end_client(const std::string& name);
  // Runs a program of the build to its end. The command names the session, if any.
  Finished other(const std::vector<std::string>& command) const;

  double between(double least, double most);  // random number
  std::size_t below(std::size_t count);       // random index
  void rest_ms(double least, double most);    // waits for a random time
  std::mt19937_64& chance() { return chance_; }

  std::map<std::string, Held> held() const;
  void tell(const std::string& problem) { problems_.push_back(problem); }  // reports a problem
  const std::vector<std::string>& problems() const { return problems_; }
  std::uint64_t restarts() const { return restarts_; }
  const std::filesystem::path& terrain() const { return terrain_; }
  const std::filesystem::path& scene() const { return scene_; }
  const std::filesystem::path& configuration() const { return configuration_; }
  std::filesystem::path cell() const { return terrain_ / "N37W123.hgt"; }

 private:
  void write_files();
  void start(const std::string& role);
  bool is_away() const;  // the aircraft has left the area of the terrain

  PrivateMemory memory_;
  ProcessSet set_;
  std::filesystem::path terrain_, scene_, configuration_, script_;
  std::mt19937_64 chance_;
  std::set<std::string> killed_, may_fail_;
  std::vector<std::string> problems_;
  std::uint64_t restarts_ = 0;
  std::uint32_t mark_ = 0;
  std::unique_ptr<Watch> watch_;
};

void write_text(const std::filesystem::path& path, const std::string& text);
std::string text_of(const std::filesystem::path& path);

}  // namespace yars::endtoend::fault_injection
