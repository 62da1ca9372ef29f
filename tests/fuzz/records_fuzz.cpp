// Any bytes in a segment: each reader completes its step, and neither accepts nor publishes a record out of range.
// Readers: clock, receivers, state machine, display, flight model, recorder, and the output of `yars status`.
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "config/schema/load.hpp"
#include "databuffer/json/status_json.hpp"
#include "databuffer/messages/validation.hpp"
#include "databuffer/session/receivers.hpp"
#include "display/host/session_link_shell.hpp"
#include "display/symbology/plan_view.hpp"
#include "display/symbology/radar_video.hpp"
#include "display/symbology/symbology.hpp"
#include "flightmodel/app/flight_shell.hpp"
#include "flightmodel/source_reader.hpp"
#include "lib/error/error.hpp"
#include "statemachine/app/state_machine_shell.hpp"
#include "tests/fuzz/overlaid_session.hpp"
#include "tools/session/recorder.hpp"
#include "tools/session/status_text.hpp"

namespace {

using namespace yars;
using namespace yars::databuffer;

constexpr int kFlightLane = 3;

const radar::RadarConfiguration& configuration() {
  static const auto loaded = *config::load_configuration_text("", "built-in");
  return loaded.radar;
}

void require_good(const Refusal& refusal) {
  YARS_REQUIRE(refusal.value_or(""), ==, "");
}

// The readers of one input: the shells of all roles except radar-model and input-monitor.
class Readers {
 public:
  Readers(Session session, std::string name)
      : name_(std::move(name)),
        session_(std::move(session)),
        machine_(session_, configuration(), false),
        feed_(
            session_, false, [this](const Sweep& sweep) { take(sweep); },
            [](const PatchMap& map, std::span<const std::uint8_t> pixels) {
              require_good(validate(map));
              YARS_REQUIRE(pixels.size(), ==, patch_bytes(map));
            }),
        flight_(session_, *flightmodel::open_source("fixed:36.6,-121.9,20000,0,400"), kFlightLane, false),
        writer_(*recording::RecordingWriter::create("/dev/null", {})),
        recorder_(session_, writer_, {.sweeps = true, .patches = true, .flight_source = {}}, true) {}

  void step() {
    const ClockState clock = session_.clock();
    require_good(validate(clock));
    const std::int64_t sim_time_ns = session_.sim_time_ns();
    YARS_REQUIRE(sim_time_ns, >=, 0);
    const std::int64_t tick = sim_time_ns / radar::kTickNanoseconds;
    const runtime::TickLoop::Due due{tick, tick * radar::kTickNanoseconds, clock, 0, epoch_ != clock.epoch};
    epoch_ = clock.epoch;
    receive(due);
    flight_.step(due);
    step_machine(due);
    draw(due.sim_time_ns);
    recorder_.drain(tick);
    read_status_and_frame();
  }

 private:
  const SessionLayout& layout() const { return session_.layout(); }

  void step_machine(const runtime::TickLoop::Due& due) {
    const std::uint64_t before = layout().radar_state.version();
    machine_.step(due);
    RadarState state{};
    if (layout().radar_state.version() != before && layout().radar_state.read(state)) require_good(validate(state));
  }

  void receive(const runtime::TickLoop::Due& due) {
    const auto& selected = ownship_.refresh(layout(), due.sim_time_ns, due.clock.epoch);
    if (selected.valid && selected.lane != kNoLane) {
      require_good(validate(selected.ownship));
      require_good(validate(selected.nav));
    }
    traffic_.refresh(layout(), due.tick, due.sim_time_ns, due.clock.epoch);
    require_good(validate(traffic_.latched()));
  }

  void take(const Sweep& sweep) {
    require_good(validate(sweep));
    store_.insert(sweep);
  }

  void draw(std::int64_t sim_time_ns) {
    feed_.refresh(sim_time_ns);
    list_.clear();
    const auto frame = display::present_frame(feed_.input(), store_.newest());
    const display::PlanView view(configuration().view);
    display::draw_symbology(feed_.input(), configuration(), view, frame, labels_, list_);
    for (std::size_t layer = 0; layer < display::kLayers; ++layer)
      for (const display::Segment& stroke : list_.content(static_cast<display::Layer>(layer)).strokes)
        for (const float number : {stroke.from.x, stroke.from.y, stroke.to.x, stroke.to.y})
          YARS_REQUIRE(std::isfinite(number), ==, true);
  }

  void read_status_and_frame() const {
    const auto session = Session::open_read_only(name_);
    if (!session) return;
    const databuffer::Status status = databuffer::status_of(*session, "fuzz");
    (void)databuffer::status_json(status).dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
    tools::print_status(status, {});
    GlassFrame frame{};
    std::vector<std::uint8_t> pixels;
    if (read_newest_frame(session->layout(), 0, frame, pixels)) YARS_REQUIRE(pixels.size(), ==, frame_bytes(frame));
  }

  std::string name_;
  Session session_;
  OwnshipReceiver ownship_;
  TrafficReceiver traffic_;
  statemachine::StateMachineShell machine_;
  display::PolarStore store_;
  display::SessionFeed feed_;
  display::LabelMemory labels_;
  display::DrawList list_;
  flightmodel::FlightShell flight_;
  recording::RecordingWriter writer_;
  tools::Recorder recorder_;
  std::uint32_t epoch_ = 0;
};

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* /*count*/, char*** /*arguments*/) {
  // The output of `yars status` is discarded.
  return std::freopen("/dev/null", "w", stdout) == nullptr ? 1 : 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static fuzz::OverlaidSession session("fuzz-" + std::to_string(getpid()));
  std::optional<Readers> readers;
  session.play({data, size}, [&] {
    // A session with an invalid clock cannot be opened.
    if (!readers)
      if (auto opened = Session::open(session.name(), "reader")) readers.emplace(std::move(*opened), session.name());
    if (readers) readers->step();
  });
  readers.reset();
  session.put_back();
  return 0;
}
