// The set under fault injection: six roles with a terrain folder, a scene, a configuration and a script, external
// programs beside them, and a seeded random generator. mend() restarts dead roles, as scripts/supervise does, and
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

// What a process has of the machine.
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

  // SIGKILL, and waits until it is dead; the death is one that mend() expects.
  void kill(const std::string& role);
  // The role may end by itself, with exit code 1 and one line on why.
  void may_fail(const std::string& role) { may_fail_.insert(role); }
  // Starts again what has ended.
  void mend();
  // Waits until pictures, sweeps and applied events go on, at the set's own place; the seconds it took, < 0: not
  // within the patience.
  double recover(double timeout_s);
  std::string signs_of_life() const;  // for people

  // A program of somebody else's, see fault_client.c; the name under which to kill it.
  std::string client(const std::string& mode, double number);
  // Kills such a program and collects it.
  void end_client(const std::string& name);
  // Starts a program of the build's in another session or without one, and waits for its end.
  Finished other(const std::vector<std::string>& command) const;

  double between(double least, double most);
  std::size_t below(std::size_t count);
  void rest_ms(double least, double most);  // a random time
  std::mt19937_64& chance() { return chance_; }

  std::map<std::string, Held> held() const;
  void tell(const std::string& problem) { problems_.push_back(problem); }
  const std::vector<std::string>& problems() const { return problems_; }
  std::uint64_t restarts() const { return restarts_; }
  const std::filesystem::path& terrain() const { return terrain_; }
  const std::filesystem::path& scene() const { return scene_; }
  const std::filesystem::path& configuration() const { return configuration_; }
  std::filesystem::path cell() const { return terrain_ / "N37W123.hgt"; }

 private:
  void write_files();
  void start(const std::string& role);
  bool is_away() const;  // from where its terrain is

  PrivateMemory memory_;
  ProcessSet set_;
  std::filesystem::path terrain_, scene_, configuration_, script_;
  std::mt19937_64 chance_;
  std::set<std::string> killed_, may_fail_;
  std::vector<std::string> problems_;
  std::uint64_t restarts_ = 0;
  std::uint32_t mark_ = 0;
  std::uint32_t clients_ = 0;
  std::unique_ptr<Watch> watch_;
};

void write_text(const std::filesystem::path& path, const std::string& text);
std::string text_of(const std::filesystem::path& path);

}  // namespace yars::endtoend::fault_injection
