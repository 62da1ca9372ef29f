// Tests of the display in the OpenGL context of a host program. Its pixels equal those of the stand-alone display, and
// the host's OpenGL state is unchanged.
#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "databuffer/messages/validation.hpp"
#include "databuffer/session/picture_pool.hpp"
#include "databuffer/session/session.hpp"
#include "display/gl/context.hpp"
#include "display/gl/display.hpp"
#include "display/host/display.hpp"
#include "display/host/session_link_shell.hpp"
#include "lib/radar/configuration.hpp"
#include "runtime/tick_loop.hpp"
#include "tests/databuffer/session/session_name.hpp"
#include "tests/display/gl/made_up_map.hpp"
#include "tests/display/gl/made_up_sweeps.hpp"
#include "tests/display/host/host_context.hpp"
#include "tests/display/symbology/display_states.hpp"

namespace yars::display::host {
namespace {

using databuffer::Session;
using display::testing::kAircraftPosition;
using Bytes = std::vector<std::uint8_t>;

constexpr double kRange_m = 40.0 * geo::kMetresPerNauticalMile;
constexpr std::int64_t kTick = 4321;

// Publishes what state-machine and radar-model of a set publish: radar state, model status and 60 sweeps.
void put_scene(Session& session) {
  databuffer::SessionLayout& layout = session.layout();
  layout.lockstep.roles = 1U << static_cast<unsigned>(databuffer::LockstepRole::state_machine) |
                          1U << static_cast<unsigned>(databuffer::LockstepRole::radar_model);
  const DisplayInput input = display::testing::operating(radar::Mode::rbm, 40.0);
  databuffer::RadarState state = input.state;
  state.tick = kTick;
  state.channel = 1;
  databuffer::ModelStatus model = input.model;
  model.ownship = input.ownship;
  model.nav = input.nav;
  ASSERT_EQ(databuffer::validate(state), std::nullopt);
  layout.radar_state.publish(state);
  layout.model_status.publish(model);
  for (int i = 0; i < 60; ++i)
    layout.sweeps.publish(display::testing::toned_sweep(kAircraftPosition, 5.0 + 0.8 * i, 5.8 + 0.8 * i, kRange_m, 480,
                                                        static_cast<std::uint8_t>(4 * i)));
}

// Publishes a patch map, and a radar state that shows it.
void put_patch(Session& session) {
  DisplayInput input = display::testing::operating(radar::Mode::patch, 40.0);
  display::testing::put_map(input, 60.0, 20.0, 4.7);
  databuffer::publish_patch(session.layout(), input.map, display::testing::made_up_ground(480), {});
  input.state.channel = 1;
  session.layout().radar_state.publish(input.state);
}

class HostDisplay : public databuffer::testing::SessionTest {
 protected:
  void SetUp() override {
    auto context = gl::open_headless();
    if (!context) GTEST_SKIP() << "no OpenGL without a display: " << context.error().message();
    context_ = std::move(*context);
    session_.emplace(*Session::open(name_, "tester"));
    ASSERT_NO_FATAL_FAILURE(put_scene(*session_));
  }

  Display radar_display() { return {*session_, {}, true}; }

  // RGB pixels of the stand-alone display of the same session.
  Bytes alone(int size) {
    gl::Display radar_display(radar::RadarConfiguration(), size);
    radar_display.keep_video(false);  // as in lockstep
    SessionFeed feed(
        *session_, true, [&](const databuffer::Sweep& sweep) { radar_display.add(sweep); },
        [&](const databuffer::PatchMap& map, std::span<const std::uint8_t> pixels) { radar_display.add(map, pixels); });
    feed.refresh(0);
    radar_display.draw(feed.input());
    return radar_display.read().pixels;
  }

  std::unique_ptr<gl::Context> context_;
  std::optional<Session> session_;
};

TEST_F(HostDisplay, IsPixelIdenticalToTheStandAloneDisplayAndDrawsOnlyInItsViewport) {
  const Canvas canvas(1280, 800);
  Display radar_display = this->radar_display();
  for (const Viewport viewport : {Viewport{620, 100, 600, 600}, Viewport{0, 0, 480, 480}, Viewport{31, 57, 700, 501},
                                  Viewport{801, 0, 479, 800}}) {
    SCOPED_TRACE(std::to_string(viewport.left) + " " + std::to_string(viewport.width));
    canvas.bind();
    canvas.fill();
    const Bytes before = canvas.read();
    radar_display.update(0);
    radar_display.draw(viewport);
    const Bytes after = canvas.read();
    const int size = std::min(viewport.width, viewport.height);
    const int left = viewport.left + (viewport.width - size) / 2;
    const int bottom = viewport.bottom + (viewport.height - size) / 2;
    EXPECT_TRUE(canvas.square(after, left, bottom, size) == alone(size));
    EXPECT_EQ(canvas.changed_outside(before, after, left, bottom, size), 0);
  }
}

TEST_F(HostDisplay, DrawsTheSameInAnUnusualStateAndRestoresTheState) {
  const Bytes expected = alone(600);
  expect_no_error("alone");
  const Canvas canvas(1280, 800);
  expect_no_error("canvas");
  Display radar_display = this->radar_display();
  expect_no_error("construction");
  const OddState odd(canvas);
  odd.set();
  expect_no_error("the odd state");
  const auto before = state_of_context();
  expect_no_error("reading the state");
  // Checks each call of the display by itself: a later call could restore what an earlier one has changed.
  const auto expect_unchanged = [&](const char* call) {
    const auto after = state_of_context();
    for (const auto& [name, values] : before) EXPECT_EQ(after.at(name), values) << name << " after " << call;
    expect_no_error(call);
  };
  radar_display.update(0);
  expect_unchanged("update");
  EXPECT_TRUE(radar_display.paint(600));
  expect_unchanged("paint");
  EXPECT_TRUE(radar_display.start_reading());
  expect_unchanged("start_reading");
  Picture picture;
  EXPECT_TRUE(radar_display.wait_for_read(picture));
  expect_unchanged("wait_for_read");
  EXPECT_TRUE(radar_display.read().pixels == expected);
  expect_unchanged("read");
  radar_display.draw({620, 100, 600, 600});
  expect_unchanged("draw");
  radar_display.draw_panel({.tooltip = 3}, {0, 0, 592, 592});
  expect_unchanged("draw_panel");
  radar_display.read_panel({}, 592);
  expect_unchanged("read_panel");
  radar_display.paint(600);
  radar_display.draw({620, 100, 600, 600});
  {
    const Display another = this->radar_display();
  }
  expect_unchanged("construction and destruction of another display");
  canvas.bind();
  plain_reading();
  EXPECT_TRUE(canvas.square(canvas.read(), 620, 100, 600) == expected);
}

TEST_F(HostDisplay, APanelHasThePicturePixelByPixelWithTheBezelAroundIt) {
  Display radar_display = this->radar_display();
  radar_display.update(0);
  const imageio::Image panel = radar_display.read_panel({}, 592);
  ASSERT_EQ(panel.width, 592);
  const Bytes expected = alone(480);
  Bytes inner;
  std::size_t lit_outside = 0;
  for (int y = 0; y < 592; ++y) {
    for (int x = 0; x < 592; ++x) {
      const auto* pixel = panel.pixels.data() + 3 * (static_cast<std::size_t>(y) * 592 + static_cast<std::size_t>(x));
      const bool inside = x >= 56 && x < 536 && y >= 56 && y < 536;
      if (inside) inner.insert(inner.end(), pixel, pixel + 3);
      if (!inside && pixel[0] + pixel[1] + pixel[2] > 0) ++lit_outside;
    }
  }
  EXPECT_TRUE(inner == expected);
  EXPECT_GT(lit_outside, 100'000U) << "the bezel's face is not black";
  EXPECT_TRUE(radar_display.paint_panel({.lit = 5}, 592));
  EXPECT_FALSE(radar_display.paint_panel({.lit = 5}, 592)) << "nothing has changed";
  EXPECT_TRUE(radar_display.paint_panel({.bezel = false}, 480));
}

// A window that keeps its content is refreshed where it has changed. Its pixels are those of a window that is drawn
// whole each time: with sweeps, symbols, maps, the bezel, a tooltip, a notice, in two sizes.
TEST_F(HostDisplay, ARefreshedPanelHasThePixelsOfAPanelDrawnWhole) {
  const Canvas refreshed(700, 640), whole(700, 640);
  Display kept = radar_display(), redrawn = radar_display();
  refreshed.bind();
  refreshed.fill();
  int parts = 0;
  const auto expect_equal = [&](const PanelView& view, const Viewport& viewport, const char* what) {
    kept.update(0);
    redrawn.update(0);
    refreshed.bind();
    const Bytes before = refreshed.read();
    const Viewport changed = kept.refresh_panel(view, viewport);
    const Bytes after = refreshed.read();
    parts += changed.width > 0 && changed.width < viewport.width / 2 ? 1 : 0;
    for (int y = 0; y < 640; ++y) {
      for (int x = 0; x < 700; ++x) {
        const std::size_t at = 4 * (static_cast<std::size_t>(y) * 700 + static_cast<std::size_t>(x));
        const bool inside = x >= changed.left && x < changed.left + changed.width && y >= changed.bottom &&
                            y < changed.bottom + changed.height;
        if (!inside && !std::equal(&before[at], &before[at] + 4, &after[at]))
          FAIL() << what << ": a pixel outside the changed rectangle has changed, " << x << ' ' << y;
      }
    }
    whole.bind();
    whole.fill();
    redrawn.draw_panel(view, viewport);
    EXPECT_TRUE(after == whole.read()) << what;
    refreshed.bind();
    EXPECT_EQ(kept.refresh_panel(view, viewport).width, 0) << what << ": nothing has changed since";
  };
  for (const bool keeps : {true, false}) {
    kept.keep_video(keeps);
    redrawn.keep_video(keeps);
    for (const Viewport viewport : {Viewport{20, 30, 603, 603}, Viewport{11, 5, 640, 500}}) {
      for (Display* display : {&kept, &redrawn}) display->update(0);
      whole.bind();
      whole.fill();
      refreshed.bind();
      refreshed.fill();
      PanelView view;
      expect_equal(view, viewport, "first");
      for (int i = 0; i < 12; ++i) {
        session_->layout().sweeps.publish(display::testing::toned_sweep(kAircraftPosition, 20.0 + i, 21.0 + i, kRange_m,
                                                                        480, static_cast<std::uint8_t>(250 - 20 * i)));
        databuffer::ModelStatus model = kept.input().model;
        model.antenna_azimuth_deg = -10.0 + i;
        session_->layout().model_status.publish(model);
        expect_equal(view, viewport, "a sweep");
      }
      view.lit = view.tooltip = 7;
      expect_equal(view, viewport, "a tooltip");
      session_->layout().sweeps.publish(
          display::testing::toned_sweep(kAircraftPosition, 30.0, 34.0, kRange_m, 480, 200));
      expect_equal(view, viewport, "a sweep below the tooltip");
      view = {.notice = "ESC ENDS NOTHING HERE"};
      expect_equal(view, viewport, "a notice");
      session_->layout().sweeps.publish(
          display::testing::toned_sweep(kAircraftPosition, 26.0, 33.0, kRange_m, 480, 90));
      expect_equal(view, viewport, "a sweep below the notice");
      put_patch(*session_);
      expect_equal(view, viewport, "a map");
      ASSERT_NO_FATAL_FAILURE(put_scene(*session_));
      view = {};
      expect_equal(view, viewport, "no notice");
    }
  }
  EXPECT_GT(parts, 20) << "too much was drawn again";
}

TEST_F(HostDisplay, TheHelpCoversThePictureUntilItIsSwitchedOff) {
  Display radar_display = this->radar_display();
  radar_display.update(0);
  radar_display.paint(480);
  const Bytes bare = radar_display.read().pixels;
  radar_display.show_help(true);
  EXPECT_TRUE(radar_display.paint(480));
  EXPECT_FALSE(radar_display.read().pixels == bare);
  radar_display.show_help(false);
  EXPECT_TRUE(radar_display.paint(480));
  EXPECT_TRUE(radar_display.read().pixels == bare);
  databuffer::PilotAdvice advice{};
  std::string("longer range: 80 NM").copy(advice.buttons[13], sizeof advice.buttons[13] - 1);
  session_->layout().advice.publish(advice);
  radar_display.update(0);
  EXPECT_EQ(radar_display.describe(13), "longer range: 80 NM");
  EXPECT_EQ(radar_display.describe(21), "");
}

TEST_F(HostDisplay, PicturesAreReadInOrderWithTheirTime) {
  Display radar_display = this->radar_display();
  radar_display.update(77'000'000);
  ASSERT_TRUE(radar_display.paint(480));
  EXPECT_FALSE(radar_display.paint(480)) << "nothing is new";
  Picture picture;
  EXPECT_FALSE(radar_display.take_read(picture)) << "no reading was started";
  EXPECT_TRUE(radar_display.start_reading());
  radar_display.paint(300);
  EXPECT_TRUE(radar_display.start_reading());
  EXPECT_FALSE(radar_display.start_reading()) << "two readings are in progress";
  ASSERT_TRUE(radar_display.wait_for_read(picture));
  EXPECT_EQ(picture.size, 480);
  EXPECT_EQ(picture.tick, kTick);
  EXPECT_EQ(picture.sim_time_ns, 77'000'000);
  const Bytes expected = alone(480);
  ASSERT_EQ(picture.pixels.size() / 4, expected.size() / 3);
  for (std::size_t i = 0; i < expected.size() / 3; ++i) {
    ASSERT_TRUE(std::equal(&expected[3 * i], &expected[3 * i] + 3, &picture.pixels[4 * i])) << "pixel " << i;
    ASSERT_EQ(picture.pixels[4 * i + 3], 255) << "pixel " << i;
  }
  ASSERT_TRUE(radar_display.wait_for_read(picture));
  EXPECT_EQ(picture.size, 300);
  EXPECT_FALSE(radar_display.wait_for_read(picture));
}

TEST_F(HostDisplay, SeveralDisplaysInOneProgramEachShowTheirOwnSession) {
  const Bytes scene = alone(480);
  auto dark_session = Session::open(name_ + "-dark", "tester");
  ASSERT_TRUE(dark_session);
  auto dark = std::make_unique<Display>(*dark_session, radar::RadarConfiguration{}, true);
  Display first = radar_display();
  Display second = radar_display();
  for (Display* each : {dark.get(), &first, &second}) {
    each->update(0);
    each->paint(480);
  }
  EXPECT_TRUE(first.read().pixels == scene);
  EXPECT_TRUE(second.read().pixels == scene);
  EXPECT_FALSE(dark->read().pixels == scene);
  dark.reset();
  second = radar_display();
  second.update(0);
  second.paint(480);
  EXPECT_TRUE(first.read().pixels == scene);
  EXPECT_TRUE(second.read().pixels == scene) << "the display that replaced the second one";
}

TEST_F(HostDisplay, UpdateReadsThePatchMap) {
  const Bytes sweeps = alone(480);
  Display radar_display = this->radar_display();
  put_patch(*session_);
  const Bytes map = alone(480);
  EXPECT_FALSE(map == sweeps);
  const Canvas canvas(480, 480);
  const OddState odd(canvas);
  odd.set();
  radar_display.update(0);
  radar_display.paint(480);
  EXPECT_TRUE(radar_display.read().pixels == map);
}

// In a live session. A tour that was killed leaves its caption in the segment.
TEST_F(HostDisplay, ACaptionIsShownWhileItsTourRuns) {
  const auto step = [&] {
    SessionFeed feed(*session_, false, [](const databuffer::Sweep&) {}, [](const auto&, auto) {});
    feed.refresh(0);
    return feed.input().caption.step;
  };
  databuffer::Caption caption{};
  caption.step = caption.steps = 3;
  session_->layout().caption.publish(caption);
  EXPECT_EQ(step(), 0U) << "nobody holds the role";
  {
    const auto tour = session_->claim(databuffer::Role::tour);
    ASSERT_TRUE(tour) << tour.error().message();
    EXPECT_EQ(step(), 3U);
    caption.waiting = 7;
    session_->layout().caption.publish(caption);
    EXPECT_EQ(step(), 0U) << "an invalid caption, and no earlier one";
    session_->layout().caption.clear();
    EXPECT_EQ(step(), 0U);
  }
  caption.waiting = 0;
  session_->layout().caption.publish(caption);
  EXPECT_EQ(step(), 0U);
}

TEST_F(HostDisplay, AClickOnALegendPressesItsButton) {
  auto attached = Display::attach({name_, "", "cockpit"});
  ASSERT_TRUE(attached) << attached.error().message();
  EXPECT_FALSE(session_->input_lane_is_held(0)) << "a display claims no input lane before its first event";
  // PB 11 to 15 are on the right side, counted upwards: this is PB 14.
  auto hit = attached->click(470.0 / 480.0, 160.0 / 480.0);
  ASSERT_TRUE(hit) << hit.error().message();
  EXPECT_TRUE(*hit);
  EXPECT_EQ(attached->click(0.5, 0.5), false);
  EXPECT_TRUE(attached->press(7));
  EXPECT_FALSE(attached->press(21));
  databuffer::InputEvent event{};
  for (const int button : {14, 7}) {
    ASSERT_TRUE(session_->layout().input.pop(0, event));
    EXPECT_EQ(event.kind, static_cast<std::uint16_t>(databuffer::EventKind::push_button));
    EXPECT_EQ(event.argument, button);
  }
  EXPECT_FALSE(session_->layout().input.pop(0, event));
  const auto processes = session_->processes();
  EXPECT_TRUE(std::ranges::any_of(processes, [](const auto& process) { return process.name == "cockpit"; }));
}

TEST_F(HostDisplay, WithoutACurrentContextAttachingIsAnError) {
  context_.reset();
  const auto attached = Display::attach({name_, "", "cockpit"});
  ASSERT_FALSE(attached);
  EXPECT_NE(attached.error().message().find("OpenGL 3.3"), std::string::npos) << attached.error().message();
}

}  // namespace
}  // namespace yars::display::host
