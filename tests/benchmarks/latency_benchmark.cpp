// Benchmark of button latency [ms]: from the push of an event to the published radar state, and to the frame on the
// display. For comparison it measures how late a sleep of 5 ms wakes up.
// Joins a running session (state-machine and radar-display in a window) and toggles declutter (PB 2, DCL).
//  Usage: latency_benchmark [SESSION [EVENTS]]; defaults: default, 300
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

#include "databuffer/messages/input_event.hpp"
#include "databuffer/session/session.hpp"

namespace {

using namespace yars;
using databuffer::monotonic_ns;

constexpr std::int64_t kTimeout_ns = 2'000'000'000;
constexpr std::int64_t kPollInterval_ns = 50'000;  // time between two polls: the resolution of the measurement

void pause(std::int64_t ns) {
  const timespec time{0, ns};
  nanosleep(&time, nullptr);
}

// Version (low 32 bits) of the radar state in the newest frame of radar-display.
std::uint32_t shown_on_display(const databuffer::Session& session) {
  for (const auto& process : session.processes())
    if (process.name == "radar-display") return process.progress;
  return 0;
}

// Time [ms] until the condition holds; negative: it did not hold within kTimeout_ns.
template <class Condition>
double wait_ms(std::int64_t began_ns, const Condition& condition) {
  while (!condition()) {
    if (monotonic_ns() - began_ns > kTimeout_ns) return -1.0;
    pause(kPollInterval_ns);
  }
  return static_cast<double>(monotonic_ns() - began_ns) * 1e-6;
}

void print_row(const char* name, std::vector<double> values) {
  const auto lost = std::erase_if(values, [](double value) { return value < 0.0; });
  std::sort(values.begin(), values.end());
  if (values.empty()) {
    std::printf("%-24s nothing arrived\n", name);
    return;
  }
  const auto percentile = [&](double share) {
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
  };
  std::printf("%-24s p50 %7.2f  p99 %7.2f  max %7.2f ms  (%zu, %zu lost)\n", name, percentile(0.5), percentile(0.99),
              values.back(), values.size(), static_cast<std::size_t>(lost));
}

}  // namespace

int main(int argc, char** argv) {
  const std::string name = argc > 1 ? argv[1] : "default";
  const int count = argc > 2 ? std::atoi(argv[2]) : 300;
  auto session = databuffer::Session::open(name, "latency-benchmark");
  if (!session) return std::fprintf(stderr, "%s\n", session.error().message().c_str()), 1;
  auto lane = session->claim_input_lane("latency-benchmark");
  if (!lane) return std::fprintf(stderr, "%s\n", lane.error().message().c_str()), 1;
  auto event = *databuffer::event_from_text("pb 2");
  std::vector<double> state_ms, frame_ms, sleeper_ms;
  const auto& states = session->layout().radar_state;
  for (int i = 0; i < count; ++i) {
    pause(20'000'000 + (i * 7919) % 10'000'000);  // 20 to 30 ms, so that events are not in step with tick or frame
    const std::int64_t sleep_ns = monotonic_ns();
    pause(5'000'000);
    sleeper_ms.push_back(static_cast<double>(monotonic_ns() - sleep_ns) * 1e-6 - 5.0);
    const std::uint64_t version = states.version();
    const std::int64_t began_ns = monotonic_ns();
    event.monotonic_ns = began_ns;
    event.number = static_cast<std::uint32_t>(i + 1);
    session->layout().input.push(static_cast<std::size_t>(lane->lane()), event);
    state_ms.push_back(wait_ms(began_ns, [&] { return states.version() > version; }));
    const auto published_version = static_cast<std::uint32_t>(states.version());
    frame_ms.push_back(wait_ms(
        began_ns, [&] { return static_cast<std::int32_t>(shown_on_display(*session) - published_version) >= 0; }));
  }
  print_row("event to radar state", state_ms);
  print_row("event to frame", frame_ms);
  print_row("5 ms sleeper, late by", sleeper_ms);
  return 0;
}
