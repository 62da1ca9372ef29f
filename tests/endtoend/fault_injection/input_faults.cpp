// Faults of input by yars.h: floods of records, and invalid records.
#include "tests/endtoend/fault_injection/fault_set.hpp"
#include "tests/endtoend/fault_injection/faults.hpp"

namespace yars::endtoend::fault_injection {

namespace {

void flood(FaultSet& set, const std::string& mode, double rate_hz) {
  const auto client = set.client(mode, rate_hz);
  set.rest_ms(200.0, 600.0);
  set.end_client(client);
}

void flood_events(FaultSet& set, const std::string&) {
  flood(set, "push", 0.0);
}

void flood_ownship(FaultSet& set, const std::string&) {
  flood(set, "fly", 10'000.0);
}

void hostile(FaultSet& set, const std::string& mode) {
  constexpr double kRecords = 600.0;
  const auto client = set.client(mode, kRecords);
  // Code 1: no lane was free.
  if (const int code = set.processes().wait(client); code != 0 && code != 1)
    set.tell(mode + " ended with code " + std::to_string(code));
}

}  // namespace

std::vector<Fault> input_faults() {
  return {{"a flood of events", flood_events},
          {"ownship 10,000 times a second", flood_ownship},
          {"hostile ownship by a lane's owner", hostile, "bad-ownship"},
          {"hostile nav by a lane's owner", hostile, "bad-nav"},
          {"hostile events", hostile, "bad-events"},
          {"hostile traffic", hostile, "bad-traffic"}};
}

}  // namespace yars::endtoend::fault_injection
