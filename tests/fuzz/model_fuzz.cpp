// Any bytes in the segment that radar-model reads: latched records, sweeps and model status pass validation.
#include <unistd.h>

#include <optional>

#include "config/schema/load.hpp"
#include "databuffer/messages/validation.hpp"
#include "lib/error/error.hpp"
#include "model/app/radar_model_shell.hpp"
#include "model/terrain/store/directory_store.hpp"
#include "tests/fuzz/overlaid_session.hpp"

namespace {

using namespace yars;
using namespace yars::databuffer;

radar::RadarConfiguration small_configuration() {
  auto loaded = *config::load_configuration_text("", "built-in");
  loaded.radar.fidelity.samples = 64;
  return loaded.radar;
}

const radar::RadarConfiguration& configuration() {
  static const radar::RadarConfiguration small = small_configuration();
  return small;
}

std::unique_ptr<model::terrain::TerrainStore> hills() {
  return *model::terrain::open_terrain({});
}

void require_good(const Refusal& refusal) {
  YARS_REQUIRE(refusal.value_or(""), ==, "");
}

class Model {
 public:
  explicit Model(Session session)
      : session_(std::move(session)), shell_(session_, configuration(), {terrain(), scenes(), patches()}) {}

  // Runs four ticks, so that at least one sweep is measured.
  void step() {
    constexpr int kTicks = 4;
    const SessionLayout& layout = std::as_const(session_).layout();
    std::uint64_t sweeps = layout.sweeps.next(), ticks = layout.model_ticks.next();
    for (int i = 0; i < kTicks; ++i) {
      const ClockState clock = session_.clock();
      const std::int64_t tick = session_.sim_time_ns() / radar::kTickNanoseconds + i;
      shell_.step({tick, tick * radar::kTickNanoseconds, clock, 0, false}, 0);
    }
    ModelTick tick{};
    while (layout.model_ticks.read(ticks, tick).delivered)
      if ((tick.flags & kTickOwnshipValid) != 0) require_good(validate(tick.ownship));
    Sweep sweep{};
    while (layout.sweeps.read(sweeps, sweep).delivered) require_good(validate(sweep));
    ModelStatus status{};
    if (layout.model_status.read(status)) require_good(validate(status));
  }

 private:
  static model::TerrainLoader& terrain() {
    static model::TerrainLoader loader(hills(), true);
    return loader;
  }
  static model::SceneLoader& scenes() {
    static model::SceneLoader loader(nullptr, true);
    return loader;
  }
  static model::PatchMaker& patches() {
    static model::PatchMaker maker(configuration(), {hills(), hills(), nullptr}, true);
    return maker;
  }

  Session session_;
  model::RadarModelShell shell_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static fuzz::OverlaidSession session("fuzz-" + std::to_string(getpid()));
  std::optional<Model> model;
  session.play({data, size}, [&] {
    // A session with an invalid clock cannot be opened.
    if (!model)
      if (auto opened = Session::open(session.name(), "radar-model")) model.emplace(std::move(*opened));
    if (model) model->step();
  });
  model.reset();
  session.put_back();
  return 0;
}
