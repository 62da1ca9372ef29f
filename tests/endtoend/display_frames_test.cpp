// Frames of radar-display in the segment (`--publish`) and in the viewport of a host program. External programs read
// exactly the pixels of the display's picture. The newest frame stays after the death of radar-display.
#include <gtest/gtest.h>
#include <signal.h>

#include <cstdlib>
#include <fstream>
#include <map>
#include <random>
#include <sstream>
#include <utility>

#include "databuffer/session/picture_pool.hpp"
#include "databuffer/session/session.hpp"
#include "lib/imageio/png.hpp"
#include "tests/endtoend/process_set.hpp"
#include "tests/lib/imageio/read_png.hpp"

namespace yars::endtoend {
namespace {

using databuffer::GlassFrame;
using databuffer::Session;
using Bytes = std::vector<std::uint8_t>;

constexpr const char* kSource = "fixed:37.5,-123.0,15000,90,480";
constexpr std::int64_t kTick_ns = 5'000'000;

Bytes rgb_of(const Bytes& rgba) {
  Bytes rgb;
  rgb.reserve(rgba.size() / 4 * 3);
  for (std::size_t i = 0; i + 3 < rgba.size(); i += 4) rgb.insert(rgb.end(), &rgba[i], &rgba[i] + 3);
  return rgb;
}

Bytes file_bytes(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

Bytes png_pixels(const std::filesystem::path& path) {
  const auto image = test::read_png(path);
  EXPECT_TRUE(image) << path;
  return image ? image->pixels : Bytes{};
}

// RGB of the host's scene, 1280 x 800 pixels; empty if the file is no such portable pixmap.
Bytes scene_pixels(const std::filesystem::path& path) {
  constexpr std::string_view kHead = "P6\n1280 800\n255\n";
  Bytes bytes = file_bytes(path);
  if (bytes.size() != kHead.size() + std::size_t{3} * 1280 * 800 ||
      !std::equal(kHead.begin(), kHead.end(), bytes.begin()))
    return {};
  bytes.erase(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(kHead.size()));
  return bytes;
}

// Number of pixels with a green channel above 60 of 255.
std::size_t lit(const Bytes& rgb) {
  std::size_t count = 0;
  for (std::size_t i = 1; i < rgb.size(); i += 3) count += rgb[i] > 60 ? 1 : 0;
  return count;
}

struct Frame {
  GlassFrame about{};
  Bytes pixels;
};

// The newest frame, if its id is greater than `after`.
std::optional<Frame> newest_frame(const Session& session, std::uint64_t after = 0) {
  Frame frame;
  if (!databuffer::read_newest_frame(session.layout(), after, frame.about, frame.pixels)) return std::nullopt;
  return frame;
}

void start_live(ProcessSet& set) {
  set.start("state", {"state-machine"});
  set.start("model", {"radar-model"});
  set.start("flight", {"flight-model", "--source", kSource});
  ASSERT_TRUE(set.wait_until([](const auto& watch) { return watch["tick"] > 10 && !watch["ownship"].is_null(); }));
  ASSERT_EQ(set.yars({"inject", "power opr"}).code, 0);
  ASSERT_TRUE(set.wait_until([](const auto& watch) { return watch["sweeps"] > 50; }));
}

// Each published frame has the pixels of the PNG of the same tick. After the end of the set, programs in C and Python
// read the last frame.
TEST(DisplayFrames, InLockstepEqualThePngOfTheirTick) {
  ProcessSet set("frames-lockstep");
  auto session = Session::open(set.session(), "tester");
  ASSERT_TRUE(session) << session.error().message();
  const auto folder = set.folder();
  std::ofstream(folder / "script") << "0.5 power opr\n1.5 pb 13\n2.5 pb 9\n";
  const std::string plan = "flight-model,input-monitor,state-machine,radar-model,radar-display@800";
  constexpr std::int64_t kEvery_ns = 200'000'000;
  set.start("flight", {"flight-model", "--source", kSource, "--lockstep", plan});
  set.start("input", {"input-monitor", "--source", "script:" + (folder / "script").string(), "--lockstep", plan});
  set.start("state", {"state-machine", "--lockstep", plan});
  set.start("model", {"radar-model", "--lockstep", plan});
  set.start("display", {"radar-display", "--headless", "--publish", "--frames", folder.string(), "--every", "0.2",
                        "--lockstep", plan});
  std::map<std::uint64_t, Frame> seen;
  EXPECT_TRUE(eventually(
      [&] {
        if (auto frame = newest_frame(*session, seen.empty() ? 0 : seen.rbegin()->first))
          seen.emplace(frame->about.id, std::move(*frame));
        return !set.runs("display");
      },
      120.0));
  for (const auto* role : {"flight", "input", "state", "model", "display"})
    EXPECT_EQ(set.wait(role), 0) << set.log_of(role);
  auto last = newest_frame(*session);
  ASSERT_TRUE(last);
  EXPECT_EQ(last->about.sim_time_ns, 800 * kTick_ns);
  EXPECT_GT(lit(rgb_of(last->pixels)), 3000U);
  seen.insert_or_assign(last->about.id, *last);
  std::printf("frames read during the run: %zu of %lu\n", seen.size(), last->about.id);
  for (const auto& [id, frame] : seen) {
    EXPECT_EQ(frame.about.tick, frame.about.sim_time_ns / kTick_ns);
    std::array<char, 32> name{};
    std::snprintf(name.data(), name.size(), "frame_%06ld.png", frame.about.sim_time_ns / kEvery_ns);
    EXPECT_TRUE(rgb_of(frame.pixels) == png_pixels(folder / name.data())) << name.data();
  }

  const auto in_c = run_tool({YARS_BIN_DIR "/example_show_frame", set.session(), (folder / "shown.ppm").string()});
  EXPECT_EQ(in_c.code, 0) << in_c.errors;
  Bytes expected = rgb_of(last->pixels);
  const std::string head = "P6\n# tick 800\n480 480\n255\n";
  expected.insert(expected.begin(), head.begin(), head.end());
  EXPECT_TRUE(file_bytes(folder / "shown.ppm") == expected);

  const auto in_python = run_tool({"python3", "-B", "-c",
                                   "import sys; sys.path.insert(0, sys.argv[1]); from yars import Session\n"
                                   "with Session(sys.argv[2], 'test') as session:\n"
                                   "    frame, pixels = session.newest_frame()\n"
                                   "    open(sys.argv[3], 'wb').write(pixels); print(frame['tick'], frame['width'])\n",
                                   YARS_SOURCE_DIR "/python", set.session(), (folder / "raw").string()});
  EXPECT_EQ(in_python.output, "800 480\n") << in_python.errors;
  EXPECT_TRUE(file_bytes(folder / "raw") == last->pixels);
}

TEST(DisplayFrames, OneDisplayOfASessionPublishesAndASecondReportsTheFirst) {
  ProcessSet set("frames-second");
  set.start("display", {"radar-display", "--headless", "--publish"});
  auto session = Session::open(set.session(), "tester");
  ASSERT_TRUE(session);
  ASSERT_TRUE(eventually([&] { return newest_frame(*session).has_value(); }, 20.0)) << set.log_of("display");
  const auto second = run_program({"radar-display", "--session", set.session(), "--headless", "--publish"});
  EXPECT_EQ(second.code, 2);
  EXPECT_NE(second.errors.find("radar-display, pid " + std::to_string(set.pid("display"))), std::string::npos)
      << second.errors;
  const auto large =
      run_program({"radar-display", "--session", set.session(), "--headless", "--publish", "--size", "1025"});
  EXPECT_EQ(large.code, 2);
  EXPECT_NE(large.errors.find("--size 1024 or less"), std::string::npos) << large.errors;
  EXPECT_EQ(run_program({"radar-display", "--session", set.session(), "--headless"}).code, 2);
  EXPECT_TRUE(set.runs("display"));
  const std::string publisher =
      "frames of the display: pid " + std::to_string(set.pid("display")) + " publishes, newest ";
  EXPECT_NE(set.yars({"status"}).output.find(publisher), std::string::npos) << set.yars({"status"}).output;
  set.kill("display", SIGKILL);
  set.wait("display");
  EXPECT_NE(set.yars({"status"}).output.find("frames of the display: nobody publishes"), std::string::npos);
}

// radar-display is killed at random moments, often while it writes. Each frame that is read is complete, ids increase
// over all restarts, and the newest frame stays.
TEST(DisplayFrames, OfADisplayThatIsKilledTenTimesAreComplete) {
  ProcessSet set("frames-kill");
  ASSERT_NO_FATAL_FAILURE(start_live(set));
  auto session = Session::open(set.session(), "tester");
  ASSERT_TRUE(session);
  std::mt19937 random(20);
  std::uint64_t newest = 0, read = 0;
  const auto poll = [&] {
    const auto frame = newest_frame(*session, newest);
    if (!frame) return;
    EXPECT_GT(frame->about.id, newest);
    ASSERT_EQ(frame->about.width, 700U);
    ASSERT_EQ(frame->pixels.size(), 4U * 700U * 700U);
    for (std::size_t i = 3; i < frame->pixels.size(); i += 4) ASSERT_EQ(frame->pixels[i], 255);
    newest = frame->about.id;
    ++read;
  };
  for (int life = 0; life < 10; ++life) {
    set.start("display", {"radar-display", "--headless", "--publish", "--size", "700"});
    const std::uint64_t least = newest + 1 + random() % 20;
    ASSERT_TRUE(eventually([&] { return poll(), newest >= least; }, 30.0)) << set.log_of("display");
    EXPECT_TRUE(session->role_is_held(databuffer::Role::glass_frames));
    set.kill("display", SIGKILL);
    EXPECT_EQ(set.wait("display"), 128 + SIGKILL);
    EXPECT_FALSE(session->role_is_held(databuffer::Role::glass_frames));
    const auto left = newest_frame(*session);
    ASSERT_TRUE(left) << "the newest frame stays";
    EXPECT_GE(left->about.id, newest);
    newest = left->about.id;
  }
  std::printf("frames read: %lu of %lu\n", read, newest);
}

// A picture is published only when it differs from the one before.
TEST(DisplayFrames, OfAWindowComeWhenSomethingDrawnHasChanged) {
  if (!tool_exists("Xvfb")) GTEST_SKIP() << "needs Xvfb (scripts/setup --test)";
  ProcessSet set("frames-window");
  set.start_tool("xvfb", {"Xvfb", "-displayfd", "1", "-screen", "0", "800x600x24", "-nolisten", "tcp"});
  ASSERT_TRUE(eventually([&] { return set.output_of("xvfb").ends_with("\n"); }, 20.0)) << set.log_of("xvfb");
  auto display = std::string(":").append(set.output_of("xvfb"));
  display.pop_back();
  setenv("DISPLAY", display.c_str(), 1);
  ASSERT_NO_FATAL_FAILURE(start_live(set));
  set.start("display", {"radar-display", "--publish", "--size", "500"});
  unsetenv("DISPLAY");
  auto session = Session::open(set.session(), "tester");
  ASSERT_TRUE(session);
  const auto newest = [&] {
    return databuffer::greatest_id<shm::PlainAccess>(std::as_const(*session).layout().frames);
  };
  ASSERT_TRUE(eventually([&] { return newest() > 30; }, 30.0)) << set.log_of("display");
  const auto frame = newest_frame(*session);
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->about.width, 500U);
  EXPECT_GT(lit(rgb_of(frame->pixels)), 3000U);
  ASSERT_EQ(set.yars({"inject", "power stby"}).code, 0);
  EXPECT_TRUE(eventually(
      [&] {
        const std::uint64_t before = newest();
        const int tick = set.watch()["tick"];
        return set.wait_until([&](const auto& watch) { return watch["tick"] > tick + 200; }) && newest() == before;
      },
      60.0))
      << "the picture in standby does not change";
  const std::uint64_t standby = newest();
  ASSERT_EQ(set.yars({"inject", "pb 4"}).code, 0);
  EXPECT_TRUE(eventually([&] { return newest() > standby; }, 20.0)) << "the brightness has changed";
  EXPECT_TRUE(set.runs("display")) << set.log_of("display");
}

// The host's window has 1280 x 800 pixels. Its viewport for the display has 600 x 600 pixels, upper left corner at
// column 620, row 100. The host's own picture beside the viewport is unchanged.
TEST(DisplayFrames, TheDisplayInAHostsViewportIsThePublishedPicture) {
  ProcessSet set("frames-host");
  ASSERT_NO_FATAL_FAILURE(start_live(set));
  auto session = Session::open(set.session(), "tester");
  ASSERT_TRUE(session);
  ASSERT_EQ(set.yars({"inject", "freeze"}).code, 0);
  ASSERT_TRUE(set.wait_until([](const auto& watch) { return watch["freeze"] == true; }));
  // Without this, the displayed range of the cursor would keep changing.
  ASSERT_EQ(set.yars({"sim", "freeze"}).code, 0);
  set.start("display", {"radar-display", "--headless", "--publish", "--size", "600"});
  const auto path = set.folder() / "host.ppm";
  Bytes scene, inside, outside;
  const bool same = eventually(
      [&] {
        const auto host = run_tool({YARS_BIN_DIR "/example_host_display", set.session(), path.string(), "0.5"});
        EXPECT_EQ(host.code, 0) << host.errors;
        scene = scene_pixels(path);
        if (scene.empty()) return false;
        inside.clear();
        for (std::size_t y = 100; y < 700; ++y) {
          const auto row = scene.begin() + static_cast<std::ptrdiff_t>(3 * (1280 * y + 620));
          inside.insert(inside.end(), row, row + 1800);
        }
        const std::size_t left_of_viewport = 3 * (1280 * 500 + 619);
        outside.assign(&scene[left_of_viewport], &scene[left_of_viewport] + 3);
        const auto frame = newest_frame(*session);
        return frame && rgb_of(frame->pixels) == inside;
      },
      30.0);
  if (const char* keep = std::getenv("YARS_PICTURES")) {
    EXPECT_TRUE(imageio::write_png(std::filesystem::path(keep) / "host_display.png", {1280, 800, 3, scene}));
  }
  EXPECT_TRUE(same) << "the viewport equals the newest published frame";
  EXPECT_GT(lit(inside), 5000U);
  EXPECT_EQ(outside, (Bytes{18, 18, 20})) << "the host's panel beside the viewport";
}

}  // namespace
}  // namespace yars::endtoend
